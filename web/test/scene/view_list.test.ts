// @vitest-environment jsdom
import "../../src/scene/conventions";

import { signal } from "@preact/signals";
import { Box3, OrthographicCamera, PerspectiveCamera, Quaternion, Vector3 } from "three";
import { expect, test } from "vitest";

import type { Transform } from "../../src/frames/transform";
import type { Insets } from "../../src/scene/scene_view";
import type { SixSides } from "../../src/scene/view_controller";
import { ViewList, type ViewScene } from "../../src/scene/views/view_list";

function setUp(isReduced = false) {
  const ticks: ((elapsed: number) => void)[] = [];
  let drawn = 0;
  window.matchMedia = () => ({ matches: isReduced }) as MediaQueryList;
  const scene: ViewScene = {
    camera: signal<PerspectiveCamera | OrthographicCamera>(new PerspectiveCamera()),
    size: signal({ width: 800, height: 600 }),
    freeArea: signal<Insets>({ left: 0, right: 0, top: 0, bottom: 0 }),
    onSide: (_side: SixSides) => undefined,
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
  return { scene, views, targets, wait, drawn: () => drawn };
}

function at(x: number, y: number): Transform {
  return { position: new Vector3(x, y, 0), orientation: new Quaternion() };
}

test("the camera follows a body, stops where it is, and costs no picture while nothing moves", () => {
  const { scene, views, targets, wait, drawn } = setUp();
  targets.set("robot::base", at(5, 0));
  wait(0.1);
  views.follow("robot::base");
  wait(2);
  const offset = scene.camera.value.position.clone().sub(new Vector3(5, 0, 0));
  targets.set("robot::base", at(6, 1));
  wait(2);
  expect(scene.camera.value.position.clone().sub(offset).x).toBeCloseTo(6, 3);
  const before = drawn();
  wait(1);
  expect(drawn()).toBe(before);

  const place = scene.camera.value.position.clone();
  views.follow(null);
  targets.set("robot::base", at(9, 9));
  wait(1);
  expect(scene.camera.value.position.distanceTo(place)).toBeLessThan(1e-6);
});

test("framing takes some time, and none where reduced motion is asked for", () => {
  const box = new Box3(new Vector3(9, 9, 0), new Vector3(11, 11, 2));
  const looksAt = ({ views }: ReturnType<typeof setUp>): Vector3 => views.current.value.focus(views.target);
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

test("another class shows the same place; a side that it cannot show brings Orbit back", () => {
  const { scene, views, wait } = setUp(true);
  views.load({ Current: { Class: "rviz/Orbit", Distance: 4, "Focal Point": { X: 3, Y: 2, Z: 0 }, Yaw: 1, Pitch: 0.6 } });
  wait(0.1);
  const place = scene.camera.value.position.clone();
  views.use("rviz/FPS");
  wait(0.1);
  expect(scene.camera.value.position.distanceTo(place)).toBeLessThan(1e-6);
  views.use("rviz/TopDownOrtho");
  wait(0.1);
  expect(scene.camera.value).toBeInstanceOf(OrthographicCamera);
  expect(scene.camera.value.position.x).toBeCloseTo(3, 0);
  scene.onSide("left");
  wait(0.1);
  expect(views.current.value.className).toBe("rviz/Orbit");
  expect(scene.camera.value).toBeInstanceOf(PerspectiveCamera);
});

test("views of a file: saved ones, those of old files and of ROS 2; unknown ones are named", () => {
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
