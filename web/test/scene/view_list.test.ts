// @vitest-environment jsdom
import "../../src/scene/conventions";

import { signal } from "@preact/signals";
import { Box3, OrthographicCamera, PerspectiveCamera, Quaternion, Vector3 } from "three";
import { expect, test } from "vitest";

import type { Transform } from "../../src/frames/transform";
import { LabelSet } from "../../src/scene/label_layer";
import { ScenePanes } from "../../src/scene/panes/scene_panes";
import type { Insets } from "../../src/scene/free_area";
import { ViewList, type ViewScene } from "../../src/scene/views/view_list";

function setUp(isReduced = false) {
  const ticks: ((elapsed: number) => void)[] = [];
  let drawn = 0;
  window.matchMedia = () => ({ matches: isReduced }) as MediaQueryList;
  const insets = signal<Insets>({ left: 0, right: 0, top: 0, bottom: 0 });
  const panes = new ScenePanes(
    document.createElement("div"),
    new LabelSet(() => undefined),
    signal({ width: 800, height: 600 }),
    insets,
  );
  const scene: ViewScene = {
    panes,
    onTick: (tick) => {
      ticks.push(tick);
      return () => undefined;
    },
    invalidate: () => {
      drawn += 1;
    },
  };
  const targets = new Map<string, Transform>();
  const views = new ViewList(scene, (target) => targets.get(target) ?? null);
  const wait = (seconds: number): void => {
    for (let i = 0; i < seconds * 60; i += 1) for (const tick of ticks) tick(1 / 60);
  };
  const pane = panes.active.value;
  return { panes, pane, views, targets, wait, drawn: () => drawn };
}

function at(x: number, y: number): Transform {
  return { position: new Vector3(x, y, 0), orientation: new Quaternion() };
}

test("the camera follows a body, stops there, and draws nothing while nothing moves", () => {
  const { pane, views, targets, wait, drawn } = setUp();
  targets.set("robot::base", at(5, 0));
  wait(0.1);
  views.follow("robot::base");
  wait(2);
  const offset = pane.camera.value.position.clone().sub(new Vector3(5, 0, 0));
  targets.set("robot::base", at(6, 1));
  wait(2);
  expect(pane.camera.value.position.clone().sub(offset).x).toBeCloseTo(6, 3);
  const before = drawn();
  wait(1);
  expect(drawn()).toBe(before);

  const place = pane.camera.value.position.clone();
  views.follow(null);
  targets.set("robot::base", at(9, 9));
  wait(1);
  expect(pane.camera.value.position.distanceTo(place)).toBeLessThan(1e-6);
});

test("framing is animated, except with reduced motion", () => {
  const box = new Box3(new Vector3(9, 9, 0), new Vector3(11, 11, 2));
  const looksAt = ({ views }: ReturnType<typeof setUp>): Vector3 =>
    views.current.value.focus(views.active.value.target);
  const smooth = setUp();
  smooth.views.frame(box);
  smooth.wait(0.1);
  expect(looksAt(smooth).x).toBeGreaterThan(1);
  expect(looksAt(smooth).x).toBeLessThan(9.9);
  smooth.wait(0.5);
  expect(looksAt(smooth).distanceTo(new Vector3(10, 10, 1))).toBeLessThan(1e-6);
  const reduced = setUp(true);
  reduced.views.frame(box);
  reduced.wait(1 / 60);
  expect(looksAt(reduced).distanceTo(new Vector3(10, 10, 1))).toBeLessThan(1e-6);
});

test("another class shows the same point; an unsupported side switches to Orbit", () => {
  const { pane, views, wait } = setUp(true);
  views.load({
    Current: { Class: "rviz/Orbit", Distance: 4, "Focal Point": { X: 3, Y: 2, Z: 0 }, Yaw: 1, Pitch: 0.6 },
  });
  wait(0.1);
  const place = pane.camera.value.position.clone();
  views.use("rviz/FPS");
  wait(0.1);
  expect(pane.camera.value.position.distanceTo(place)).toBeLessThan(1e-6);
  views.use("rviz/TopDownOrtho");
  wait(0.1);
  expect(pane.camera.value).toBeInstanceOf(OrthographicCamera);
  expect(pane.camera.value.position.x).toBeCloseTo(3, 0);
  pane.onSide("left");
  wait(0.1);
  expect(views.current.value.className).toBe("rviz/Orbit");
  expect(pane.camera.value).toBeInstanceOf(PerspectiveCamera);
});

test("views of a file are loaded, also of old files and of ROS 2; unknown ones are named", () => {
  const { views } = setUp();
  const faults = views.load({
    Current: { Value: "XYOrbit (rviz)", Distance: 7, "Focal Shape Size": 0.05 },
    Saved: [
      { Class: "rviz_default_plugins/TopDownOrtho", Name: "above", Scale: 42 },
      { Class: "rviz_animated_view_controller/Animated", Name: "odd" },
    ],
  });
  expect(faults).toEqual(["Views: there is no view rviz_animated_view_controller/Animated"]);
  expect(views.current.value.className).toBe("rviz/XYOrbit");
  const [above] = views.saved.value;
  if (above !== undefined) views.useSaved(above);
  expect(views.current.value.save()).toMatchObject({ Class: "rviz/TopDownOrtho", Name: "Current View", Scale: 42 });

  const mine = views.copyCurrent("mine");
  views.saved.value = [...views.saved.value.filter((view) => view !== above), mine];

  expect(views.save()).toMatchObject({
    Saved: [
      { Class: "rviz/TopDownOrtho", Name: "mine", Scale: 42 },
      { Class: "rviz_animated_view_controller/Animated", Name: "odd" },
    ],
  });
});

test("further panes look at the same point from top, front and right; calls act on the active one", () => {
  const { panes, pane, views, wait } = setUp(true);
  views.load({
    Current: {
      Class: "rviz/Orbit",
      Distance: 4,
      "Focal Point": { X: 3, Y: 2, Z: 1 },
      Yaw: 1,
      Pitch: 0.6,
      "Target Frame": "map",
    },
  });
  panes.layout.value = "four";
  wait(0.1);
  const eyes = views.panes.value.slice(1).map(({ pane: { camera } }) =>
    camera.value.position
      .clone()
      .sub(new Vector3(3, 2, 1))
      .normalize(),
  );
  expect(eyes.map(({ x, y, z }) => [x, y, z].map((part) => Math.round(part) + 0))).toEqual([
    [0, 0, 1],
    [1, 0, 0],
    [0, -1, 0],
  ]);
  expect(views.panes.value.slice(1).every(({ pane: { camera } }) => camera.value instanceof OrthographicCamera)).toBe(
    true,
  );

  const front = views.panes.value[2];
  if (front !== undefined) views.activate(front);
  views.use("rviz/FPS");
  panes.layout.value = "one";
  wait(0.1);
  expect(views.panes.value).toEqual([front]); // the active one stays
  expect(views.current.value.className).toBe("rviz/FPS");
  panes.layout.value = "four";
  expect(views.panes.value.map(({ view }) => view.value.className)).toEqual([
    "rviz/Orbit",
    "rviz/Orbit",
    "rviz/FPS",
    "rviz/Orbit",
  ]);
  views.stepPane(1);
  views.stepPane(1);
  expect(panes.active.value).toBe(pane);
});

test("a file keeps every pane's view, and rviz the active one's", () => {
  const from = setUp().views;
  from.layout.value = "beside";
  const [first, second] = from.panes.value;
  first?.current.value.load({ Class: "rviz/Orbit", Distance: 3 });
  second?.load({ Class: "rviz/TopDownOrtho", Scale: 55, X: 2 });
  if (second !== undefined) from.activate(second);
  const file = from.save();
  expect(file["Current"]).toMatchObject({ Class: "rviz/TopDownOrtho", Scale: 55 });

  const { views } = setUp();
  expect(views.load(file)).toEqual([]);
  expect(views.layout.value).toBe("beside");
  expect(views.panes.value.map((pane) => pane.current.value.save())).toEqual(
    from.panes.value.map((pane) => pane.current.value.save()),
  );
  expect(views.active.value).toBe(views.panes.value[1]);
  expect(views.save()).toEqual(file);
  views.layout.value = "one";
  expect(setUp().views.load(views.save())).toEqual([]);
  expect(views.save()["Trundle Panes"]).toBeNull();
});

test("a page of one pane shows a file's active view, and leaves its panes to the file", () => {
  const { views } = setUp();
  views.onFileLayout = () => undefined;
  const current = { Class: "rviz/Orbit", Distance: 4 };
  views.load({
    Current: current,
    "Trundle Panes": { Layout: "four", Active: 1, Panes: [{ Class: "rviz/FPS" }, current] },
  });
  expect(views.current.value.save()).toMatchObject(current);
  expect(views.save()).not.toHaveProperty("Trundle Panes");
});

test.each([
  null,
  3,
  {},
  { Layout: "six", Panes: [] },
  { Layout: "four", Panes: 1 },
  { Layout: "beside", Active: 1e9, Panes: [1, { Class: "x" }] },
])("invalid panes are ignored: %j", (panes) => {
  const { views } = setUp();
  views.load({ Current: { Class: "rviz/Orbit", Distance: 4 }, "Trundle Panes": panes });
  expect(views.panes.value.length).toBeGreaterThan(0);
});

test("a view frames by itself until it is chosen", () => {
  const box = (x: number): Box3 => new Box3(new Vector3(x - 1, -1, 0), new Vector3(x + 1, 1, 2));
  const choices: readonly ((views: ViewList) => void)[] = [
    (views) => views.frame(box(3)),
    (views) => views.focus(new Vector3(3, 0, 1)),
    (views) => views.lookFrom("top"),
    (views) => views.use("rviz/TopDownOrtho"),
    (views) => void views.current.value.properties.find(({ name }) => name === "Yaw")?.decode(0.5),
  ];
  for (const choose of choices) {
    const one = setUp();
    const pane = one.views.active.value;
    pane.frameFirst(box(5));
    one.wait(1);
    expect(pane.isChosen.value).toBe(false);
    expect(pane.current.value.focus(pane.target).x).toBeCloseTo(5);
    choose(one.views);
    one.wait(1);
    expect(pane.isChosen.value).toBe(true);
    const before = pane.current.value.focus(pane.target).x;
    pane.frameFirst(box(9));
    one.wait(1);
    expect(pane.current.value.focus(pane.target).x).toBe(before);
  }
});
