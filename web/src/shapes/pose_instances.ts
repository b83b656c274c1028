/** Copies of an arrow or of axes at many poses. */

import { Matrix4, Vector3 } from "three";

import type { Pose } from "../protocol/generated/ros_messages";
import type { Rgb } from "../rviz/properties";
import { quaternion, vector } from "../frames/valid";
import { Instances } from "./instances";
import { arrowGeometry, axesGeometry, type ArrowProportions } from "./solids";

export function arrowsAt(poses: readonly Pose[], proportions: ArrowProportions, color: Rgb, alpha = 1): Instances {
  const arrows = new Instances(arrowGeometry(proportions), {}, Math.max(1, poses.length));
  place(arrows, poses);
  const [red, green, blue] = color;
  poses.forEach((_, index) => arrows.setRgbaAt(index, red / 255, green / 255, blue / 255, alpha));
  arrows.finish();
  return arrows;
}

export function axesAt(poses: readonly Pose[], length: number, radius: number): Instances {
  const axes = new Instances(axesGeometry(length, radius), { vertexColors: true }, Math.max(1, poses.length));
  place(axes, poses);
  axes.finish();
  return axes;
}

function place(instances: Instances, poses: readonly Pose[]): void {
  const matrix = new Matrix4();
  const one = new Vector3(1, 1, 1);
  instances.begin(poses.length);
  poses.forEach(({ position, orientation }, index) => {
    instances.setMatrixAt(index, matrix.compose(vector(position), quaternion(orientation), one));
  });
}
