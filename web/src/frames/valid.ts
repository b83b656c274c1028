/** Checks of numbers in messages, as rviz makes them before it draws. */

import { Quaternion, Vector3, type Object3D } from "three";

import type { Pose, Point, Quaternion as Xyzw } from "../protocol/generated/ros_messages";

export const INVALID_FLOATS = "Message contained invalid floating point values (nans or infs)";

export function areFinite(numbers: Iterable<number>): boolean {
  for (const number of numbers) if (!Number.isFinite(number)) return false;
  return true;
}

export function isFiniteXyz({ x, y, z }: Point): boolean {
  return Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(z);
}

export function isFinitePose({ position, orientation }: Pose): boolean {
  return isFiniteXyz(position) && isFiniteXyz(orientation) && Number.isFinite(orientation.w);
}

export function vector({ x, y, z }: Point): Vector3 {
  return new Vector3(x, y, z);
}

/** The unit quaternion of a message; one of zeros stands for no rotation. */
export function quaternion({ x, y, z, w }: Xyzw): Quaternion {
  if (x === 0 && y === 0 && z === 0 && w === 0) return new Quaternion();
  return new Quaternion(x, y, z, w).normalize();
}

/** Put an object at a pose of a message. */
export function placed(object: Object3D, { position, orientation }: Pose): Object3D {
  object.position.copy(vector(position));
  object.quaternion.copy(quaternion(orientation));
  return object;
}
