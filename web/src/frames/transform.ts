/** Poses of frames in frames. */

import type { Quaternion, Vector3 } from "three";

/** Pose of a source frame in a target frame [m]. */
export interface Transform {
  readonly position: Vector3;
  readonly orientation: Quaternion;
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
