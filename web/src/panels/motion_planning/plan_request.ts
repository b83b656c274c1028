/** Requests to move_group, made from a display's queries and settings. */

import type { Matrix4 } from "three";

import type { MotionPlanningDisplay } from "../../displays/motion_planning";
import type { ArmGroup, ArmModel } from "../../displays/moveit/arm_model";
import { CURRENT } from "../../displays/moveit/query";
import { poseOf, stateMessage } from "../../displays/moveit/robot_state";
import type { Triple } from "../../rviz/properties";
import type { RosMessage } from "../../protocol/ros_types";

/** Tolerance of a goal's joints, as of MoveGroupInterface [rad, m]. */
const JOINT_TOLERANCE = 1e-4;
/** Distance between the points of a straight path, as rviz has it [m]. */
const CARTESIAN_STEP = 0.01;
const REPLAN_ATTEMPTS = 5;
const REPLAN_DELAY_S = 2;

export interface Planner {
  readonly pipeline: string;
  readonly planner: string;
}

/** Start state: the robot's own where the query follows it. */
function startState({ startQuery }: MotionPlanningDisplay): RosMessage {
  return startQuery.choice.peek() === CURRENT ? { is_diff: true } : stateMessage(startQuery.positions.peek());
}

/** Goal of the action move_group. */
export function moveGroupGoal(
  display: MotionPlanningDisplay,
  model: ArmModel,
  group: ArmGroup,
  { pipeline, planner }: Planner,
  planOnly: boolean,
): RosMessage {
  const { settings, goalQuery } = display;
  const goal = model.complete(goalQuery.positions.peek());
  const [center, size] = [settings.workspaceCenter.value.peek(), settings.workspaceSize.value.peek()];
  return {
    request: {
      workspace_parameters: {
        header: { frame_id: model.frame },
        min_corner: corner(center, size, -0.5),
        max_corner: corner(center, size, 0.5),
      },
      start_state: startState(display),
      goal_constraints: [
        {
          joint_constraints: group.joints.map(({ name }) => ({
            joint_name: name,
            position: goal.get(name) ?? 0,
            tolerance_above: JOINT_TOLERANCE,
            tolerance_below: JOINT_TOLERANCE,
            weight: 1,
          })),
        },
      ],
      pipeline_id: pipeline,
      planner_id: planner,
      group_name: group.name,
      num_planning_attempts: settings.attempts.value.peek(),
      allowed_planning_time: settings.planningTime.value.peek(),
      max_velocity_scaling_factor: settings.velocityScaling.value.peek(),
      max_acceleration_scaling_factor: settings.accelerationScaling.value.peek(),
    },
    planning_options: {
      planning_scene_diff: { is_diff: true, robot_state: { is_diff: true } },
      plan_only: planOnly,
      replan: settings.replanning.value.peek(),
      replan_attempts: settings.replanning.value.peek() ? REPLAN_ATTEMPTS : 0,
      replan_delay: REPLAN_DELAY_S,
    },
  };
}

/** Request for a straight path of a tip to where the goal has it; null: the group has no tip. */
export function cartesianRequest(
  display: MotionPlanningDisplay,
  model: ArmModel,
  group: ArmGroup,
  root: Matrix4,
): RosMessage | null {
  const [tip] = group.tips;
  const target = tip === undefined ? undefined : model.forward(display.goalQuery.positions.peek(), root).get(tip);
  if (tip === undefined || target === undefined) return null;
  return {
    header: { frame_id: model.frame },
    start_state: startState(display),
    group_name: group.name,
    link_name: tip,
    waypoints: [poseOf(target)],
    max_step: CARTESIAN_STEP,
    avoid_collisions: true,
  };
}

function corner(center: Triple, size: Triple, share: number): RosMessage {
  const [x, y, z] = center.map((middle, axis) => middle + share * (size[axis] ?? 0));
  return { x: x ?? 0, y: y ?? 0, z: z ?? 0 };
}
