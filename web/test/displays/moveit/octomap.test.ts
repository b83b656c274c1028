import { expect, test } from "vitest";

import { readOctomap } from "../../../src/displays/moveit/octomap";

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

test("damaged messages become sentences", () => {
  expect(readOctomap(octomap(true, [0, 0xc0]))).toContain("ends early");
  expect(readOctomap(octomap(true, Array.from({ length: 40 }, () => [0, 0xc0]).flat()))).toContain("ends early");
  expect(readOctomap({ ...octomap(true, []), id: "CountingOcTree" })).toContain("CountingOcTree is not read");
  expect(readOctomap({ ...octomap(true, []), resolution: NaN })).toContain("resolution");
});
