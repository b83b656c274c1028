// @vitest-environment jsdom
import { Vector3, type Object3D } from "three";
import { beforeAll, expect, test, vi } from "vitest";

import "../../../src/displays/all";
import { MotionPlanningDisplay } from "../../../src/displays/motion_planning";
import { displayClass } from "../../../src/displays/registry";
import type { YamlMapping } from "../../../src/rviz/properties";
import { setup } from "../support";
import { SRDF, URDF } from "./robot";

const NO_HEADER = { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "world" };
const HERE = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };

beforeAll(() => vi.stubGlobal("matchMedia", () => ({ matches: false })));

export function box(id: string, x: number, change: Readonly<Record<string, unknown>> = {}) {
  return {
    header: NO_HEADER,
    pose: { ...HERE, position: { x, y: 0, z: 0 } },
    id,
    type: { key: "", db: "" },
    primitives: [{ type: 1, dimensions: Float64Array.of(0.1, 0.2, 0.3) }],
    primitive_poses: [HERE],
    ...{ meshes: [], mesh_poses: [], planes: [], plane_poses: [], subframe_names: [], subframe_poses: [] },
    operation: 0,
    ...change,
  };
}

function state(positions: Readonly<Record<string, number>>, change: Readonly<Record<string, unknown>> = {}) {
  return {
    joint_state: { name: Object.keys(positions), position: Float64Array.from(Object.values(positions)) },
    multi_dof_joint_state: { joint_names: [], transforms: [] },
    attached_collision_objects: [],
    is_diff: true,
    ...change,
  };
}

function scene(objects: readonly unknown[], change: Readonly<Record<string, unknown>> = {}) {
  return {
    name: "kitchen",
    robot_state: state({ shoulder: 0, elbow: 0 }),
    object_colors: [],
    world: { collision_objects: objects, octomap: { octomap: { id: "", data: new Int8Array() } } },
    is_diff: true,
    ...change,
  };
}

function started(properties: YamlMapping = {}) {
  const base = setup();
  base.frames.set("base", "map", [0, 0, 2]);
  base.connection.setParameter("/robot_description", URDF);
  base.connection.setParameter("/robot_description_semantic", SRDF);
  const topic = "/move_group/monitored_planning_scene";
  base.connection.advertise(topic, "moveit_msgs/PlanningScene");
  const display = new MotionPlanningDisplay(base.context);
  display.load({ Enabled: true, ...properties });
  display.start();
  const receive = (message: unknown): void => {
    base.connection.receive(topic, message);
    display.update(1n, 1);
  };
  const found = (name: string): Object3D | undefined => display.root.getObjectByName(name);
  const place = (name: string): number[] => {
    display.root.updateMatrixWorld(true);
    return new Vector3()
      .setFromMatrixPosition(found(name)?.matrixWorld ?? display.root.matrixWorld)
      .toArray()
      .map((value) => Number(value.toFixed(3)));
  };
  return { ...base, display, receive, found, place };
}

test("objects of the scene stand in the model's frame, which the root link places", () => {
  const { receive, place, found, display } = started();
  receive(scene([box("cup", 0.5)]));
  expect(place("cup")).toEqual([0.5, 0, 2]);
  receive(scene([{ ...box("cup", 0.9), primitives: [], primitive_poses: [], operation: 3 }]));
  expect(place("cup")).toEqual([0.9, 0, 2]);
  receive(scene([{ ...box("cup", 0), operation: 1 }]));
  expect(found("cup")).toBeUndefined();
  expect(display.statuses.value.get("Planning Scene Topic")?.level).toBe("ok");
});

test("an attached object goes with its link", () => {
  const { receive, place } = started();
  const body = { link_name: "lower", object: { ...box("cup", 0.5), header: { ...NO_HEADER, frame_id: "lower" } } };
  receive(scene([], { robot_state: state({ shoulder: 0, elbow: 0 }, { attached_collision_objects: [body] }) }));
  expect(place("cup")).toEqual([1.5, 0, 2]);
  receive(scene([], { robot_state: state({ shoulder: Math.PI / 2, elbow: 0 }) }));
  expect(place("cup")).toEqual([0, 1.5, 2]);
});

test("start and goal follow the robot until a person sets them", () => {
  const { receive, display } = started();
  receive(scene([], { robot_state: state({ shoulder: 0.2, elbow: 0.1 }) }));
  expect(display.goalQuery.positions.value.get("shoulder")).toBe(0.2);
  display.goalQuery.set(new Map([["elbow", 1]]), "home");
  receive(scene([], { robot_state: state({ shoulder: 0.3, elbow: 0.1 }) }));
  expect(display.goalQuery.positions.value).toEqual(
    new Map([
      ["shoulder", 0.2],
      ["elbow", 1],
    ]),
  );
  expect(display.startQuery.positions.value.get("shoulder")).toBe(0.3);
});

test("the goal's contacts are asked for and kept", async () => {
  const { receive, display, connection } = started();
  connection.answers.set("/check_state_validity", () => ({
    valid: false,
    contacts: [{ contact_body_1: "lower", contact_body_2: "cup" }],
  }));
  connection.services.value = new Map([
    ["/check_state_validity", { name: "/check_state_validity", type: "", request: "", response: "" }],
  ]);
  receive(scene([]));
  await Promise.resolve();
  await vi.waitFor(() => expect([...display.goalQuery.colliding.value]).toEqual(["lower", "cup"]));
});

test("the group is the file's, otherwise the first with a tip", () => {
  expect(started().display.group.value?.name).toBe("arm");
  expect(started({ "Planning Request": { "Planning Group": "hand" } }).display.group.value?.name).toBe("hand");
});

test("rviz's properties are loaded, and saved as they were", () => {
  const yaml = {
    Class: "moveit_rviz_plugin/MotionPlanning",
    "Planned Path": { "Loop Animation": true, "State Display Time": "0.05 s", Links: null },
    "Planning Request": { "Goal State Color": "1; 2; 3", "Query Start State": true },
    "Scene Geometry": { "Scene Alpha": 0.25 },
    MoveIt_Use_Cartesian_Path: true,
    MoveIt_Workspace: { Center: { X: 0, Y: 0, Z: 1 }, Size: { X: 2, Y: 2, Z: 2 } },
    MoveIt_Warehouse_Port: 33829,
  };
  const entry = displayClass("moveit_rviz_plugin/MotionPlanning");
  const display = entry?.create(setup().context) as MotionPlanningDisplay;
  expect(display.load(yaml)).toEqual([]);
  expect(display.path.loop.value.value).toBe(true);
  expect(display.settings.cartesian.value.value).toBe(true);
  const saved = display.save();
  expect(saved["Planned Path"]).toMatchObject({ "Loop Animation": true, "State Display Time": "0.05 s" });
  expect(saved["Planning Request"]).toMatchObject({ "Goal State Color": "1; 2; 3", "Planning Group": "" });
  expect(saved["MoveIt_Workspace"]).toEqual(yaml.MoveIt_Workspace);
  expect(saved).toMatchObject({ MoveIt_Use_Cartesian_Path: true, MoveIt_Warehouse_Port: 33829 });
  expect(saved["Scene Geometry"]).not.toHaveProperty("Scene Name");
});

test("a robot without a semantic description says what is missing", () => {
  const { connection, display } = started();
  connection.setParameter("/robot_description_semantic", undefined);
  expect(display.statuses.value.get("URDF")?.text).toContain("[robot_description_semantic] does not exist");
  connection.setParameter("/robot_description_semantic", "<robot");
  expect(display.statuses.value.get("URDF")).toMatchObject({ level: "error" });
});
