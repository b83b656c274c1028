import { Box3, Mesh, Quaternion, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import "../../src/displays/all";
import type { HistoryDisplay } from "../../src/displays/history_display";
import { flatArrows } from "../../src/displays/pose_array";
import { displayedRange } from "../../src/displays/range";
import { displayClass } from "../../src/displays/registry";
import type { Stamped } from "../../src/displays/topic_display";
import type { Range } from "../../src/protocol/generated/ros_messages";
import { makeMessage } from "../harness/messages";
import { fakes, header, status, type Fakes } from "./fakes";

type Any = HistoryDisplay<Stamped>;

function start(
  className: string,
  type: string,
  yaml: Record<string, never> | object = {},
): { display: Any; around: Fakes; send: (message: unknown) => void } {
  const around = fakes();
  around.frames.set("tilted");
  around.connection.advertise("/t", type);
  const display = displayClass(className)?.create(around.context) as Any;
  expect(display.load({ Enabled: true, Topic: "/t", ...(yaml as Record<string, never>) })).toEqual([]);
  display.start();
  const send = (message: unknown): void => {
    around.connection.receive("/t", message);
    display.update(0n, 0.01);
  };
  return { display, around, send };
}

/** Extent of what a display drew, rounded to mm. */
function extent(display: Any): { min: number[]; max: number[] } {
  display.root.updateMatrixWorld(true);
  const box = new Box3().setFromObject(display.root, true);
  const round = (vector: Vector3): number[] => vector.toArray().map((value) => Math.round(value * 1000) / 1000 + 0);
  return { min: round(box.min), max: round(box.max) };
}

const ALL: readonly [className: string, type: string, message: string][] = [
  ["rviz/Pose", "geometry_msgs/PoseStamped", "pose"],
  ["rviz/PoseArray", "geometry_msgs/PoseArray", "poses"],
  ["rviz/PoseWithCovariance", "geometry_msgs/PoseWithCovarianceStamped", "sure"],
  ["rviz/Odometry", "nav_msgs/Odometry", "odometry 0"],
  ["rviz/Path", "nav_msgs/Path", "path"],
  ["rviz/PointStamped", "geometry_msgs/PointStamped", "point"],
  ["rviz/Polygon", "geometry_msgs/PolygonStamped", "polygon"],
  ["rviz/GridCells", "nav_msgs/GridCells", "cells"],
  ["rviz/Range", "sensor_msgs/Range", "range"],
  ["rviz/WrenchStamped", "geometry_msgs/WrenchStamped", "wrench"],
  ["rviz/TwistStamped", "geometry_msgs/TwistStamped", "twist"],
  ["rviz/AccelStamped", "geometry_msgs/AccelStamped", "accel"],
  ["rviz_imu_plugin/Imu", "sensor_msgs/Imu", "imu"],
];

describe.each(ALL)("%s", (className, type, message) => {
  it("draws a message, keeps one, and frees its objects", () => {
    const { display, send } = start(className, type);
    send(makeMessage(message));
    expect(display.root.children).toHaveLength(1);
    const [drawn] = display.root.children;
    const { selectable } = drawn?.userData as { selectable: { describe: () => object } };
    expect(selectable.describe()).toHaveProperty("Frame");
    const freed: string[] = [];
    drawn?.traverse((part) => {
      if (part instanceof Mesh)
        (part.material as { addEventListener: (name: string, run: () => void) => void }).addEventListener(
          "dispose",
          () => freed.push(part.uuid),
        );
    });
    display.topicProperty.value.value = "/other";
    expect(display.root.children).toHaveLength(0);
    let meshes = 0;
    drawn?.traverse((part) => {
      if (part instanceof Mesh && (part as Mesh).geometry.getAttribute("position").count > 0) meshes += 1;
    });
    expect(freed.length).toBeGreaterThanOrEqual(meshes);
  });

  it.each([NaN, Infinity])("refuses a message with %d anywhere that rviz checks", (value) => {
    const { display, send } = start(className, type);
    send(spoil(makeMessage(message), value));
    expect(status(display, "Topic")).toBe("error: Message contained invalid floating point values (nans or infs)");
    expect(display.root.children).toHaveLength(0);
    send(makeMessage(message));
    expect(status(display, "Topic")).toBe("ok: 2 messages received");
  });

  it("reports a message without fields", () => {
    const { display, send } = start(className, type);
    send({ header: header("map") });
    expect(status(display, "Topic")).toMatch(/^error: Message (is not a|contained invalid)/);
  });

  it("saves the loaded properties", () => {
    const { display } = start(className, type);
    const saved = display.save();
    const copy = displayClass(className)?.create(fakes().context);
    expect(copy?.load(saved)).toEqual([]);
    expect(copy?.save()).toEqual(saved);
  });
});

/** Put a value where a message has its first number beside the header. */
function spoil(message: unknown, value: number): unknown {
  if (message instanceof Float64Array) return message;
  if (Array.isArray(message))
    return (message as unknown[]).map((part, index) => (index === 0 ? spoil(part, value) : part));
  let isDone = false;
  const entries = Object.entries(message as Record<string, unknown>).map(([key, part]): [string, unknown] => {
    if (isDone || key === "header" || key === "radiation_type" || typeof part === "string") return [key, part];
    isDone = true;
    return [key, typeof part === "number" ? value : spoil(part, value)];
  });
  return Object.fromEntries(entries);
}

describe("sizes are rviz's:", () => {
  it("a pose's arrow is its shaft and its head long, as thick as its radii say", () => {
    const { display, send } = start("rviz/Pose", "geometry_msgs/PoseStamped");
    send({ header: header("map"), pose: { position: { x: 1, y: 2, z: 3 }, orientation: { x: 0, y: 0, z: 0, w: 0 } } });
    expect(extent(display)).toEqual({ min: [1, 1.95, 2.95], max: [2.3, 2.05, 3.05] });
  });

  it("a range's cone stands on its tip and opens by the field of view", () => {
    const { display, send } = start("rviz/Range", "sensor_msgs/Range");
    send(makeMessage("range"));
    const { min, max } = extent(display);
    expect([min[0], max[0]]).toEqual([0, 2]);
    expect(max[1]).toBeCloseTo(2 * Math.tan(0.25), 2);
  });

  it("a wrench's arrow is 1.3 times its force times its scale", () => {
    const { display, send } = start("rviz/WrenchStamped", "geometry_msgs/WrenchStamped");
    send({ header: header("map"), wrench: { force: { x: 0, y: 0, z: 3 }, torque: { x: 0, y: 0, z: 0 } } });
    expect(extent(display).max[2]).toBe(7.8);
    send({ header: header("map"), wrench: { force: { x: 0, y: 0, z: 0.2 }, torque: { x: 0, y: 0, z: 0 } } });
    expect(extent(display).max[2]).not.toBe(0.52); // hidden: 0.4 is less than the width of 0.5
    display.load({ "Hide Small Values": false });
    display.update(0n, 0.01);
    expect(extent(display).max[2]).toBe(0.52);
  });

  it("a point is a sphere of its radius", () => {
    const { display, send } = start("rviz/PointStamped", "geometry_msgs/PointStamped", { Radius: 0.5 });
    send({ header: header("map"), point: { x: 0, y: 0, z: 1 } });
    expect(extent(display)).toEqual({ min: [-0.5, -0.5, 0.5], max: [0.5, 0.5, 1.5] });
  });

  it("flat arrows have rviz's corners", () => {
    const pose = { position: { x: 1, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: Math.SQRT1_2, w: Math.SQRT1_2 } };
    const points = [...flatArrows([pose], 2)].map((value) => Math.round(value * 100) / 100 + 0);
    expect(points).toEqual([1, 0, 0, 1, 2, 0, 1, 2, 0, 0.6, 1.5, 0, 1, 2, 0, 1.4, 1.5, 0]);
  });

  it.each([
    [2, 0.1, 4, 2],
    [5, 0.1, 4, 0],
    [0.05, 0.1, 4, 0],
    [NaN, 0.1, 4, 0],
    [Infinity, 0.1, Infinity, 0],
    [-Infinity, 1, 1, 1],
    [Infinity, 1, 1, 0],
    [NaN, 1, 1, 0],
  ])("a range of %d between %d and %d is shown %d m long", (range, min_range, max_range, shown) => {
    expect(displayedRange({ range, min_range, max_range } as Range)).toBe(shown);
  });
});

describe("Odometry", () => {
  it("draws where the robot moved or turned by the tolerance, and keeps the last", () => {
    const { display, send } = start("rviz/Odometry", "nav_msgs/Odometry", { Keep: 3, "Position Tolerance": 0.5 });
    for (let step = 0; step < 10; step++) send(makeMessage("odometry 0"));
    expect(display.root.children).toHaveLength(1);
    for (let step = 0; step < 60; step += 10) send(makeMessage(`odometry ${step}`));
    expect(display.root.children).toHaveLength(3);
  });
});

describe("a path", () => {
  it("shows as many as its buffer, at its offset", () => {
    const { display, send } = start("rviz/Path", "nav_msgs/Path", { "Buffer Length": 2, Offset: { X: 0, Y: 0, Z: 5 } });
    for (let count = 0; count < 3; count++) send(makeMessage("path"));
    expect(display.root.children).toHaveLength(2);
    expect(display.root.position.z).toBe(5);
    display.load({ "Buffer Length": 1 });
    display.update(0n, 0.01);
    expect(display.root.children).toHaveLength(1);
  });

  it("of no or one pose draws nothing, without a fault", () => {
    const { display, send } = start("rviz/Path", "nav_msgs/Path");
    send({ header: header("map"), poses: [] });
    expect(status(display, "Topic")).toBe("ok: 1 messages received");
    expect(display.root.children[0]?.children).toHaveLength(0);
  });
});

it("an IMU is turned from the fixed frame, or from its own", () => {
  const { display, around, send } = start("rviz_imu_plugin/Imu", "sensor_msgs/Imu");
  const tilt = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), 1);
  around.frames.set("tilted", 0, 0, 1, tilt);
  send(makeMessage("imu"));
  expect(display.root.children[0]?.quaternion.angleTo(new Quaternion())).toBeCloseTo(0);
  display.load({ fixed_frame_orientation: false });
  display.update(0n, 0.01);
  expect(display.root.children[0]?.quaternion.angleTo(tilt)).toBeCloseTo(0);
});

it("grid cells of no size are named, as in rviz", () => {
  const { display, send } = start("rviz/GridCells", "nav_msgs/GridCells");
  send({ ...(makeMessage("cells") as object), cell_width: 0 });
  expect(status(display, "Topic")).toBe("error: Cell width is zero, cells will be invisible.");
});

it("a change of a property redraws shown messages", () => {
  const { display, around, send } = start("rviz/PointStamped", "geometry_msgs/PointStamped");
  send(makeMessage("point"));
  const [before] = display.root.children;
  display.load({ Radius: 1 });
  display.update(0n, 0.01);
  expect(display.root.children[0]).not.toBe(before);
  expect(around.invalidated.count).toBeGreaterThan(0);
});
