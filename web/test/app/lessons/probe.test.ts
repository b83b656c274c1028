// @vitest-environment jsdom
import { signal } from "@preact/signals";
import { Quaternion, Vector3 } from "three";
import { afterEach, beforeEach, expect, it, vi } from "vitest";

import { probe, watchProbes, type Check, type Progress } from "../../../src/app/lessons/probe";
import { fakePage, type FakePage } from "../../fake_page";
import { MANIFEST } from "../../harness/manifest";

let page: FakePage;
const robot = signal<string | null>("rp2w");

beforeEach(() => {
  page = fakePage();
  page.world.manifest.value = MANIFEST;
});
afterEach(() => vi.useRealTimers());

const noFile = (): Promise<string | null> => Promise.resolve("no file");

function isDone(check: Check): boolean {
  const watched = probe({ page, robot }, check, noFile);
  const { done } = watched.poll();
  watched.close();
  return done;
}

it("finds models, the robot, the selection and the fixed frame", () => {
  expect(isDone({ check: "model", model: "rp2w" })).toBe(true);
  expect(isDone({ check: "model", model: "cart" })).toBe(false);
  expect(isDone({ check: "robot", name: "rp2w" })).toBe(true);
  page.selection.value = { kind: "link", model: "rp2w", link: "chassis" };
  expect(isDone({ check: "selected", model: "rp2w" })).toBe(true);
  page.selection.value = { kind: "world" };
  expect(isDone({ check: "selected", model: "rp2w" })).toBe(false);
  expect(isDone({ check: "fixed_frame", frame: "map" })).toBe(true);
  expect(isDone({ check: "fixed_frame", frame: "odom" })).toBe(false);
});

it("finds nodes, publishers and subscribers other than the page", () => {
  const { graph } = page.connection;
  const checks: readonly Check[] = [
    { check: "publishes", topic: "/cmd_vel" },
    { check: "subscribes", topic: "/cmd_vel" },
  ];
  for (const names of [new Map(), new Map([["/cmd_vel", ["/trundle_page_1", "/rviz"]]])]) {
    graph.value = { ...graph.value, publishers: names, subscribers: names };
    expect(checks.map(isDone)).toEqual([false, false]);
  }
  const names = new Map([["/cmd_vel", ["/trundle_page_1", "/base"]]]);
  graph.value = { ...graph.value, publishers: names, subscribers: names };
  expect(checks.map(isDone)).toEqual([true, true]);
  expect(isDone({ check: "node", node: "/base" })).toBe(true);
  expect(isDone({ check: "node", node: "/gone" })).toBe(false);
});

it("measures how far a model is from where the step began", () => {
  const at = new Vector3(1, 2, 0);
  page.world.pose = () => ({ position: at.clone(), orientation: new Quaternion() });
  const moved = probe({ page, robot }, { check: "moved", model: "rp2w", distance: 0.5 }, noFile);
  expect(moved.poll()).toEqual({ done: false, detail: "0.00 m so far" });
  at.x += 0.3;
  expect(moved.poll()).toEqual({ done: false, detail: "0.30 m so far" });
  at.y += 0.4;
  expect(moved.poll().done).toBe(true);
  expect(isDone({ check: "moved", model: "cart", distance: 0.5 })).toBe(false);
});

it("asks for a file until it is closed, and polls when something changes", async () => {
  vi.useFakeTimers();
  const faults: (string | null)[] = ["it does not exist", null];
  const ask = vi.fn(() => Promise.resolve(faults.shift() ?? null));
  let progress: readonly Progress[] = [];
  const stop = watchProbes(
    [
      probe({ page, robot }, { check: "file", path: "a.yaml" }, ask),
      probe({ page, robot }, { check: "fixed_frame", frame: "odom" }, noFile),
    ],
    (now) => {
      progress = now;
    },
  );
  await vi.advanceTimersByTimeAsync(300);
  expect(progress).toEqual([
    { done: false, detail: "it does not exist" },
    { done: false, detail: "" },
  ]);
  page.displays.fixedFrame.value = "odom";
  expect(progress[1]?.done).toBe(true);
  await vi.advanceTimersByTimeAsync(2000);
  expect(progress[0]).toEqual({ done: true, detail: "" });
  stop();
  const asked = ask.mock.calls.length;
  await vi.advanceTimersByTimeAsync(10_000);
  expect(ask.mock.calls.length).toBe(asked);
});
