import { signal } from "@preact/signals";
import { Quaternion, Vector3 } from "three";
import { describe, expect, test } from "vitest";

import { progressText } from "../../src/panels/compare/compare_state";
import { differenceOf, referenceBetween, referenceOf } from "../../src/panels/plots/reference_curve";
import { linesOf, valueAt } from "../../src/panels/plots/line";
import type { Curve } from "../../src/panels/plots/curve";
import { RingBuffer } from "../../src/panels/plots/ring_buffer";
import { ReferenceMotion } from "../../src/scene/world/reference_motion";

const SAMPLES = 101;
const INFO = {
  title: "run.log",
  url: "world/a.bin",
  start: 10,
  offset: 10,
  duration: 2,
  samples: SAMPLES,
  links: ["cart::base", "cart::mast"],
  joints: ["cart::wheel"],
  topics: [],
  root: "",
};

/** A cart that drives along x at 1 m/s and turns about z at 2 rad/s; its wheel turns at 3 rad/s. */
function motion(): ReferenceMotion {
  const times = Array.from({ length: SAMPLES }, (_, at) => at * 0.02);
  const poses = times.flatMap((time) => {
    const pose = [time, 0, 0.5, 0, 0, Math.sin(time), Math.cos(time)];
    return [...pose, ...pose];
  });
  const data = new ArrayBuffer(8 * 2 * SAMPLES + 4 * poses.length);
  new Float64Array(data, 0, 2 * SAMPLES).set([...times, ...times.map((time) => 3 * time)]);
  new Float32Array(data, 16 * SAMPLES).set(poses);
  return new ReferenceMotion(INFO, data);
}

const value = (name: string, at: number): number => motion().find(name)?.values[at] ?? NaN;

describe("the motion of a recording", () => {
  test("is interpolated, and held before its start and after its end", () => {
    const [position, turn] = [new Vector3(), new Quaternion()];
    const x = (time: number): number => {
      motion().pose(1, time, position, turn);
      return position.x;
    };
    expect([x(-1), x(0), x(0.51), x(2), x(9)].map((found) => Number(found.toFixed(4)))).toEqual([0, 0, 0.51, 2, 2]);
  });

  test("has the values of plots", () => {
    expect(value("cart.pose.x", 50)).toBeCloseTo(1);
    expect(value("cart::mast.pose.yaw", 50)).toBeCloseTo(2);
    expect(value("cart.twist.linear.x", 50)).toBeCloseTo(1, 4);
    expect(value("cart::base.twist.angular.z", 50)).toBeCloseTo(2, 3);
    expect(value("cart::wheel.position", 50)).toBeCloseTo(3);
    expect(value("cart::wheel.velocity", 50)).toBeCloseTo(3);
    for (const name of ["cart::wheel.effort", "cart.contact.count", "box.pose.x", "cart.pose.w", "cart", "a.b.c"])
      expect(motion().find(name)).toBeNull();
  });

  test("has the numbers of a bag's topics, by paths as people write them", () => {
    const topics = [{ topic: "/joint_states", samples: 2, paths: [".position[left]", ".position[right]"] }];
    const bag = { ...INFO, samples: 1, links: ["base_link"], joints: [], topics, root: "odom" };
    const data = new ArrayBuffer(8 * 7 + 28);
    new Float64Array(data, 0, 7).set([0, 0, 0.5, 1, 2, 3, 4]);
    const reference = { info: bag, motion: new ReferenceMotion(bag, data) };
    const values = (path: string): readonly number[] => [...(referenceOf({ path }, reference)?.values ?? [])];
    expect(values("/joint_states.position[right]")).toEqual([2, 4]);
    expect(values("/joint_states/position[left]")).toEqual([1, 3]);
    expect(values("/joint_states/position[1]")).toEqual([2, 4]);
    expect([...(referenceOf({ path: "/joint_states.position[0]" }, reference)?.times ?? [])]).toEqual([0, 0.5]);
    expect(referenceOf({ path: "/odom.pose.pose.position.x" }, reference)).toBeNull();
  });

  test("is refused if it is truncated", () => {
    expect(() => new ReferenceMotion(INFO, new ArrayBuffer(100))).toThrow("it is incomplete");
  });
});

describe("a plotted recording", () => {
  const series = motion().find("cart.pose.x");
  if (series === null) throw new Error("no series");

  test("starts with the run's start and the offset", () => {
    const [xs, ys] = referenceBetween(series, 10, 10.995, 11.005);
    expect([...xs].map((x) => Number(x.toFixed(3)))).toEqual([10.98, 11, 11.02]);
    expect(ys[1]).toBeCloseTo(1);
  });

  test("is subtracted at the run's times that it has", () => {
    const [xs, ys] = differenceOf([Float64Array.of(9, 10.51, 11.3, 13), Float64Array.of(0, 3, 3, 3)], series, 10);
    expect([...xs]).toEqual([10.51, 11.3]);
    expect([...ys].map((y) => Number(y.toFixed(4)))).toEqual([2.49, 1.7]);
  });

  test("angles differ by half a turn at most", () => {
    const yaw = motion().find("cart.pose.yaw");
    if (yaw === null) throw new Error("no series");
    const [, ys] = differenceOf([Float64Array.of(11.7), Float64Array.of(-2.9)], yaw, 10);
    expect(ys[0]).toBeCloseTo(-2.9 - (3.4 - 2 * Math.PI), 3);
  });

  test("is a second line, or the difference, or absent", () => {
    const points = new RingBuffer(10);
    points.push(11, 5);
    const curve = { path: "cart.pose.x", points, axis: signal("left") } as unknown as Curve;
    const reference = { info: INFO, motion: motion() };
    const names = (mode: Parameters<typeof linesOf>[1]): readonly string[] =>
      linesOf([curve], mode, reference).map(({ name }) => name);
    expect(names("With reference")).toEqual(["cart.pose.x", "cart.pose.x (reference)"]);
    expect(names("Difference")).toEqual(["cart.pose.x (difference)"]);
    expect(names("Run alone")).toEqual(["cart.pose.x"]);
    expect(linesOf([curve], "With reference", null).length).toBe(1);
    const values = linesOf([curve], "With reference", reference).map((line) => valueAt(line, 11));
    expect(values.map((found) => Number(found?.toFixed(3)))).toEqual([5, 1]);
  });

  test("has no value after the recording's end", () => {
    const points = new RingBuffer(10);
    points.push(11, 5);
    points.push(14, 5);
    const curve = { path: "cart.pose.x", points, axis: signal("left") } as unknown as Curve;
    const reference = { info: INFO, motion: motion() };
    const at = (mode: Parameters<typeof linesOf>[1], time: number): readonly (number | null)[] =>
      linesOf([curve], mode, reference).map((line) => valueAt(line, time));
    expect(at("With reference", 12)[1]).toBeCloseTo(2);
    expect(at("With reference", 12.5)).toEqual([5, null]);
    expect(at("Difference", 14)).toEqual([null]);
  });
});

test.each([
  [8, "starts in 2.0 s"],
  [11.5, "1.5 of 2.0 s"],
  [13, "ended 1.0 s ago, at its last poses"],
])("at %f s the recording %s", (time, text) => {
  expect(progressText(INFO, time)).toBe(text);
});
