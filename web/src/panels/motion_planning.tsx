/** Planning of arms by move_group: MoveIt's panel MotionPlanning. */

import { signal } from "@preact/signals";
import type { JSX } from "preact";

import { changeProperty } from "../page/change_property";
import { canControl, VIEW_ONLY } from "../page/view_only";
import { Button } from "../theme/button";
import { StatusShape } from "../theme/status_shape";
import { Tabs } from "../theme/tabs";
import { ContextTab } from "./motion_planning/context_tab";
import { JointsTab } from "./motion_planning/joints_tab";
import { motionPlanningState } from "./motion_planning/motion_planning_state";
import { ObjectsTab } from "./motion_planning/objects_tab";
import type { TabProps } from "./motion_planning/parts";
import { PlanningTab } from "./motion_planning/planning_tab";
import type { Panel, PanelProps } from "./panel";
import { perPage } from "./per_page";

const DISPLAY = "moveit_rviz_plugin/MotionPlanning";
const INTERACT = "rviz/Interact";
const TABS = [
  { id: "planning", title: "Planning", component: PlanningTab },
  { id: "joints", title: "Joints", component: JointsTab },
  { id: "objects", title: "Scene Objects", component: ObjectsTab },
  { id: "context", title: "Context", component: ContextTab },
] as const;

/** Height of the section Planning, with commands and status [px]. */
const CONTENT_HEIGHT = signal(238);

const shownTab = perPage(() => signal<string>("planning"));

function MotionPlanning({ page }: PanelProps): JSX.Element {
  const state = motionPlanningState(page);
  const display = state.display.value;
  if (state.namespaces.value.length === 0 && display === null)
    return <div class="empty">No arm is planned here: no node has the action move_group.</div>;
  if (display === null)
    return (
      <div class="empty">
        <p>move_group runs, and no display shows what it plans.</p>
        <Button tone="primary" icon="plus" onClick={() => page.displays.add(DISPLAY)}>
          Add MotionPlanning
        </Button>
      </div>
    );
  const tab = shownTab(page);
  const Shown = TABS.find(({ id }) => id === tab.value)?.component ?? PlanningTab;
  const props = { page, state, display };
  return (
    <div class="stack motionplanning">
      <div class="toolrow">
        <Tabs label="Motion planning" items={TABS} selected={tab.value} onSelect={(id) => void (tab.value = id)} />
        <span class="sp" />
        <Commands {...props} />
      </div>
      <Shown {...props} />
      <Status {...props} />
    </div>
  );
}

function Commands({ page, state, display }: TabProps): JSX.Element {
  const isOff = !canControl(page) || state.namespace.value === null;
  const isBusy = state.task.value !== null;
  return (
    <div class="armcommands" role="group" aria-label="Commands">
      <DragButton page={page} display={display} />
      <Button small tone="primary" icon="goal" disabled={isOff || isBusy} onClick={() => void state.plan()}>
        Plan
      </Button>
      <Button
        small
        icon="play"
        disabled={isOff || isBusy || state.planned.value === null}
        onClick={() => void state.execute()}
      >
        Execute
      </Button>
      <Button small icon="play" disabled={isOff || isBusy} onClick={() => void state.planAndExecute()}>
        Plan & Execute
      </Button>
      <Button small icon="close" disabled={isOff} onClick={() => state.stop()}>
        Stop
      </Button>
    </div>
  );
}

/** Shows the handles at the arm's tip, and takes the tool that drags them. */
function DragButton({ page, display }: Pick<TabProps, "page" | "display">): JSX.Element {
  const { queryGoal } = display.request;
  const isOn = queryGoal.value.value && page.tools.current.value.className === INTERACT;
  const toggle = (): void => {
    if (isOn) changeProperty(page, queryGoal, false);
    else {
      if (!queryGoal.value.peek()) changeProperty(page, queryGoal, true);
      page.tools.use(INTERACT);
    }
  };
  return (
    <Button small icon="move" on={isOn} disabled={!canControl(page)} onClick={toggle}>
      Drag the arm
    </Button>
  );
}

function Status({ page, state, display }: TabProps): JSX.Element {
  const outcome = state.outcome.value;
  const faults = [display.startQuery, display.goalQuery].map(({ name, fault, colliding }) => {
    const touching =
      colliding.value.size === 0 ? "" : `The ${name} is in collision: ${[...colliding.value].join(", ")}.`;
    return [fault.value, touching].filter((text) => text !== "").join(" ");
  });
  const fault = faults.filter((text) => text !== "").join(" ");
  const task = state.task.value;
  const text = task !== null ? `${task} …` : (outcome?.text ?? "Nothing is planned yet.");
  const level = task !== null ? "none" : outcome === null ? "none" : outcome.isDone ? "ok" : "error";
  return (
    <div class="armstatus">
      <StatusShape level={level} />
      <span role="status">{canControl(page) ? text : VIEW_ONLY}</span>
      {fault !== "" && (
        <span class="fault" role="alert">
          {fault}
        </span>
      )}
    </div>
  );
}

export const motionPlanningPanel: Panel = {
  id: "motion_planning",
  title: "MotionPlanning",
  programs: ["move_group"],
  component: MotionPlanning,
  contentHeight: () => CONTENT_HEIGHT,
};
