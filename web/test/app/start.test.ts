// @vitest-environment jsdom
import { signal } from "@preact/signals";
import { Box3, Sphere, Vector3 } from "three";
import { beforeEach, describe, expect, it } from "vitest";

import { Shell } from "../../src/app/shell";
import { startDisplays } from "../../src/app/start";
import { startView } from "../../src/app/views/first_view";
import { fakePage, type FakePage } from "../fake_page";
import { MANIFEST } from "../harness/manifest";

const shellOf = (page: FakePage): Shell => new Shell(page, page.commands, document.createElement("div"), signal(false));

beforeEach(() => localStorage.clear());

describe("the first view of a page", () => {
  it("frames the robot once, as soon as it is visible", () => {
    const page = fakePage();
    const { box } = page.world;
    page.world.box = new Box3();
    page.world.manifest.value = MANIFEST;
    startView(shellOf(page));
    page.scene.tick();
    expect(page.views.framed).toEqual([]);
    page.world.box = box;
    page.scene.tick();
    page.scene.tick();
    expect(page.views.framed).toHaveLength(1);
  });

  it("has the robot's feet in the lower third, at the same distance wherever it stands", () => {
    const framed = [0, 5].map((x) => {
      const page = fakePage();
      page.world.place(new Vector3(x, 0, 1));
      page.world.manifest.value = MANIFEST;
      startView(shellOf(page));
      page.scene.tick();
      return page.views.framed[0] ?? new Box3();
    });
    const [near, far] = framed.map((box) => box.getBoundingSphere(new Sphere()));
    expect(far?.radius).toBeCloseTo(near?.radius ?? 0);
    expect(far?.center.x).toBeCloseTo(5);
    const feet = ((near?.center.z ?? 0) - 1) / (near?.radius ?? 1);
    expect(feet).toBeGreaterThan(1 / 3);
    expect(feet).toBeLessThan(1);
  });

  it("frames a robot as soon as it comes into a world", () => {
    const page = fakePage();
    startView(shellOf(page));
    page.world.manifest.value = { ...MANIFEST, robot: null };
    page.scene.tick();
    page.scene.tick();
    expect(page.views.framed).toHaveLength(1);
    page.world.manifest.value = MANIFEST;
    page.scene.tick();
    page.scene.tick();
    expect(page.views.framed).toHaveLength(2);
  });

  it("frames the robot again for the part that the dock leaves free, until a person acts", () => {
    const page = fakePage();
    const { free } = page.views.pane;
    page.world.manifest.value = MANIFEST;
    startView(shellOf(page));
    page.scene.tick();
    free.value = { left: 0, top: 0, width: 1, height: 0.5 };
    page.scene.tick();
    page.scene.tick();
    expect(page.views.framed).toHaveLength(2);
    document.body.dispatchEvent(new Event("keydown"));
    free.value = { left: 0, top: 0, width: 1, height: 0.4 };
    page.scene.tick();
    expect(page.views.framed).toHaveLength(2);
  });

  it("frames the robot in each pane for the part that is free there", () => {
    const page = fakePage();
    const second = page.views.addPane();
    page.world.manifest.value = MANIFEST;
    startView(shellOf(page));
    page.scene.tick();
    expect(page.views.framed).toHaveLength(2);
    second.free.value = { left: 0, top: 0, width: 1, height: 0.5 };
    page.scene.tick();
    page.scene.tick();
    expect(page.views.framed).toHaveLength(3);
  });

  it("shows the robot and its ghost, however far apart, until a person chooses a view", () => {
    const page = fakePage();
    const shows = (x: number): boolean | undefined => page.views.framed.at(-1)?.containsPoint(new Vector3(x, 0, 0.6));
    page.world.manifest.value = MANIFEST;
    startView(shellOf(page));
    page.scene.tick();
    expect(shows(6)).toBe(false);
    document.body.dispatchEvent(new Event("keydown"));
    page.world.compare(new Box3(new Vector3(5, -1, 0), new Vector3(7, 1, 1)));
    page.scene.wait(0.5);
    expect([shows(0), shows(6)]).toEqual([true, true]);
    const count = page.views.framed.length;
    page.world.compare(new Box3(new Vector3(5.1, -1, 0), new Vector3(7.1, 1, 1)));
    page.scene.wait(0.5);
    expect(page.views.framed).toHaveLength(count);
    page.world.compare(new Box3(new Vector3(19, -1, 0), new Vector3(21, 1, 1)));
    page.scene.wait(0.5);
    expect(shows(20)).toBe(true);
    page.views.pane.isChosen.value = true;
    page.world.compare(new Box3(new Vector3(49, -1, 0), new Vector3(51, 1, 1)));
    page.scene.wait(0.5);
    expect(page.views.framed).toHaveLength(count + 1);
  });

  it("frames a robot that comes after a person has acted", () => {
    const page = fakePage();
    startView(shellOf(page));
    document.body.dispatchEvent(new Event("pointerdown"));
    page.world.manifest.value = MANIFEST;
    page.scene.tick();
    expect(page.views.framed).toHaveLength(1);
  });

  it("is unchanged if a person has moved the camera, or a file has a view", () => {
    const page = fakePage();
    startView(shellOf(page));
    page.scene.element.dispatchEvent(new Event("pointerdown"));
    const filed = fakePage({ rviz: { name: "a.rviz", text: "", writable: false, saved: false } });
    startView(shellOf(filed));
    for (const fake of [page, filed]) {
      fake.world.manifest.value = MANIFEST;
      fake.scene.tick();
      expect(fake.views.framed).toEqual([]);
    }
  });

  it("has no displays of objects that the simulated world draws", () => {
    const page = fakePage();
    const grid = page.displays.show("rviz/Grid", null, null);
    const tf = page.displays.show("rviz/TF", null, null);
    startDisplays(shellOf(page));
    expect([grid.enabled.value.value, tf.enabled.value.value]).toEqual([false, true]);
  });

  it("has a robot model once a graph has a robot description", () => {
    const page = fakePage({ kind: "graph" });
    const robot = page.displays.show("rviz/RobotModel", null, null);
    startDisplays(shellOf(page));
    expect(robot.enabled.value.value).toBe(false);
    page.connection.parameters.value = new Map([["/robot_description", "<robot name='cart'/>"]]);
    expect(robot.enabled.value.value).toBe(true);
  });

  it("selects the robot of a simulated world", async () => {
    const page = fakePage();
    startDisplays(shellOf(page));
    page.world.manifest.value = MANIFEST;
    await Promise.resolve();
    expect(page.selection.value).toEqual({ kind: "model", model: "rp2w" });
  });

  it("has the theme's background until another one is chosen", () => {
    const page = fakePage({ kind: "graph" });
    startDisplays(shellOf(page));
    const { backgroundColor } = page.displays;
    page.theme.value = "light";
    expect(backgroundColor.value.value).toEqual([207, 211, 214]);
    backgroundColor.value.value = [1, 2, 3];
    page.theme.value = "dark";
    expect(backgroundColor.value.value).toEqual([1, 2, 3]);
  });
});
