/** Velocities of a body from two of its poses, and angles of its orientation. */

import { Quaternion, type Vector3 } from "three";

const WINDOW = 0.2; // s

export interface StampedPose {
  /** [s] */
  readonly time: number;
  readonly position: Vector3;
  readonly orientation: Quaternion;
}

/** Linear [m/s] and angular [rad/s] velocity in the poses' frame. */
export interface Twist {
  readonly linear: readonly [number, number, number];
  readonly angular: readonly [number, number, number];
}

/** The mean twist between two poses; null where no time lies between or time went back. */
export function twistOf(first: StampedPose, second: StampedPose): Twist | null {
  const seconds = second.time - first.time;
  if (seconds <= 0) return null;
  const { x, y, z } = second.position.clone().sub(first.position).divideScalar(seconds);
  const turn = second.orientation.clone().multiply(new Quaternion().copy(first.orientation).invert());
  if (turn.w < 0) turn.set(-turn.x, -turn.y, -turn.z, -turn.w);
  const sine = Math.hypot(turn.x, turn.y, turn.z);
  const scale = (sine < 1e-9 ? 2 : (2 * Math.atan2(sine, turn.w)) / sine) / seconds;
  return { linear: [x, y, z], angular: [turn.x * scale, turn.y * scale, turn.z * scale] };
}

/** Poses of the last moments. */
export class MotionSamples {
  private samples: StampedPose[] = [];

  /** Add a pose, later than the previous ones unless time went back. */
  add(pose: StampedPose): void {
    const isRecent = ({ time }: StampedPose): boolean => time < pose.time && time >= pose.time - WINDOW;
    const recent = this.samples.filter(isRecent);
    this.samples = [...(recent.length > 0 ? recent : this.samples.slice(-1)), pose];
  }

  /** The mean twist of the last moments; null before the second pose. */
  twist(): Twist | null {
    const [first, last] = [this.samples[0], this.samples.at(-1)];
    return first === undefined || last === undefined ? null : twistOf(first, last);
  }
}

/** Roll, pitch and yaw [rad] of R = Rz(yaw) Ry(pitch) Rx(roll), as URDF and SDF have them. */
export function rollPitchYaw({ x, y, z, w }: Quaternion): readonly [number, number, number] {
  const pitch = Math.asin(Math.min(1, Math.max(-1, 2 * (w * y - z * x))));
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    pitch,
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
}
