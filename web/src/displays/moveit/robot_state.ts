/** Robot states of messages: positions of joints, and the pose of the root link. */

import { Matrix4, Quaternion, Vector3 } from "three";

import type { JointState, Pose, RobotState } from "../../protocol/generated/ros_messages";
import type { RosMessage } from "../../protocol/ros_types";
import type { ArmModel, Positions } from "./arm_model";

/** Positions of the joints that a message names. */
export function positionsOf({ name, position }: Pick<JointState, "name" | "position">): Map<string, number> {
  const positions = new Map<string, number>();
  name.forEach((joint, index) => {
    const value = position[index];
    if (value !== undefined && Number.isFinite(value)) positions.set(joint, value);
  });
  return positions;
}

/** Pose of the root link in the model's frame, from the virtual joint's transform; null: the message has none. */
export function rootOf(model: ArmModel, { multi_dof_joint_state: multi }: RobotState): Matrix4 | null {
  const transform = multi.transforms[multi.joint_names.indexOf(model.virtualJoint)];
  if (transform === undefined) return null;
  const { translation: t, rotation: r } = transform;
  const turn = new Quaternion(r.x, r.y, r.z, r.w);
  if (turn.lengthSq() === 0) turn.identity();
  return new Matrix4().compose(new Vector3(t.x, t.y, t.z), turn.normalize(), new Vector3(1, 1, 1));
}

/** Message of a state; what it does not name, the planning scene has. */
export function stateMessage(positions: Positions): RosMessage {
  return {
    joint_state: { name: [...positions.keys()], position: Float64Array.from(positions.values()) },
    is_diff: true,
  };
}

export function poseOf(matrix: Matrix4): Pose {
  const [position, turn, scale] = [new Vector3(), new Quaternion(), new Vector3()];
  matrix.decompose(position, turn, scale);
  return {
    position: { x: position.x, y: position.y, z: position.z },
    orientation: { x: turn.x, y: turn.y, z: turn.z, w: turn.w },
  };
}
