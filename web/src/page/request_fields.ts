/** Fields of requests to the server. */

import { Euler, Quaternion, type Vector3 } from "three";

import type { SetPose } from "../protocol/generated/page_messages";

/** A pose as requests have it: position [m] and a quaternion wxyz. */
export function poseFields(position: Vector3, { x, y, z, w }: Quaternion): Pick<SetPose, "position" | "orientation"> {
  return { position: position.toArray(), orientation: [w, x, y, z] };
}

/** The orientation R = Rz(yaw) Ry(pitch) Rx(roll) [rad], as URDF and SDF have it. */
export function orientationOf([roll, pitch, yaw]: readonly [number, number, number]): Quaternion {
  return new Quaternion().setFromEuler(new Euler(roll, pitch, yaw, "ZYX"));
}

/** Numbers with one of them replaced. */
export function withNumber<T extends readonly number[]>(numbers: T, index: number, value: number): T {
  return numbers.map((number, i) => (i === index ? value : number)) as unknown as T;
}
