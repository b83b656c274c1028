/** Goals of navigation, their state, and the robot's pose by localization. */

import type { ComponentChildren, JSX } from "preact";

import type { QueuedGoal } from "../page/goal_queue";
import { canControl, VIEW_ONLY } from "../page/view_only";
import type { Page } from "../page/page";
import type { PoseWithCovarianceStamped } from "../protocol/generated/ros_messages";
import { Button } from "../theme/button";
import { fixed } from "../theme/format";
import { Select } from "../theme/select";
import { yawOf } from "./navigation/map_files";
import { navigationState } from "./navigation/navigation_state";
import type { Panel, PanelProps } from "./panel";
import { Split } from "./parts";

const GOAL_TOOL = "rviz/SetGoal";
const POSE_TOOL = "rviz/SetInitialPose";
const DEGREES = 180 / Math.PI;
/** What the robot does, by the number of actionlib's state. */
const STATUS = [
  "Goal received",
  "Driving",
  "Canceled",
  "Reached",
  "Failed",
  "Goal refused",
  "Stopping",
  "Stopping",
  "Canceled",
  "Lost",
];

function Navigation({ page }: PanelProps): JSX.Element {
  const state = navigationState(page);
  const goals = page.goals.goals.value;
  if (state.server.value === null) return <div class="empty">Nothing navigates: no node has the action move_base.</div>;
  return (
    <Split head={<Head page={page} />} detail={<Detail page={page} />}>
      {goals.length === 0 && (
        <div class="empty">
          {canControl(page) ? "“Add goals”, then press at each place and drag in its direction." : VIEW_ONLY}
        </div>
      )}
      {goals.length > 0 && <Goals page={page} goals={goals} />}
    </Split>
  );
}

function Head({ page }: PanelProps): JSX.Element {
  const state = navigationState(page);
  const { tools, goals } = page;
  const { collects } = goals;
  const { servers, server } = state;
  const isOff = !canControl(page);
  const isWaiting = goals.goals.value.some((goal) => goal.state === "waiting");
  const addGoals = (): void => {
    const isAdding = collects.peek();
    collects.value = !isAdding;
    tools.use(isAdding ? "rviz/Interact" : GOAL_TOOL);
  };
  return (
    <div class="toolrow">
      {servers.value.length > 1 && (
        <Select
          label="Robot's action"
          value={server.value ?? ""}
          choices={servers.value}
          onChange={(name) => void (state.chosen.value = name)}
        />
      )}
      <Button small icon="pose" disabled={isOff} onClick={() => tools.use(POSE_TOOL)}>
        2D Pose Estimate
      </Button>
      <Button small icon="goal" on={collects.value} disabled={isOff} onClick={addGoals}>
        Add goals
      </Button>
      <span class="sp" />
      {isWaiting && !state.isRunning.value && (
        <Button small icon="play" tone="primary" disabled={isOff} onClick={() => state.start()}>
          Start
        </Button>
      )}
      <Button small icon="close" disabled={isOff} onClick={() => state.stop()}>
        Stop
      </Button>
    </div>
  );
}

function Goals({ page, goals }: PanelProps & { readonly goals: readonly QueuedGoal[] }): JSX.Element {
  return (
    <table class="data">
      <caption class="sr">Goals in the order in which the robot drives to them</caption>
      <thead>
        <tr>
          <th scope="col">Goal</th>
          <th scope="col">State</th>
          {["x", "y", "Yaw"].map((title) => (
            <th key={title} scope="col" class="num">
              {title}
            </th>
          ))}
          <th scope="col">
            <span class="sr">Remove</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {goals.map((goal) => (
          <tr key={goal.number} title={goal.reason}>
            <td>{goal.number}</td>
            <td class={goal.state === "failed" ? "warned" : ""}>
              {goal.state}
              {goal.reason !== "" && `: ${goal.reason}`}
            </td>
            <td class="num">{fixed(goal.pose.position.x, 2)}</td>
            <td class="num">{fixed(goal.pose.position.y, 2)}</td>
            <td class="num">{fixed(yawOf(goal.pose.orientation) * DEGREES, 0)}°</td>
            <td class="num">
              <Button
                small
                icon="close"
                label={`Remove goal ${goal.number}`}
                disabled={!canControl(page)}
                onClick={() => page.goals.remove(goal.number)}
              />
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Detail({ page }: { readonly page: Page }): JSX.Element {
  const state = navigationState(page);
  const status = state.status.value;
  const recovery = state.recovery.value;
  const pose = state.pose.value;
  return (
    <div class="scroll navigation">
      {state.fault.value !== "" && (
        <div class="fault pad" role="alert">
          {state.fault.value}
        </div>
      )}
      <Row label="State">
        <span role="status">{status === null ? "No goal" : (STATUS[status.status] ?? "Unknown")}</span>
        {status !== null && status.text !== "" && <span class="t2"> {status.text}</span>}
      </Row>
      <Row label="Distance to goal">{metres(state.distance.value)}</Row>
      {recovery !== null && (
        <Row label="Recovery">
          {recovery.recovery_behavior_name}, {recovery.current_recovery_number + 1} of{" "}
          {recovery.total_number_of_recoveries}
        </Row>
      )}
      {pose !== null && <Localization pose={pose} />}
    </div>
  );
}

/** Pose with the standard deviation of each part. */
function Localization({ pose: { pose } }: { readonly pose: PoseWithCovarianceStamped }): JSX.Element {
  const { position, orientation } = pose.pose;
  const deviation = (index: number): number => Math.sqrt(pose.covariance[index * 7] ?? NaN);
  return (
    <>
      <Row label="x">
        {metres(position.x)} ± {metres(deviation(0))}
      </Row>
      <Row label="y">
        {metres(position.y)} ± {metres(deviation(1))}
      </Row>
      <Row label="Yaw">
        {fixed(yawOf(orientation) * DEGREES, 1)}° ± {fixed(deviation(5) * DEGREES, 1)}°
      </Row>
    </>
  );
}

function Row({ label, children }: { readonly label: string; readonly children: ComponentChildren }): JSX.Element {
  return (
    <div class="formrow">
      <span class="label">{label}</span>
      <span class="w">{children}</span>
    </div>
  );
}

function metres(value: number | null): string {
  return value === null ? "—" : `${fixed(value, 2)} m`;
}

function Actions({ page }: PanelProps): JSX.Element | null {
  const state = navigationState(page);
  if (state.server.value === null) return null;
  return (
    <>
      {state.clearService !== null && (
        <Button small icon="reset" disabled={!canControl(page)} onClick={() => state.clearCostmaps()}>
          Clear costmaps
        </Button>
      )}
      {state.mapTopic !== null && (
        <Button small icon="download" onClick={() => state.saveMap()}>
          Save map
        </Button>
      )}
      {page.goals.goals.value.length > 0 && (
        <Button small icon="close" disabled={!canControl(page)} onClick={() => page.goals.clear()}>
          Clear goals
        </Button>
      )}
    </>
  );
}

export const navigationPanel: Panel = {
  id: "navigation",
  title: "Navigation",
  programs: [],
  component: Navigation,
  actions: Actions,
};
