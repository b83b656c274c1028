import { Box3, LineSegments, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { AxesDisplay } from "../../src/displays/axes";
import { Grid, gridLines } from "../../src/displays/grid";
import { fakes } from "./fakes";
import { setup } from "./support";

describe("lines of a grid", () => {
  it("are cells + 1 in both directions, about the origin", () => {
    const points = gridLines(10, 0, 1, "XY");
    expect(points.length / 6).toBe(22);
    expect(Math.min(...points)).toBe(-5);
    expect(Math.max(...points)).toBe(5);
    for (let k = 2; k < points.length; k += 3) expect(points[k]).toBe(0);
  });

  it("lie in the chosen plane", () => {
    const points = gridLines(2, 0, 0.5, "YZ");
    for (let k = 0; k < points.length; k += 3) expect(points[k]).toBe(0);
    expect(Math.max(...points)).toBe(0.5);
  });

  it("make a lattice of layers", () => {
    // 2 layers of 1 cell: 3 squares of 4 lines, and 4 uprights
    expect(gridLines(1, 2, 1, "XY").length / 6).toBe(3 * 4 + 4);
  });
});

describe("Grid", () => {
  it("stands in its frame, with its offset in that frame", () => {
    const { context, frames, scene } = setup();
    frames.set("base", "map", [1, 2, 0]);
    const grid = new Grid(context);
    grid.load({ "Reference Frame": "base", Offset: { X: 0.5, Y: 0, Z: 0 }, "Plane Cell Count": 2, Enabled: true });
    grid.start();
    grid.update();
    const box = new Box3().setFromObject(scene.displays);
    expect(box.getCenter(new Vector3()).toArray()).toEqual([1.5, 2, 0]);
    grid.stop();
    expect(scene.displays.children).toHaveLength(0);
  });

  it("reports a missing transform, and hides", () => {
    const { context } = setup();
    const grid = new Grid(context);
    grid.load({ "Reference Frame": "nowhere" });
    grid.start();
    grid.update();
    expect(grid.statuses.value.get("Transform")?.text).toBe("No transform from [nowhere] to [map]");
    expect(grid.root.visible).toBe(false);
  });

  it("draws billboard lines if chosen", () => {
    const { context, scene } = setup();
    const grid = new Grid(context);
    grid.start();
    const shown = (): string[] => {
      const names: string[] = [];
      scene.displays.traverseVisible((object) => {
        if (object instanceof LineSegments) names.push("Lines");
        else if (object.constructor.name === "BillboardLines") names.push("Billboards");
      });
      return names;
    };
    expect(shown()).toEqual(["Lines"]);
    grid.load({ "Line Style": { "Line Width": 0.1, Value: "Billboards" } });
    expect(shown()).toEqual(["Billboards"]);
  });
});

describe("Axes", () => {
  it("stand at their frame with their length", () => {
    const { context, frames, scene } = setup();
    frames.set("base", "map", [1, 2, 3]);
    const axes = new AxesDisplay(context);
    axes.load({ "Reference Frame": "base", Length: 2, Radius: 0.1 });
    axes.start();
    axes.update();
    const box = new Box3().setFromObject(scene.displays);
    expect(box.max.z).toBeCloseTo(5);
    expect(box.max.x).toBeCloseTo(3);
  });

  it("are redrawn only when their frame moves", () => {
    const { context, frames, invalidated } = fakes();
    frames.set("base", 1);
    const axes = new AxesDisplay(context);
    axes.load({ "Reference Frame": "base" });
    axes.start();
    axes.update();
    const before = invalidated.count;
    axes.update();
    expect(invalidated.count).toBe(before);
    frames.set("base", 2);
    axes.update();
    expect(invalidated.count).toBe(before + 1);
  });

  it("leave a trail if enabled", () => {
    const { context, frames, scene } = setup();
    const axes = new AxesDisplay(context);
    axes.load({ "Reference Frame": "base", Length: 0.1, "Show Trail": true });
    axes.start();
    for (const x of [0, 1, 2]) {
      frames.set("base", "map", [x, 0, 0]);
      axes.update();
    }
    const trail = scene.displays.children[0]?.children.find((child) => "segments" in child);
    expect(trail).toMatchObject({ segments: 2 });
  });
});
