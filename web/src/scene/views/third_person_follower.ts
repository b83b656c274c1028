/** rviz's ThirdPersonFollower: a view of the ground at a frame that turns with the frame's yaw. */

import { Euler, Quaternion, Vector3 } from "three";

import type { Transform } from "../../frames/transform";
import { XYOrbit } from "./xy_orbit";

export class ThirdPersonFollower extends XYOrbit {
  override readonly className = "rviz/ThirdPersonFollower";

  /** Target's position on the ground, turned by its yaw. */
  protected override frameOf(target: Transform): Transform {
    const yaw = new Euler().setFromQuaternion(target.orientation, "ZYX").z;
    return {
      position: target.position.clone().setZ(0),
      orientation: new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), yaw),
    };
  }
}
