/**
 * Joints that bring a tip as near to a pose as they can: least squares by Levenberg and Marquardt, with a numeric Jacobian
 * (D. W. Marquardt, An algorithm for least-squares estimation of nonlinear parameters, 1963).
 */

import { Matrix4, Quaternion, Vector3 } from "three";

import type { ArmGroup, ArmModel, Positions } from "./arm_model";

const STEPS = 40;
const DIFFERENCE = 1e-5;
/** Damping at first; it is lower after a step that comes nearer, and higher after one that does not. */
const DAMPING = 0.1;
const MIN_DAMPING = 1e-4;
/** Largest change of a joint in a step [rad, m]. */
const MAX_STEP = 0.2;
/** Weight of a radian against a metre. */
const TURN_WEIGHT = 0.3;

export interface Reach {
  readonly model: ArmModel;
  readonly group: ArmGroup;
  readonly tip: string;
  /** Pose in the model's frame. */
  readonly target: Matrix4;
  readonly seed: Positions;
  /** Pose of the root link in the model's frame. */
  readonly root: Matrix4;
}

/** Positions of the group's joints, within their limits, from the seed on. */
export function nearestPose(reach: Reach): Positions {
  const { group, seed, model } = reach;
  const whole = model.complete(seed);
  let best = group.joints.map(({ name }) => whole.get(name) ?? 0);
  let error = errorOf(reach, best);
  let damping = DAMPING;
  for (let step = 0; step < STEPS; step++) {
    const columns = best.map((value, index) => {
      const moved = errorOf(reach, best.with(index, value + DIFFERENCE));
      return moved.map((part, row) => (part - (error[row] ?? 0)) / DIFFERENCE);
    });
    const change = dampedStep(columns, error, damping);
    const next = group.joints.map(({ lower, upper, isContinuous }, index) => {
      const to = (best[index] ?? 0) - Math.max(-MAX_STEP, Math.min(MAX_STEP, change[index] ?? 0));
      return isContinuous ? to : Math.max(lower, Math.min(upper, to));
    });
    const nextError = errorOf(reach, next);
    const isNearer = Math.hypot(...nextError) < Math.hypot(...error);
    if (isNearer) [best, error] = [next, nextError];
    damping = Math.max(MIN_DAMPING, damping * (isNearer ? 0.5 : 3));
  }
  return new Map(group.joints.map(({ name }, index) => [name, best[index] ?? 0]));
}

const position = new Vector3();
const goal = new Vector3();
const turn = new Quaternion();
const goalTurn = new Quaternion();
const scale = new Vector3();

/** Tip minus target: a vector [m] and a rotation vector [rad], weighted. */
function errorOf({ model, group, tip, target, seed, root }: Reach, joints: readonly number[]): readonly number[] {
  const positions = new Map(seed);
  group.joints.forEach(({ name }, index) => positions.set(name, joints[index] ?? 0));
  (model.forward(positions, root).get(tip) ?? root).decompose(position, turn, scale);
  target.decompose(goal, goalTurn, scale);
  position.sub(goal);
  turn.multiply(goalTurn.invert());
  const sign = turn.w < 0 ? -1 : 1;
  const sine = Math.hypot(turn.x, turn.y, turn.z);
  const factor = sine < 1e-9 ? 2 * sign : (2 * sign * Math.atan2(sine, Math.abs(turn.w))) / sine;
  return [position.x, position.y, position.z, ...[turn.x, turn.y, turn.z].map((part) => TURN_WEIGHT * factor * part)];
}

/** Solution of (JᵀJ + λ²I) x = Jᵀe by Gaussian elimination; `columns` are J's. */
function dampedStep(
  columns: readonly (readonly number[])[],
  error: readonly number[],
  damping: number,
): readonly number[] {
  const dot = (a: readonly number[], b: readonly number[]): number =>
    a.reduce((sum, value, row) => sum + value * (b[row] ?? 0), 0);
  const rows = columns.map((column, index) => [
    ...columns.map((other, at) => dot(column, other) + (at === index ? damping ** 2 : 0)),
    dot(column, error),
  ]);
  const count = rows.length;
  rows.forEach((pivot, index) => {
    // the matrix is positive definite: no pivot is 0
    for (const row of rows.slice(index + 1)) {
      const factor = (row[index] ?? 0) / (pivot[index] ?? 1);
      for (let at = index; at <= count; at++) row[at] = (row[at] ?? 0) - factor * (pivot[at] ?? 0);
    }
  });
  const result = new Array<number>(count).fill(0);
  for (let index = count - 1; index >= 0; index--) {
    const row = rows[index] ?? [];
    const known = result.reduce((sum, value, at) => (at > index ? sum + value * (row[at] ?? 0) : sum), 0);
    result[index] = ((row[count] ?? 0) - known) / (row[index] ?? 1);
  }
  return result;
}
