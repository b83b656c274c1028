/** Poses of the bodies in the simulated world, from `trundle/poses`. */

import { Quaternion, Vector3, type Object3D } from "three";

import type { Transform } from "../../frames/transform";

const HEADER = 16;
const NUMBERS = 7;

/** Numbers of a pose: x y z [m], quaternion x y z w; the newest of each body. */
export class BodyPoses {
  /** Time of the newest message [ns]. */
  time = 0n;
  private numbers = new Float32Array(0);
  private isKnown = new Uint8Array(0);
  private readonly objects: (Object3D | undefined)[] = [];

  /** Attach the object that follows a body. */
  attach(body: number, object: Object3D): void {
    this.objects[body] = object;
    if (this.isKnown[body] === 1) this.place(body);
  }

  object(body: number): Object3D | null {
    return this.objects[body] ?? null;
  }

  /** Detach an object that leaves the scene. */
  detach(object: Object3D): void {
    const body = this.objects.indexOf(object);
    if (body >= 0) this.objects[body] = undefined;
  }

  forgetPoses(): void {
    this.isKnown.fill(0);
  }

  pose(body: number): Transform | null {
    if (this.isKnown[body] !== 1) return null;
    const at = body * NUMBERS;
    return {
      position: new Vector3().fromArray(this.numbers, at),
      orientation: new Quaternion().fromArray(this.numbers, at + 3),
    };
  }

  /** Apply a message's poses; false: it is of another generation of the world, or truncated. */
  apply(message: DataView, generation: number): boolean {
    if (message.byteLength < HEADER || message.getUint32(8, true) !== generation) return false;
    const count = message.getUint32(12, true);
    let at = HEADER + 4 * count;
    if (message.byteLength < at + 4 * NUMBERS * count) return false;
    this.time = message.getBigUint64(0, true);
    for (let i = 0; i < count; i += 1) {
      const body = message.getUint32(HEADER + 4 * i, true);
      if (body >= this.isKnown.length) this.grow(body + 1);
      for (let j = body * NUMBERS; j < (body + 1) * NUMBERS; j += 1, at += 4)
        this.numbers[j] = message.getFloat32(at, true);
      this.isKnown[body] = 1;
      this.place(body);
    }
    return true;
  }

  private place(body: number): void {
    const object = this.objects[body];
    if (object === undefined) return;
    object.position.fromArray(this.numbers, body * NUMBERS);
    object.quaternion.fromArray(this.numbers, body * NUMBERS + 3);
  }

  private grow(bodies: number): void {
    const size = Math.max(64, 2 ** Math.ceil(Math.log2(bodies)));
    const [numbers, isKnown] = [new Float32Array(size * NUMBERS), new Uint8Array(size)];
    numbers.set(this.numbers);
    isKnown.set(this.isKnown);
    this.numbers = numbers;
    this.isKnown = isKnown;
  }
}
