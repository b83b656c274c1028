/** Decodes `trundle/joints`. */

import type { JointState } from "../simulated_world";

const HEADER = 16;
const NUMBERS = 3;

/** Positions, velocities and efforts in the manifest's order; null: of another generation, or cut short. */
export function readJoints(message: DataView, generation: number): JointState[] | null {
  if (message.byteLength < HEADER || message.getUint32(8, true) !== generation) return null;
  const count = message.getUint32(12, true);
  if (message.byteLength < HEADER + 8 * NUMBERS * count) return null;
  return Array.from({ length: count }, (_, i) => {
    const at = HEADER + 8 * NUMBERS * i;
    return { position: message.getFloat64(at, true), velocity: message.getFloat64(at + 8, true), effort: message.getFloat64(at + 16, true) };
  });
}
