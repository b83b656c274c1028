/** Trajectories of messages as waypoints. */

import { Matrix4, Quaternion, Vector3 } from "three";

import type { RobotTrajectory } from "../../protocol/generated/ros_messages";
import { seconds } from "../../protocol/ros_types";
import type { ArmModel, Positions } from "./arm_model";

export interface Waypoint {
  /** Positions of the joints that the trajectory moves. */
  readonly positions: Positions;
  /** Pose of the root link in the model's frame; null: as in the start state. */
  readonly root: Matrix4 | null;
  /** Time since the trajectory's start [s]. */
  readonly time: number;
}

/** Waypoints of trajectories one after the other; unreadable points are left out. */
export function waypointsOf(model: ArmModel, trajectories: readonly RobotTrajectory[]): readonly Waypoint[] {
  const all: Waypoint[] = [];
  for (const { joint_trajectory: joints, multi_dof_joint_trajectory: multi } of trajectories) {
    const start = all.at(-1)?.time ?? 0;
    const held = all.at(-1)?.positions ?? new Map<string, number>();
    const at = multi.joint_names.indexOf(model.virtualJoint);
    const count = Math.max(joints.points.length, at < 0 ? 0 : multi.points.length);
    for (let index = 0; index < count; index++) {
      const point = joints.points[index];
      const moved = multi.points[index];
      const positions = new Map(held);
      joints.joint_names.forEach((name, joint) => {
        const value = point?.positions[joint];
        if (value !== undefined && Number.isFinite(value)) positions.set(name, value);
      });
      const time = seconds(point?.time_from_start ?? moved?.time_from_start ?? { sec: 0, nsec: 0 });
      const transform = moved?.transforms[at];
      all.push({ positions, root: transform === undefined ? null : matrixOf(transform), time: start + time });
    }
  }
  return all;
}

function matrixOf({
  translation: t,
  rotation: r,
}: {
  readonly translation: { readonly x: number; readonly y: number; readonly z: number };
  readonly rotation: { readonly x: number; readonly y: number; readonly z: number; readonly w: number };
}): Matrix4 {
  const turn = new Quaternion(r.x, r.y, r.z, r.w);
  if (turn.lengthSq() === 0) turn.identity();
  return new Matrix4().compose(new Vector3(t.x, t.y, t.z), turn.normalize(), new Vector3(1, 1, 1));
}

/** How fast an animation goes: a factor of the trajectory's own time, or seconds for each waypoint. */
export type Pace = { readonly factor: number } | { readonly period: number };

/** rviz's State Display Time: "3x", "REALTIME", "0.05 s"; null: none of these. */
export function readPace(text: string): Pace | null {
  const plain = text.trim().toLowerCase();
  if (plain === "realtime") return { factor: 1 };
  const [, digits = "", unit = ""] = /^(\d*\.?\d+)\s*(x|s)?$/.exec(plain) ?? [];
  const value = Number(digits);
  if (digits === "" || !(value > 0)) return null;
  return unit === "x" ? { factor: value } : { period: value };
}

/** A trajectory that takes longer by lower speeds and accelerations: scaling factors in (0, 1]. */
export function slowed(trajectory: RobotTrajectory, velocity: number, acceleration: number): RobotTrajectory {
  const pace = Math.min(velocity, Math.sqrt(acceleration));
  if (!(pace > 0) || pace >= 1) return trajectory;
  const { joint_trajectory: joints } = trajectory;
  const points = joints.points.map((point) => {
    const nanoseconds = Math.round((seconds(point.time_from_start) / pace) * 1e9);
    return {
      ...point,
      velocities: point.velocities.map((value) => value * pace),
      accelerations: point.accelerations.map((value) => value * pace * pace),
      time_from_start: { sec: Math.floor(nanoseconds / 1e9), nsec: nanoseconds % 1e9 },
    };
  });
  return { ...trajectory, joint_trajectory: { ...joints, points } };
}
