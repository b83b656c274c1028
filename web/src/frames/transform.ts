/** Poses of frames in frames. */

import type { Quaternion, Vector3 } from "three";

/** Pose of a source frame in a target frame [m]. */
export interface Transform {
  readonly position: Vector3;
  readonly orientation: Quaternion;
}

/** Smaller changes of positions [m] and of the numbers of quaternions cannot be seen. */
const UNSEEN = 1e-4;
const UNSEEN_TURN = 5e-5;

/** True if a pose cannot be told from another one in a picture. */
export function looksSame(position: Vector3, turn: Quaternion, { position: to, orientation }: Transform): boolean {
  const { x, y, z, w } = orientation;
  const turned = (turn.x - x) ** 2 + (turn.y - y) ** 2 + (turn.z - z) ** 2 + (turn.w - w) ** 2;
  return position.distanceToSquared(to) < UNSEEN ** 2 && turned < UNSEEN_TURN ** 2;
}

/** The reason why there is no transform, in rviz's words. */
export class NoTransform {
  constructor(
    /** "No transform from [laser] to [map]" */
    readonly text: string,
    /** Advice: "nothing publishes laser. Frames here: base_link, odom" */
    readonly advice: string,
  ) {}
}
