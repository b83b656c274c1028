// @vitest-environment jsdom
import { signal } from "@preact/signals";
import { afterEach, beforeAll, expect, test, vi } from "vitest";

import { MotionPlanningDisplay } from "../../../src/displays/motion_planning";
import { MotionPlanningState } from "../../../src/panels/motion_planning/motion_planning_state";
import { choicesOf, choose } from "../../../src/panels/motion_planning/query_choices";
import { SceneObjects } from "../../../src/panels/motion_planning/scene_objects";
import type { RosMessage } from "../../../src/protocol/ros_types";
import { setup } from "../../displays/support";
import { SRDF, URDF } from "../../displays/moveit/robot";
import { fakePage, type FakePage } from "../../fake_page";

beforeAll(() => vi.stubGlobal("matchMedia", () => ({ matches: false })));
afterEach(() => vi.useRealTimers());

const NO_TIME = { sec: 0, nsec: 0 };
const PATH = {
  joint_trajectory: {
    joint_names: ["elbow"],
    points: [0, 1].map((sec) => ({
      positions: Float64Array.of(sec),
      velocities: Float64Array.of(1),
      accelerations: Float64Array.of(1),
      time_from_start: { ...NO_TIME, sec },
    })),
  },
  multi_dof_joint_trajectory: { joint_names: [], points: [] },
};

function setUp(services: Readonly<Record<string, (request: RosMessage) => unknown>> = {}) {
  const page: FakePage = fakePage();
  const { connection } = page;
  const base = setup();
  connection.setParameter("/robot_description", URDF);
  connection.setParameter("/robot_description_semantic", SRDF);
  for (const action of ["move_group", "execute_trajectory"])
    connection.advertise(
      `/${action}/result`,
      action === "move_group" ? "moveit_msgs/MoveGroupActionResult" : "x/Result",
    );
  connection.advertise("/move_group/monitored_planning_scene", "moveit_msgs/PlanningScene");
  const known = new Map(Object.keys(services).map((name) => [name, { name, type: "", request: "", response: "" }]));
  for (const [name, answer] of Object.entries(services))
    connection.answers.set(name, (request) => answer(request) as RosMessage);
  connection.services.value = known;
  const display = new MotionPlanningDisplay({ ...base.context, connection });
  display.start();
  Object.assign(page.displays, { displays: signal([display]) });
  const state = new MotionPlanningState(page);
  const sent = (topic: string): RosMessage[] =>
    connection.published.filter((one) => one.topic === topic).map(({ message }) => message);
  const finish = (action: string, result: unknown): void => {
    const id = (sent(`/${action}/goal`).at(-1)?.["goal_id"] as { id: string }).id;
    connection.receive(`/${action}/result`, { status: { goal_id: { id }, text: "" }, result });
  };
  return { page, connection, display, state, sent, finish };
}

test("Plan sends the goal's joints, and Execute the path that comes back", async () => {
  const { display, state, sent, finish } = setUp();
  display.goalQuery.set(
    new Map([
      ["shoulder", 0.5],
      ["elbow", -1],
    ]),
  );
  state.planner.value = "RRTConnect";
  const planning = state.plan();
  expect(state.task.value).toBe("Planning");
  const { goal } = sent("/move_group/goal")[0] as unknown as { goal: Record<string, Record<string, unknown>> };
  expect(goal["request"]).toMatchObject({
    group_name: "arm",
    planner_id: "RRTConnect",
    start_state: { is_diff: true },
    allowed_planning_time: 5,
    max_velocity_scaling_factor: 0.1,
    goal_constraints: [
      {
        joint_constraints: [
          { joint_name: "shoulder", position: 0.5 },
          { joint_name: "elbow", position: -1 },
        ],
      },
    ],
  });
  expect(goal["planning_options"]).toMatchObject({ plan_only: true });
  finish("move_group", { error_code: { val: 1 }, planned_trajectory: PATH, planning_time: 0.25 });
  await planning;
  expect(state.outcome.value).toMatchObject({ isDone: true });
  expect(state.outcome.value?.text).toContain("Planned in 0.25 s: 2 points, 1.0 s.");
  const executing = state.execute();
  expect(sent("/execute_trajectory/goal")[0]).toMatchObject({ goal: { trajectory: PATH } });
  finish("execute_trajectory", { error_code: { val: -4 } });
  await executing;
  expect(state.outcome.value?.text).toContain("The controllers did not reach the goal (CONTROL_FAILED).");
});

test("a failure is told in words, and nothing can be executed", async () => {
  const { state, finish } = setUp();
  const planning = state.plan();
  finish("move_group", { error_code: { val: -12 }, planned_trajectory: PATH, planning_time: 0 });
  await planning;
  expect(state.outcome.value?.text).toContain("The goal is in collision (GOAL_IN_COLLISION).");
  expect(state.planned.value).toBeNull();
});

test("Stop stops the robot and the planning", async () => {
  const { state, sent, finish } = setUp();
  const planning = state.planAndExecute();
  state.stop();
  expect(sent("/trajectory_execution_event")).toEqual([{ data: "stop" }]);
  expect(sent("/move_group/cancel")).toHaveLength(1);
  finish("move_group", { error_code: { val: -7 }, planned_trajectory: PATH, planning_time: 0 });
  await planning;
  expect(state.outcome.value?.text).toContain("PREEMPTED");
});

test("a goal that the node has forgotten fails", async () => {
  vi.useFakeTimers({ toFake: ["performance"] });
  const { state, connection } = setUp();
  const planning = state.plan();
  vi.advanceTimersByTime(6000);
  connection.receive("/move_group/status", { status_list: [] });
  await planning;
  expect(state.outcome.value?.text).toContain("/move_group no longer knows this goal.");
});

test("a straight path is slowed by the scaling, or says how far it goes", async () => {
  let fraction = 1;
  const { display, state } = setUp({
    "/compute_cartesian_path": () => ({ error_code: { val: 1 }, fraction, solution: PATH }),
  });
  display.settings.cartesian.value.value = true;
  display.settings.velocityScaling.value.value = 0.5;
  display.settings.accelerationScaling.value.value = 1;
  await state.plan();
  expect(state.planned.value?.joint_trajectory.points[1]?.time_from_start).toEqual({ sec: 2, nsec: 0 });
  fraction = 0.5;
  await state.plan();
  expect(state.outcome.value?.text).toContain("Only 50 % of the straight line can be followed.");
});

test("choices set the start and the goal", async () => {
  let isValid = false;
  const { display, state } = setUp({ "/check_state_validity": () => ({ valid: isValid, contacts: [] }) });
  const { goalQuery: goal, startQuery: start } = display;
  expect(choicesOf(goal, display.group.value)).toEqual([
    "<random valid>",
    "<random>",
    "<current>",
    "<same as start>",
    "<previous>",
    "home",
  ]);
  expect(await choose(state, display, goal, "home")).toBe("");
  expect(goal.positions.value.get("elbow")).toBe(-1);
  await choose(state, display, start, "<same as goal>");
  expect(start.positions.value.get("elbow")).toBe(-1);
  expect(await choose(state, display, goal, "<random valid>")).toContain("all are in collision");
  isValid = true;
  expect(await choose(state, display, goal, "<random valid>")).toBe("");
  expect(Math.abs(goal.positions.value.get("elbow") ?? 9)).toBeLessThanOrEqual(2);
  expect(await choose(state, display, goal, "<previous>")).toBe("Nothing was planned before.");
});

test("objects are added, moved and attached, undoably, and published together", async () => {
  const applied: unknown[] = [];
  const { page, display, state } = setUp({
    "/apply_planning_scene": ({ scene }) => {
      applied.push(scene);
      return { success: true };
    },
  });
  const objects = new SceneObjects(state, display);
  objects.addShape("box");
  objects.addShape("box");
  expect([...display.drafted.value.objects.keys()]).toEqual(["box", "box_2"]);
  const box = display.drafted.value.objects.get("box");
  if (box === undefined) throw new Error("no box");
  objects.place(box, 2, 0.75);
  expect(display.drafted.value.objects.get("box")?.pose.position.z).toBe(0.75);
  page.undo.undo();
  expect(display.drafted.value.objects.get("box")?.pose.position.z).toBe(0.3);
  objects.remove("box_2");
  objects.attach(box, "tip");
  const body = display.drafted.value.attached.get("box");
  expect(body?.touch_links).toEqual(["tip", "finger", "thumb"]);
  expect(body?.object.pose.position.x).toBeCloseTo(0); // 0.5 m before the base is beside the tip at 2 m, turned by 90°
  expect(body?.object.pose.position.y).toBeCloseTo(1.5);
  await objects.publish();
  expect(applied).toMatchObject([
    {
      is_diff: true,
      robot_state: { attached_collision_objects: [{ link_name: "tip", object: { id: "box", operation: 0 } }] },
      world: { collision_objects: [{ id: "box_2", operation: 1 }] },
    },
  ]);
  expect(display.draft.count.value).toBe(0);
});

test("without move_group there is nothing to plan with", () => {
  const page = fakePage();
  const state = new MotionPlanningState(page);
  expect([state.namespaces.value, state.display.value, state.namespace.value]).toEqual([[], null, null]);
});
