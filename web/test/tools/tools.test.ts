// @vitest-environment jsdom
import { signal } from "@preact/signals";
import { Group, Object3D, Ray, Vector3 } from "three";
import { expect, test } from "vitest";

import { GoalQueue } from "../../src/page/goal_queue";
import type { Selection } from "../../src/page/page";
import type { Pick, PictureBox, PointerTarget, SceneView } from "../../src/scene/scene_view";
import { ToolList } from "../../src/tools/tool_list";
import type { PointerInput } from "../../src/scene/pointer_input";
import { GraphNames } from "../../src/protocol/graph_names";
import { FakeConnection } from "../fake_connection";
import { FakeScene } from "../fake_page";

/** A scene whose pixel (x, y) is the point (x / 100, y / 100) of the ground. */
function setUp(viewOnly = false) {
  const picks = new Map<string, Pick>();
  const boxes: PictureBox[] = [];
  const labels: { text: string }[] = [];
  const ticks: (() => void)[] = [];
  const focused: Vector3[] = [];
  const element = document.createElement("canvas");
  document.createElement("div").append(element);
  const scene: SceneView = Object.assign(new FakeScene(), {
    element,
    pick: (x: number, y: number) => picks.get(`${x} ${y}`) ?? null,
    pickGround: (x: number, y: number) => new Vector3(x / 100, y / 100, 0),
    pickBox: (box: PictureBox) => {
      boxes.push(box);
      return [...picks.values()];
    },
    ray: (x: number, y: number) => new Ray(new Vector3(x / 100, y / 100, 10), new Vector3(0, 0, -1)),
    addLabel: (anchor: Object3D, text: string) => {
      const label = new FakeScene().addLabel(anchor, text);
      label.remove = () => void labels.splice(labels.indexOf(label), 1);
      labels.push(label);
      return label;
    },
    onTick: (act: () => void) => {
      ticks.push(act);
      return () => ticks.splice(ticks.indexOf(act), 1);
    },
  });
  const connection = new FakeConnection();
  connection.time = 12_000_000_034n;
  const selection = signal<Selection | null>(null);
  const hovered = signal<Selection | null>(null);
  const goals = new GoalQueue();
  const views = { focus: (point: Vector3) => void focused.push(point) };
  const tools = new ToolList({
    connection,
    names: new GraphNames(),
    scene,
    views,
    fixedFrame: signal("map"),
    selection,
    select: (picked) => (selection.value = picked),
    hovered,
    goals,
    editor: null,
    viewOnly,
  });
  const point = (kind: PointerInput["kind"], x: number, y: number, button = 0): boolean =>
    tools.pointer({ x, y, button, shift: false, control: false, kind });
  const drag = (...points: readonly (readonly [number, number])[]): void => {
    points.forEach(([x, y], i) => void point(i === 0 ? "down" : "move", x, y));
    const [x, y] = points[points.length - 1] ?? [0, 0];
    point("up", x, y);
  };
  return { tools, point, drag, picks, boxes, labels, ticks, focused, connection, selection, hovered, goals, scene };
}

function pickOf(object: Object3D, index: number | null = null): Pick {
  return { object, point: new Vector3(1, 2, 3), index };
}

function selectable(name: string, fields: Record<string, unknown>): Object3D {
  const object = new Object3D();
  object.name = name;
  object.userData["selectable"] = { describe: (index: number | null) => ({ ...fields, index }) };
  return object;
}

test("2D Pose Estimate publishes place and yaw in the fixed frame, with its deviations", () => {
  const { tools, drag, connection } = setUp();
  tools.use("rviz/SetInitialPose");

  drag([100, 200], [100, 300]);

  const [sent] = connection.published;
  expect(sent?.topic).toBe("/initialpose");
  expect(sent?.type).toBe("geometry_msgs/PoseWithCovarianceStamped");
  expect(sent?.message["header"]).toEqual({ seq: 0, stamp: { sec: 12, nsec: 34 }, frame_id: "map" });
  const pose = sent?.message["pose"] as unknown as {
    pose: { position: object; orientation: { z: number; w: number } };
    covariance: Float64Array;
  };
  expect(pose.pose.position).toEqual({ x: 1, y: 2, z: 0 });
  expect(pose.pose.orientation.z).toBeCloseTo(Math.SQRT1_2);
  expect(pose.pose.orientation.w).toBeCloseTo(Math.SQRT1_2);
  expect(pose.covariance[0]).toBeCloseTo(0.25);
  expect(pose.covariance[7]).toBeCloseTo(0.25);
  expect(pose.covariance[35]).toBeCloseTo((Math.PI / 12) ** 2);
  expect(tools.current.value.className).toBe("rviz/Interact");
});

test("2D Nav Goal goes to the topic of the file, and a cancelled drag publishes nothing", () => {
  const { tools, drag, point, connection, scene } = setUp();
  tools.load([{ Class: "rviz/SetGoal", Topic: "goal" }]);
  tools.use("rviz/SetGoal");
  point("down", 0, 0);
  expect(scene.displays.children).toHaveLength(1);
  point("cancel", 0, 0);
  expect(scene.displays.children).toHaveLength(0);
  expect(connection.published).toHaveLength(0);

  drag([0, 0], [-100, 0]);

  expect(connection.published[0]?.topic).toBe("/goal");
  expect(connection.published[0]?.type).toBe("geometry_msgs/PoseStamped");
  const { orientation } = connection.published[0]?.message["pose"] as unknown as { orientation: { z: number } };
  expect(Math.abs(orientation.z)).toBeCloseTo(1);
});

test("2D Nav Goal adds goals to the queue while that is asked for, and stays on", () => {
  const { tools, drag, connection, goals } = setUp();
  goals.collects.value = true;
  tools.use("rviz/SetGoal");

  drag([100, 200], [100, 300]);
  drag([0, 0], [-100, 0]);

  expect(connection.published).toHaveLength(0);
  expect(goals.goals.value.map(({ number, frame, pose }) => [number, frame, pose.position])).toEqual([
    [1, "map", { x: 1, y: 2, z: 0 }],
    [2, "map", { x: 0, y: 0, z: 0 }],
  ]);
  expect(tools.current.value.className).toBe("rviz/SetGoal");
});

test("Publish Point publishes the point under the pointer, and returns to the previous tool", () => {
  const { tools, point, connection, picks } = setUp();
  tools.use("rviz/MoveCamera");
  tools.use("rviz/PublishPoint");
  picks.set("5 6", pickOf(new Object3D()));
  expect(point("move", 5, 6, -1)).toBe(false);
  expect(tools.current.value.hint.value).toBe("x 1.000 m, y 2.000 m, z 3.000 m");
  point("down", 5, 6);
  expect(connection.published[0]?.message["point"]).toEqual({ x: 1, y: 2, z: 3 });
  expect(tools.current.value.className).toBe("rviz/MoveCamera");
});

test("Measure shows the distance between two points, and the right button restarts", () => {
  const { tools, point, labels } = setUp();
  tools.use("rviz/Measure");
  point("down", 0, 0);
  point("move", 300, 0, -1);
  point("down", 300, 400);
  point("move", 900, 0, -1);
  expect(labels.map(({ text }) => text)).toEqual(["5.000 m"]);
  expect(tools.current.value.hint.value).toBe("5.000 m. Right click starts again.");
  point("down", 0, 0, 2);
  expect(labels).toEqual([]);
});

test("Select selects a display's object with its fields, and by a box all objects in it", () => {
  const { tools, drag, picks, selection, boxes } = setUp();
  tools.use("rviz/Select");
  picks.set("10 10", pickOf(selectable("LaserScan", { Intensity: 7 }), 3));
  drag([10, 10]);
  expect(selection.value).toEqual({ kind: "picked", title: "LaserScan", fields: { Intensity: 7, index: 3 } });

  picks.set("20 20", pickOf(selectable("Marker", { Namespace: "a" })));
  drag([90, 60], [40, 80], [30, 100]);

  expect(boxes).toEqual([{ left: 30, top: 60, right: 90, bottom: 100 }]);
  expect(selection.value).toMatchObject({
    title: "2 selected",
    fields: { "LaserScan 1": { Intensity: 7 }, "Marker 2": { Namespace: "a" } },
  });
  drag([500, 500]);
  expect(selection.value).toBeNull();
});

test("Interact selects a link by a click and leaves drags to the camera", () => {
  const { point, picks, selection, hovered, ticks } = setUp();
  const body = new Group();
  Object.assign(body.userData, { body: 4, name: "arm::hand::tip" });
  const visual = new Object3D();
  body.add(visual);
  picks.set("1 1", pickOf(visual));

  point("move", 1, 1, -1);
  for (const tick of ticks) tick();
  expect(hovered.value).toEqual({ kind: "link", model: "arm::hand", link: "tip" });
  expect(point("down", 1, 1)).toBe(false);
  point("up", 1, 1);

  expect(selection.value).toEqual({ kind: "link", model: "arm::hand", link: "tip" });
});

test("Interact hands the pointer to objects that have handlers", () => {
  const { tools, point, picks, ticks } = setUp();
  const events: string[] = [];
  const target: PointerTarget = {
    hover: (isOver) => void events.push(isOver ? "over" : "out"),
    down: ({ pick }) => {
      events.push(`down ${pick?.index ?? ""}`);
      return true;
    },
    move: ({ x, ray }) => void events.push(`move ${x} ${ray.origin.x}`),
    up: (_event, isCancelled) => void events.push(isCancelled ? "cancel" : "up"),
  };
  const marker = new Group();
  marker.userData["pointerTarget"] = target;
  const handle = new Object3D();
  marker.add(handle);
  picks.set("1 1", pickOf(handle, 2));

  point("move", 1, 1, -1);
  for (const tick of ticks) tick();
  expect(point("down", 1, 1)).toBe(true);
  expect(point("move", 200, 1)).toBe(true);
  point("up", 200, 1);
  tools.use("rviz/MoveCamera");

  expect(events).toEqual(["over", "down 2", "move 200 2", "up", "out"]);
});

test("Interact ignores handlers on a view-only page", () => {
  const { point, picks, ticks } = setUp(true);
  const events: string[] = [];
  const note = (name: string) => () => void events.push(name);
  const target: PointerTarget = {
    hover: note("hover"),
    down: () => events.push("down") > 0,
    move: note("move"),
    up: note("up"),
  };
  const marker = new Group();
  marker.userData["pointerTarget"] = target;
  picks.set("1 1", pickOf(marker));

  point("move", 1, 1, -1);
  for (const tick of ticks) tick();
  expect(point("down", 1, 1)).toBe(false);
  point("up", 200, 1);

  expect(events).toEqual([]);
});

test("Focus Camera looks at the clicked point", () => {
  const { tools, point, focused } = setUp();
  tools.use("rviz/FocusCamera");
  point("down", 200, 100);
  expect(focused.map((at) => at.toArray())).toEqual([[2, 1, 0]]);
  expect(tools.current.value.className).toBe("rviz/Interact");
});

test("the tools of a file are loaded, ROS 2's too, and unknown ones are kept and named", () => {
  const { tools } = setUp();
  const plugin = { Class: "rviz_plugin_tutorials/PlantFlag" };

  const faults = tools.load([
    { Class: "rviz_default_plugins/SetGoal", Topic: { Depth: 5, Value: "/goal_pose" } },
    { Class: "rviz/SetInitialPose", "X std deviation": 0.1, Topic: "initialpose", Odd: 3 },
    plugin,
  ]);

  expect(faults).toEqual(["Tools: there is no tool rviz_plugin_tutorials/PlantFlag"]);
  const saved = tools.save();
  expect(saved.slice(0, 3)).toMatchObject([
    { Class: "rviz_default_plugins/SetGoal", Topic: "/goal_pose" },
    { Class: "rviz/SetInitialPose", "X std deviation": 0.1, Topic: "initialpose", Odd: 3 },
    plugin,
  ]);
  expect(saved.slice(3).map((tool) => tool["Class"])).toEqual([
    "rviz/Interact",
    "rviz/MoveCamera",
    "rviz/Select",
    "rviz/FocusCamera",
    "rviz/Measure",
    "rviz/PublishPoint",
  ]);
});
