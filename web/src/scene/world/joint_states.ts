/** Decodes `trundle/joints`. */

import type { JointState, JointStates } from "../simulated_world";

const HEADER = 16;
const SIZE = 24; // position, velocity and effort as float64

/** States in the manifest's order; null: of another generation, or truncated. */
export function readJoints(message: DataView, generation: number): JointStates | null {
  if (message.byteLength < HEADER || message.getUint32(8, true) !== generation) return null;
  const count = message.getUint32(12, true);
  return message.byteLength < HEADER + SIZE * count ? null : new ReceivedJoints(message, count);
}

/** States that stay in their message until one is looked at: few of hundreds are shown. */
class ReceivedJoints implements JointStates {
  constructor(
    private readonly message: DataView,
    private readonly count: number,
  ) {}

  at(index: number): JointState | undefined {
    if (!(index >= 0 && index < this.count)) return undefined;
    const start = HEADER + SIZE * index;
    const number = (offset: number): number => this.message.getFloat64(start + offset, true);
    return { position: number(0), velocity: number(8), effort: number(16) };
  }
}
