/** moveit_msgs/MoveItErrorCodes in words. */

export const SUCCESS = 1;
export const NO_IK_SOLUTION = -31;

/** Code, its name, by which people search, and its words. */
const CODES: readonly (readonly [number, string, string])[] = [
  [99999, "FAILURE", "It failed, for a reason that move_group does not name"],
  [-1, "PLANNING_FAILED", "No path was found"],
  [-2, "INVALID_MOTION_PLAN", "The path that was found is not valid"],
  [-3, "MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE", "Something moved into the path"],
  [-4, "CONTROL_FAILED", "The controllers did not reach the goal"],
  [-5, "UNABLE_TO_AQUIRE_SENSOR_DATA", "The sensors bring no data"],
  [-6, "TIMED_OUT", "The planning time is over"],
  [-7, "PREEMPTED", "It was stopped"],
  [-10, "START_STATE_IN_COLLISION", "The start state is in collision"],
  [-11, "START_STATE_VIOLATES_PATH_CONSTRAINTS", "The start state violates the path's constraints"],
  [-12, "GOAL_IN_COLLISION", "The goal is in collision"],
  [-13, "GOAL_VIOLATES_PATH_CONSTRAINTS", "The goal violates the path's constraints"],
  [-14, "GOAL_CONSTRAINTS_VIOLATED", "The goal's constraints are violated"],
  [-15, "INVALID_GROUP_NAME", "There is no group of this name"],
  [-16, "INVALID_GOAL_CONSTRAINTS", "The goal's constraints are not valid"],
  [-17, "INVALID_ROBOT_STATE", "The robot's state is not valid"],
  [-18, "INVALID_LINK_NAME", "There is no link of this name"],
  [-19, "INVALID_OBJECT_NAME", "There is no object of this name"],
  [-21, "FRAME_TRANSFORM_FAILURE", "A frame of the request has no transform"],
  [-22, "COLLISION_CHECKING_UNAVAILABLE", "Collisions cannot be checked"],
  [-23, "ROBOT_STATE_STALE", "The robot's state is too old"],
  [-24, "SENSOR_INFO_STALE", "The sensors' data are too old"],
  [-25, "COMMUNICATION_FAILURE", "A node of the request does not answer"],
  [-26, "START_STATE_INVALID", "The start state is not valid"],
  [-27, "GOAL_STATE_INVALID", "The goal state is not valid"],
  [-28, "UNRECOGNIZED_GOAL_TYPE", "move_group does not know this kind of goal"],
  [-29, "CRASH", "The planner crashed"],
  [-30, "ABORT", "It was aborted"],
  [NO_IK_SOLUTION, "NO_IK_SOLUTION", "No configuration reaches the pose"],
];

/** Sentence for a code: "No path was found (PLANNING_FAILED)." */
export function words(code: number): string {
  if (code === SUCCESS) return "Done.";
  const row = CODES.find(([each]) => each === code);
  return row === undefined ? `It failed with code ${code}.` : `${row[2]} (${row[1]}).`;
}
