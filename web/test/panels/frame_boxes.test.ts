import { expect, test } from "vitest";

import type { FrameInfo } from "../../src/frames/frame_tree";
import { frameBoxes } from "../../src/panels/graph/frame_boxes";
import { layered } from "../../src/panels/graph/layered_layout";

const NOW = 100_000_000_000n;
const frame = (name: string, parent: string | null, changes: Partial<FrameInfo> = {}): FrameInfo => ({
  name,
  parent,
  isStatic: false,
  stamp: NOW,
  rate: 10,
  publisher: null,
  ...changes,
});
const captions = (frames: readonly FrameInfo[], fixed = "map"): Record<string, string> =>
  Object.fromEntries(
    frameBoxes(frames, fixed, NOW)[0].map((box) => [box.name, `${box.kind.slice(6)}|${box.caption ?? ""}`]),
  );

test("frames show their rate, age and faults", () => {
  const frames = [
    frame("odom", "map"),
    frame("laser", "odom", { isStatic: true, stamp: 0n, rate: null }),
    frame("arm", "odom", { stamp: NOW - 14_000_000_000n }),
    frame("tag", "camera"),
  ];
  expect(captions(frames)).toEqual({
    map: "|root",
    odom: "|10.0 Hz · 0.00 s",
    laser: "|static",
    arm: "warn|14.00 s old",
    tag: "warn|not connected",
    camera: "warn|not connected",
  });
});

test("a loop of parents is an error", () => {
  expect(captions([frame("a", "b"), frame("b", "a")], "a")).toEqual({
    a: "error|loop of parents",
    b: "error|loop of parents",
  });
});

test("names of Object.prototype are ordinary frame names", () => {
  const names = ["__proto__", "constructor", "toString", "odom"];
  const boxes = names.map((id) => ({ id, width: 80, height: 26 }));
  const { boxes: placed, paths } = layered(
    boxes,
    names.map((to) => ({ from: "odom", to })),
    "LR",
  );
  expect([...placed.keys()]).toEqual(names);
  expect(paths.every((path) => path.startsWith("M"))).toBe(true);
  expect(Object.keys(Object.prototype)).toEqual([]);
});

test("layers follow the arrows without overlaps, also for loops", () => {
  const boxes = ["a", "b", "c"].map((id) => ({ id, width: 80, height: 26 }));
  const { boxes: placed, paths } = layered(
    boxes,
    [
      { from: "a", to: "b" },
      { from: "b", to: "c" },
      { from: "c", to: "a" },
      { from: "a", to: "a" },
    ],
    "LR",
  );
  const x = (id: string): number => placed.get(id)?.[0] ?? NaN;
  expect(x("b") - x("a")).toBeGreaterThan(80);
  expect(x("c") - x("b")).toBeGreaterThan(80);
  expect(paths.every((path) => /^M[\d.-]+ [\d.-]+[LQ]/.test(path))).toBe(true);
});

test("lays boxes without arrows out in rows below the others, none over another", () => {
  const boxes = Array.from({ length: 20 }, (_, index) => ({ id: `n${index}`, width: 90, height: 26 }));
  const { boxes: placed, width, height } = layered(boxes, [{ from: "n0", to: "n1" }], "LR");
  const centres = [...placed.values()];
  expect(centres).toHaveLength(20);
  for (const [index, [x, y]] of centres.entries()) {
    expect([x >= 45, x <= width - 45, y >= 13, y <= height - 13]).toEqual([true, true, true, true]);
    for (const [u, v] of centres.slice(index + 1)) expect(Math.abs(u - x) >= 90 || Math.abs(v - y) >= 26).toBe(true);
  }
  expect(width / height).toBeGreaterThan(2);
});
