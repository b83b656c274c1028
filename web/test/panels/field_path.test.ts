import { describe, expect, test } from "vitest";

import { numberAt, parsePath, parseSteps, pathText } from "../../src/panels/messages/field_path";

const TOPICS = ["/odom", "/odom/filtered", "/joint_states", "/scan"];

describe("paths", () => {
  test.each([
    ["/odom/twist/twist/linear/x", "/odom", "/odom.twist.twist.linear.x"],
    ["/odom.twist.twist.linear.x", "/odom", "/odom.twist.twist.linear.x"],
    ["/odom/filtered/pose", "/odom/filtered", "/odom/filtered.pose"],
    ["/scan/ranges[12]", "/scan", "/scan.ranges[12]"],
    ["/joint_states.position[left wheel]", "/joint_states", "/joint_states.position[left wheel]"],
    ["/not/there/yet/data", "/not/there/yet", "/not/there/yet.data"],
    ["/later.data", "/later", "/later.data"],
  ])("%s", (text, topic, written) => {
    const path = parsePath(text, TOPICS);
    expect(path?.topic).toBe(topic);
    expect(path && pathText(path)).toBe(written);
  });

  test.each(["odom", "/odom..x", "/odom.x[", ""])("%s is not a path", (text) => {
    expect(parsePath(text, TOPICS)).toBeNull();
  });
});

describe("numbers", () => {
  const message = {
    header: { stamp: { sec: 2, nsec: 500_000_000 } },
    name: ["left", "right"],
    position: new Float64Array([0.1, 0.2]),
    ok: true,
    count: 7n,
    points: [{ x: 3 }],
  };
  test.each([
    [".position[1]", 0.2],
    [".position[right]", 0.2],
    [".position[middle]", null],
    [".position[5]", null],
    [".ok", 1],
    [".count", 7],
    [".points[0].x", 3],
    [".header.stamp", 2.5],
    [".header", null],
    [".name[0]", null],
  ])("%s", (text, expected) => {
    expect(numberAt(message, parseSteps(text) ?? [])).toBe(expected);
  });
});
