/** Main value of a joint: a wheel's velocity, otherwise the position. */

import type { JointInfo } from "../../protocol/generated/page_messages";
import type { JointState } from "../../scene/simulated_world";
import { fixed } from "../../theme/format";

export interface JointValue {
  /** True for joints without limits, which are set by their velocity. */
  readonly isVelocity: boolean;
  readonly value: number;
  readonly unit: string;
  readonly decimals: number;
  readonly text: string;
  /** Characters of the longest text within the joint's limits. */
  readonly length: number;
}

/** Velocity of a joint without limits that its slider reaches [rad/s or m/s]. */
export const MAX_VELOCITY = 10;

/** True for a joint without limits, whose position has no meaning. */
export function turnsFreely(joint: JointInfo): boolean {
  return joint.lower === null || joint.upper === null;
}

export function jointValue(joint: JointInfo, state: JointState): JointValue {
  const isVelocity = turnsFreely(joint);
  const value = isVelocity ? state.velocity : state.position;
  const metres = joint.type === "prismatic" || joint.type === "screw";
  const unit = `${metres ? "m" : "rad"}${isVelocity ? "/s" : ""}`;
  const decimals = metres ? 3 : 2;
  const ends = isVelocity ? [-MAX_VELOCITY] : [joint.lower, joint.upper];
  const length = Math.max(...ends.map((end) => fixed(end, decimals).length));
  return { isVelocity, value, unit, decimals, text: fixed(value, decimals), length };
}
