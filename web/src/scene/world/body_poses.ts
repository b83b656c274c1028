/** Poses of the bodies in the simulated world, from `trundle/poses`. */

import { Quaternion, Vector3, type Object3D } from "three";

import { looksSame, type Transform } from "../../frames/transform";

const HEADER = 16;
const NUMBERS = 7;
/** Largest number of past poses that are kept, and their age [ns]. */
const MAX_PAST = 16;
const MAX_AGE = 500_000_000n;
/** Buffers: the pose that is read, and the next pose for interpolation. */
const POSE = { position: new Vector3(), orientation: new Quaternion() };
const AFTER = { position: new Vector3(), orientation: new Quaternion() };

/** Poses of all bodies at a time, and the bodies that the message moved. */
interface Past {
  readonly time: bigint;
  readonly numbers: Float32Array;
  readonly moved: readonly number[];
}

/** Poses of the bodies; the numbers of a pose are x y z [m], quaternion x y z w. */
export class BodyPoses {
  /** Time of the newest message [ns]. */
  time = 0n;
  private numbers = new Float32Array(0);
  private isKnown = new Uint8Array(0);
  private readonly objects: (Object3D | undefined)[] = [];
  /** Newest poses and those before them, oldest first. */
  private past: Past[] = [];
  /** Time at which the bodies are drawn [ns]. */
  drawnAt = 0n;
  private hasMoved = false;
  /** First poses that came for the newest time; null: only one message came for that time. */
  private first: Float32Array | null = null;

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
    this.past = [];
    this.first = null;
  }

  pose(body: number): Transform | null {
    if (this.isKnown[body] !== 1) return null;
    const at = body * NUMBERS;
    return {
      position: new Vector3().fromArray(this.numbers, at),
      orientation: new Quaternion().fromArray(this.numbers, at + 3),
    };
  }

  /** Pose of a body before edits while time stands still; null: no edit has moved it. */
  poseBefore(body: number): Transform | null {
    const at = body * NUMBERS;
    const { first, numbers } = this;
    if (first === null || this.isKnown[body] !== 1 || at + NUMBERS > first.length) return null;
    for (let i = at; i < at + NUMBERS; i += 1) {
      if (first[i] === numbers[i]) continue;
      return {
        position: new Vector3().fromArray(first, at),
        orientation: new Quaternion().fromArray(first, at + 3),
      };
    }
    return null;
  }

  /** Pose in which a body is drawn; null before the first. */
  drawn(body: number): Transform | null {
    const object = this.objects[body];
    if (object === undefined || this.isKnown[body] !== 1) return this.pose(body);
    return { position: object.position.clone(), orientation: object.quaternion.clone() };
  }

  /** Apply a message's poses; false: it is of another generation of the world, or truncated. */
  apply(message: DataView, generation: number): boolean {
    if (message.byteLength < HEADER || message.getUint32(8, true) !== generation) return false;
    const count = message.getUint32(12, true);
    let at = HEADER + 4 * count;
    if (message.byteLength < at + 4 * NUMBERS * count) return false;
    const time = message.getBigUint64(0, true);
    if (time <= this.time) this.past = []; // time stands still or goes back: the new poses show at once
    this.first = time === this.time ? (this.first ?? this.numbers.slice()) : null;
    this.time = time;
    const moved: number[] = [];
    for (let i = 0; i < count; i += 1) {
      const body = message.getUint32(HEADER + 4 * i, true);
      if (body >= this.isKnown.length) this.grow(body + 1);
      for (let j = body * NUMBERS; j < (body + 1) * NUMBERS; j += 1, at += 4)
        this.numbers[j] = message.getFloat32(at, true);
      this.isKnown[body] = 1;
      moved.push(body);
      this.place(body);
    }
    this.past.push({ time, numbers: this.numbers.slice(), moved });
    while (this.past.length > MAX_PAST || (this.past[0]?.time ?? time) < time - MAX_AGE) this.past.shift();
    this.drawnAt = time;
    return true;
  }

  /** True if an object has visibly moved since the last call. */
  takeMoved(): boolean {
    const { hasMoved } = this;
    this.hasMoved = false;
    return hasMoved;
  }

  /** Place the objects as their bodies were at a time [ns], interpolated. */
  draw(time: bigint): void {
    if (time === this.drawnAt) return;
    this.drawnAt = time;
    const after = Math.max(
      this.past.findIndex((past) => past.time > time),
      0,
    );
    const [from, to] = [this.past[Math.max(after - 1, 0)], this.past[after]];
    if (from === undefined || to === undefined || time >= this.time) {
      for (const { moved } of this.past) for (const body of moved) this.place(body);
      return;
    }
    const share = from === to ? 1 : Number(time - from.time) / Number(to.time - from.time);
    const moved = new Set<number>();
    for (const past of this.past) for (const body of past.moved) moved.add(body);
    for (const body of moved) this.interpolate(body, from.numbers, to.numbers, share);
  }

  private interpolate(body: number, from: Float32Array, to: Float32Array, share: number): void {
    const object = this.objects[body];
    const at = body * NUMBERS;
    if (object === undefined || at >= to.length) return;
    const start = at < from.length ? from : to;
    POSE.position.fromArray(start, at).lerp(AFTER.position.fromArray(to, at), share);
    POSE.orientation.fromArray(start, at + 3).slerp(AFTER.orientation.fromArray(to, at + 3), share);
    this.move(object);
  }

  private place(body: number): void {
    const object = this.objects[body];
    if (object === undefined) return;
    POSE.position.fromArray(this.numbers, body * NUMBERS);
    POSE.orientation.fromArray(this.numbers, body * NUMBERS + 3);
    this.move(object);
  }

  /** Move an object to the pose that was read, unless the change is invisible: bodies at rest jitter a little. */
  private move({ position, quaternion }: Object3D): void {
    if (looksSame(position, quaternion, POSE)) return;
    position.copy(POSE.position);
    quaternion.copy(POSE.orientation);
    this.hasMoved = true;
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
