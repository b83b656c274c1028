/** A joint: its frame, its axes, and the range that it may move in. */

import { CircleGeometry, Euler, Group, Quaternion, RingGeometry, Vector3, type Object3D } from "three";

import type { JointInfo } from "../../protocol/generated/page_messages";
import type { Triple } from "../simulated_world";
import { area, arrow, COLORS, lines, triad } from "./overlay_shapes";

const Z = new Vector3(0, 0, 1);
const SEGMENTS = 48;
const TURN = 2 * Math.PI;

/** Drawing of a joint in the frame of its child. */
export interface JointDrawing {
  readonly object: Object3D;
  /** Turn or shift the range against a joint position, so that it stays with the parent [rad, m]. */
  move(position: number): void;
}

/** Draw a joint; `size` is the length of its axis [m]. */
export function drawJoint({ pose, axes, type, lower, upper }: JointInfo, size: number): JointDrawing {
  const object = new Group();
  const [x, y, z, roll, pitch, yaw] = pose;
  object.position.set(x, y, z);
  const frame = triad(0.5 * size);
  frame.quaternion.setFromEuler(new Euler(roll, pitch, yaw, "ZYX"));
  object.add(frame);
  if (type === "fixed") return { object, move: () => undefined };
  const directions = axes.map((axis: Triple) => new Vector3(...axis));
  for (const direction of directions) object.add(arrow(direction, size, COLORS.axis));
  const [first] = directions;
  if (first === undefined) return { object, move: () => undefined };
  const range = type === "prismatic" ? slide(first, lower, upper, size) : sector(first, lower, upper, 0.7 * size);
  object.add(range);
  const turn = new Quaternion();
  const orientation = range.quaternion.clone();
  return {
    object,
    move: (position) => {
      if (type === "prismatic") range.position.copy(first).multiplyScalar(-position);
      else range.quaternion.copy(turn.setFromAxisAngle(first, -position)).multiply(orientation);
    },
  };
}

/** Range of a revolute joint as a sector, or a circle; a needle shows zero. */
function sector(axis: Vector3, lower: number | null, upper: number | null, radius: number): Object3D {
  const group = new Group();
  group.quaternion.setFromUnitVectors(Z, axis);
  const isLimited = lower !== null && upper !== null && upper - lower < TURN;
  const [from, length] = isLimited ? [lower, upper - lower] : [0, TURN];
  const shape = isLimited
    ? new CircleGeometry(radius, SEGMENTS, from, length)
    : new RingGeometry(0.96 * radius, radius, SEGMENTS);
  const mesh = area(shape, COLORS.limit, isLimited ? 0.3 : 0.9);
  mesh.userData["ownGeometry"] = true;
  group.add(mesh);
  if (!isLimited) return group;
  const end = (angle: number): number[] => [0, 0, 0, radius * Math.cos(angle), radius * Math.sin(angle), 0];
  group.add(lines([...end(lower), ...end(upper)], COLORS.limit));
  return group;
}

/** Range of a prismatic joint, with a tick at each end. */
function slide(axis: Vector3, lower: number | null, upper: number | null, size: number): Object3D {
  const group = new Group();
  if (lower === null || upper === null) return group;
  const across = new Vector3(1, 0, 0).cross(axis);
  if (across.lengthSq() < 0.01) across.set(0, 1, 0).cross(axis);
  across.setLength(0.2 * size);
  const [from, to] = [axis.clone().multiplyScalar(lower), axis.clone().multiplyScalar(upper)];
  const tick = (at: Vector3): Vector3[] => [at.clone().add(across), at.clone().sub(across)];
  group.add(
    lines(
      [from, to, ...tick(from), ...tick(to)].flatMap((point) => point.toArray()),
      COLORS.limit,
    ),
  );
  return group;
}
