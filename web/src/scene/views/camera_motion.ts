/** Smooth moves of a view's properties, and of the frame that it follows. */

import { Quaternion, Vector3 } from "three";

import type { Transform } from "../../frames/transform";
import type { Triple } from "../../rviz/properties";
import { wrapAngle, type Motion } from "./view";

/** [s] */
const DURATION = 0.35;
/** Time constant of following [s]. */
const LAG = 0.06;
/** Distance at which a target has jumped [m]. */
const JUMP = 3;
/** [m, and chord on the unit sphere] */
const STILL = 1e-5;

export class CameraMotion {
  private readonly starts: (number | Triple)[];
  private share = 0;

  constructor(
    private readonly motions: readonly Motion[],
    private readonly duration = DURATION,
  ) {
    this.starts = motions.map(({ property }) => property.value.peek());
  }

  /** Move on by some seconds; true when it has arrived. */
  advance(elapsed: number): boolean {
    this.share = this.duration <= 0 ? 1 : Math.min(1, this.share + elapsed / this.duration);
    const eased = 1 - (1 - this.share) ** 3;
    this.motions.forEach((motion, index) => {
      apply(motion, this.starts[index] ?? 0, eased);
    });
    return this.share >= 1;
  }
}

function apply(motion: Motion, start: number | Triple, share: number): void {
  if (!("kind" in motion)) {
    if (typeof start === "number") return;
    const [x, y, z] = motion.to;
    motion.property.value.value = [
      start[0] + share * (x - start[0]),
      start[1] + share * (y - start[1]),
      start[2] + share * (z - start[2]),
    ];
  } else if (typeof start === "number") {
    motion.property.value.value = between(motion.kind, start, motion.to, share);
  }
}

function between(kind: "length" | "angle" | "scale", from: number, to: number, share: number): number {
  if (share === 1) return to;
  if (kind === "scale") return from * (to / from) ** share;
  if (kind === "angle") return wrapAngle(from + share * wrapAngle(to - from));
  return from + share * (to - from);
}

/** A pose that follows another with a short lag, so that poses at 30 Hz do not jerk the picture. */
export class SmoothPose implements Transform {
  readonly position = new Vector3();
  readonly orientation = new Quaternion();

  /** Set the pose at once. */
  set(target: Transform): void {
    this.position.copy(target.position);
    this.orientation.copy(target.orientation);
  }

  follow(target: Transform, elapsed: number): void {
    const away = this.position.distanceTo(target.position);
    const turned = 1 - Math.abs(this.orientation.dot(target.orientation));
    if (away > JUMP || (away < STILL && turned < STILL * STILL)) {
      this.set(target);
      return;
    }
    const share = 1 - Math.exp(-elapsed / LAG);
    this.position.lerp(target.position, share);
    this.orientation.slerp(target.orientation, share);
  }
}
