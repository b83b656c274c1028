/** Ways to set a query's state: the robot's, a named one of the SRDF, a random one. */

import type { MotionPlanningDisplay } from "../../displays/motion_planning";
import type { ArmGroup, Positions } from "../../displays/moveit/arm_model";
import { CURRENT, type Query } from "../../displays/moveit/query";
import { stateMessage } from "../../displays/moveit/robot_state";
import type { MotionPlanningState } from "./motion_planning_state";

const RANDOM_VALID = "<random valid>";
const RANDOM = "<random>";
const PREVIOUS = "<previous>";
/** Random states that are tried; MoveIt tries as many. */
const ATTEMPTS = 100;

/** rviz's choices, then the names of the group's states. */
export function choicesOf(query: Query, group: ArmGroup | null): readonly string[] {
  const same = `<same as ${query.name === "start" ? "goal" : "start"}>`;
  return [RANDOM_VALID, RANDOM, CURRENT, same, PREVIOUS, ...(group?.states.keys() ?? [])];
}

/** Set a query by one of its choices; resolves to a sentence if that is not possible, otherwise to "". */
export async function choose(
  state: MotionPlanningState,
  display: MotionPlanningDisplay,
  query: Query,
  choice: string,
): Promise<string> {
  const group = display.group.peek();
  if (group === null) return "There is no planning group: see the display's status.";
  const other = query.name === "start" ? display.goalQuery : display.startQuery;
  switch (choice) {
    case CURRENT:
      query.set(display.current.peek(), CURRENT);
      return "";
    case RANDOM:
      query.set(random(group));
      return "";
    case RANDOM_VALID:
      return setValid(state, query, group);
    case PREVIOUS:
      if (query.kept === null) return "Nothing was planned before.";
      query.set(query.kept);
      return "";
    default:
      break;
  }
  if (choice.startsWith("<same as")) {
    query.set(other.positions.peek());
    return "";
  }
  const named = group.states.get(choice);
  if (named === undefined) return `The group ${group.name} has no state ${choice}.`;
  query.set(named, choice);
  return "";
}

async function setValid(state: MotionPlanningState, query: Query, group: ArmGroup): Promise<string> {
  const service = state.serviceName("check_state_validity");
  for (let attempt = 0; attempt < ATTEMPTS; attempt++) {
    const positions = random(group);
    const whole = new Map([...query.positions.peek(), ...positions]);
    const request = { robot_state: stateMessage(whole), group_name: group.name };
    const answer = await state.page.connection.callService(service, request);
    if (answer["valid"] !== true) continue;
    query.set(positions);
    return "";
  }
  return `Of ${ATTEMPTS} random states of ${group.name}, all are in collision.`;
}

function random({ joints }: ArmGroup): Positions {
  return new Map(joints.map(({ name, lower, upper }) => [name, lower + Math.random() * (upper - lower)]));
}
