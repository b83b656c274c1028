/** Main value of a joint: a wheel's velocity, otherwise the position. */

import type { JointInfo } from "../../protocol/generated/page_messages";
import type { JointState } from "../../scene/simulated_world";
import { fixed } from "../../theme/format";

export interface JointValue {
  /** True for joints without limits, which are set by their velocity. */
  readonly isVelocity: boolean;
  readonly value: number;
  readonly unit: string;
  readonly text: string;
}

/** True for a joint without limits, whose position has no meaning. */
export function turnsFreely(joint: JointInfo): boolean {
  return joint.lower === null || joint.upper === null;
}

export function jointValue(joint: JointInfo, state: JointState): JointValue {
  const isVelocity = turnsFreely(joint);
  const value = isVelocity ? state.velocity : state.position;
  const metres = joint.type === "prismatic" || joint.type === "screw";
  const unit = `${metres ? "m" : "rad"}${isVelocity ? "/s" : ""}`;
  return { isVelocity, value, unit, text: `${fixed(value, metres ? 3 : 2)} ${unit}` };
}
