import { expect, test } from "vitest";

import { readOctomap } from "../../../src/displays/octomaps/octomap_reader";
import "../../../src/displays/all";
import { FREE, OCCUPIED, voxelBoxes } from "../../../src/displays/octomaps/voxel_boxes";
import { displayClass } from "../../../src/displays/registry";
import type { Instances } from "../../../src/shapes/instances";
import { fakes } from "../fakes";

const HEADER = { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "" };

function octomap(binary: boolean, bytes: readonly number[]) {
  return {
    header: HEADER,
    binary,
    id: "OcTree",
    resolution: 0.1,
    data: Int8Array.from(bytes.map((byte) => (byte << 24) >> 24)),
  };
}

/** Bytes of one leaf at the depth of the resolution, always in child 7 (+x, +y, +z). */
function binaryLeaf(kind: number): number[] {
  const inner = Array.from({ length: 15 }, () => [0, 0xc0]).flat();
  return [...inner, 0, kind << 6];
}

test("a binary tree has occupied and free leaves of its resolution", () => {
  for (const [kind, isOccupied] of [
    [2, true],
    [1, false],
  ] as const) {
    const voxels = readOctomap(octomap(true, binaryLeaf(kind)));
    if (typeof voxels === "string") throw new Error(voxels);
    const [x = 0, , , size = 0] = voxels.boxes;
    expect(voxels.count).toBe(1);
    expect(size).toBeCloseTo(0.1);
    expect(x).toBeCloseTo(0.1 * 2 ** 15 - 0.05, 1); // the outermost corner: always the child of +x
    expect((voxels.probabilities[0] ?? 0) > 0.5).toBe(isOccupied);
  }
});

test("a full tree has the probabilities of its log odds", () => {
  const bytes = new Uint8Array(10);
  const view = new DataView(bytes.buffer);
  view.setFloat32(0, 0, true);
  view.setUint8(4, 0b1);
  view.setFloat32(5, Math.log(3), true); // 3 : 1
  const voxels = readOctomap(octomap(false, [...bytes]));
  if (typeof voxels === "string") throw new Error(voxels);
  expect(voxels.probabilities[0]).toBeCloseTo(0.75);
  expect(voxels.boxes[0]).toBeLessThan(0); // child 0 is on the lower side of each axis
});

test("a colored tree has the colors of its leaves, and boxes within the heights are drawn in them", () => {
  const bytes = new Uint8Array(24);
  const view = new DataView(bytes.buffer);
  view.setUint8(7, 0b10001); // a lower and an upper child
  view.setFloat32(8, 3, true);
  bytes.set([255, 0, 51], 12);
  view.setFloat32(16, 3, true);
  bytes.set([0, 255, 0], 20);
  const voxels = readOctomap({ ...octomap(false, [...bytes]), id: "ColorOcTree" });
  if (typeof voxels === "string") throw new Error(voxels);
  expect([...voxels.colors]).toEqual([1, 0, Math.fround(0.2), 0, 1, 0]);
  const look = { rendering: OCCUPIED, coloring: "Cell Color", alpha: 0.5 };
  expect(voxelBoxes(voxels, look).count).toBe(2);
  const lower = voxelBoxes(voxels, { ...look, heights: [-Infinity, 0] });
  expect(lower.count).toBe(1);
  expect([...lower.geometry.getAttribute("instanceRgba").array].slice(0, 4)).toEqual([1, 0, Math.fround(0.2), 0.5]);
  expect(voxelBoxes(voxels, { ...look, rendering: FREE }).count).toBe(0);
});

test("octomap_rviz_plugin's display draws the voxels of its topic between its heights", () => {
  const around = fakes();
  around.frames.set("tilted");
  around.connection.advertise("/octomap_full", "octomap_msgs/Octomap");
  const display = displayClass("octomap_rviz_plugin/ColorOccupancyGrid")?.create(around.context);
  if (display === undefined) throw new Error("no such display");
  const yaml = { "Octomap Topic": "/octomap_full", "Voxel Rendering": "All Voxels", "Max. Height Display": 3.4e38 };
  expect(display.load({ Enabled: true, ...yaml })).toEqual([]);
  display.start();
  const message = { ...octomap(true, binaryLeaf(1)), header: { ...HEADER, frame_id: "tilted" } };
  around.connection.receive("/octomap_full", message);
  display.update(0n, 0.01);
  expect(display.root.children).toHaveLength(1);
  expect((display.root.children[0] as Instances).count).toBe(1);
  around.connection.receive("/octomap_full", { ...message, resolution: 0 });
  display.update(0n, 0.01);
  expect(display.statuses.peek().get("Octomap")?.text).toContain("resolution");
});

test("damaged messages become sentences", () => {
  expect(readOctomap(octomap(true, [0, 0xc0]))).toContain("ends early");
  expect(readOctomap(octomap(true, Array.from({ length: 40 }, () => [0, 0xc0]).flat()))).toContain("ends early");
  expect(readOctomap({ ...octomap(true, []), id: "CountingOcTree" })).toContain("CountingOcTree is not read");
  expect(readOctomap({ ...octomap(true, []), resolution: NaN })).toContain("resolution");
});
