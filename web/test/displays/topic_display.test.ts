import { Quaternion, Vector3, type Mesh } from "three";
import { expect, it, vi } from "vitest";

import "../../src/displays/laser_scan";
import "../../src/displays/point_cloud";
import "../../src/displays/point_cloud2";
import "../../src/displays/temperature";
import type { CloudDisplay } from "../../src/displays/clouds/cloud_display";
import { project } from "../../src/displays/laser_scan";
import { displayClass } from "../../src/displays/registry";
import type { LaserScan } from "../../src/protocol/generated/ros_messages";
import { fakes, header, status, type Fakes } from "./fakes";

function start(
  className: string,
  topic: string,
  type: string,
  around = fakes(),
): { display: CloudDisplay<LaserScan>; around: Fakes } {
  const display = displayClass(className)?.create(around.context) as CloudDisplay<LaserScan>;
  around.connection.advertise(topic, type);
  display.topicProperty.value.value = topic;
  display.start();
  return { display, around };
}

const SCAN = "sensor_msgs/LaserScan";

function scan(changes: Partial<LaserScan> = {}): LaserScan {
  return {
    header: header("laser"),
    angle_min: 0,
    angle_max: 1,
    angle_increment: Math.PI / 2,
    time_increment: 0,
    scan_time: 0,
    range_min: 0.1,
    range_max: 10,
    ranges: new Float32Array([1, 2, 3]),
    intensities: new Float32Array(),
    ...changes,
  };
}

it("reports missing messages, and why", () => {
  const around = fakes();
  const display = displayClass("rviz/LaserScan")?.create(around.context) as CloudDisplay<LaserScan>;
  display.start();
  expect(display.statuses.value.get("Topic")).toEqual({
    level: "warn",
    text: "No messages received",
    advice: "Choose a topic.",
  });
  display.topicProperty.value.value = "/scan";
  expect(display.statuses.value.get("Topic")?.advice).toBe("Nothing publishes /scan.");
  around.connection.advertise("/scan", SCAN);
  expect(display.statuses.value.get("Topic")).toEqual({ level: "warn", text: "No messages received" });
});

it("keeps a message until its transform arrives, and reports the missing one after a second", () => {
  const { display, around } = start("rviz/LaserScan", "/scan", SCAN);
  around.connection.receive("/scan", scan());
  expect(status(display, "Topic")).toBe("ok: 1 messages received");
  expect(status(display, "Transform")).toBeUndefined();
  display.update(0n, 0.6);
  display.update(0n, 0.6);
  expect(status(display, "Transform")).toBe("error: No transform from [laser] to [map]");
  expect(display.root.children).toHaveLength(0);

  around.frames.set("laser");
  display.update(0n, 0.1);
  expect(status(display, "Transform")).toBe("ok: Transform OK");
  expect(status(display, "Points")).toBe("ok: Showing [3] points from [1] messages");
});

it("drops the oldest message of a full queue", () => {
  const { display, around } = start("rviz/LaserScan", "/scan", SCAN);
  display.queueSize.value.value = 2;
  display.cloudProperties.decay.value.value = 100;
  for (let count = 0; count < 4; count++) around.connection.receive("/scan", scan());
  expect(status(display, "Transform")).toBe("error: No transform from [laser] to [map]");
  around.frames.set("laser");
  display.update(0n, 0.1);
  expect(status(display, "Points")).toBe("ok: Showing [6] points from [2] messages");
});

it("resolves a topic without a slash in the root namespace", () => {
  const { display, around } = start("rviz/LaserScan", "scan", SCAN);
  expect([display.topic, around.connection.subscriptions("/scan")]).toEqual(["/scan", 1]);
});

it("names a message of another type, one of another definition, and one that cannot be decoded", () => {
  const { display, around } = start("rviz/LaserScan", "/scan", "std_msgs/String");
  around.connection.receive("/scan", { data: "x" });
  expect(status(display, "Topic")).toBe("error: /scan is of type std_msgs/String, not sensor_msgs/LaserScan");
  around.connection.advertise("/scan", SCAN);
  around.connection.receive("/scan", { ...scan(), ranges: undefined });
  expect(status(display, "Topic")).toMatch(/^error: Message is not a sensor_msgs\/LaserScan as it is known here/);
  around.connection.fail("/scan", "3 bytes are missing");
  expect(status(display, "Topic")).toBe("error: 3 bytes are missing");
  around.connection.receive("/scan", scan());
  expect(status(display, "Topic")).toBe("ok: 2 messages received");
});

it("refuses angles that are not numbers", () => {
  const { display, around } = start("rviz/LaserScan", "/scan", SCAN);
  for (const changes of [{ angle_min: NaN }, { angle_increment: Infinity }, { time_increment: NaN }]) {
    around.connection.receive("/scan", scan(changes));
    expect(status(display, "Topic")).toBe("error: Message contained invalid floating point values (nans or infs)");
  }
});

it("restarts with another fixed frame, and frees everything when it stops", () => {
  const { display, around } = start("rviz/LaserScan", "/scan", SCAN);
  around.frames.set("laser");
  around.connection.receive("/scan", scan());
  display.update(0n, 0.1);
  expect(display.root.children).toHaveLength(1);
  const geometry = (display.root.children[0]?.children[0] as Mesh).geometry;
  const freed = vi.fn();
  geometry.addEventListener("dispose", freed);

  around.fixedFrame.value = "odom";
  expect(display.root.children).toHaveLength(0);
  expect(freed).toHaveBeenCalled();
  expect(status(display, "Topic")).toBe("warn: No messages received");
  expect(around.connection.subscriptions("/scan")).toBe(1);
  display.stop();
  expect(around.connection.subscriptions("/scan")).toBe(0);
  expect(around.context.scene.displays.children).toHaveLength(0);
});

it("shows the latest cloud, or those of the decay time", () => {
  const { display, around } = start("rviz/LaserScan", "/scan", SCAN);
  around.frames.set("laser");
  const receive = (at: bigint): void => {
    around.connection.time = at;
    around.connection.receive("/scan", scan());
    display.update(at, 0.1);
  };
  receive(1_000_000_000n);
  receive(2_000_000_000n);
  expect(display.root.children).toHaveLength(1);
  display.cloudProperties.decay.value.value = 1.5;
  receive(3_000_000_000n);
  expect(display.root.children).toHaveLength(2);
  display.update(3_600_000_000n, 0.1);
  expect(display.root.children).toHaveLength(1);
  display.update(9_000_000_000n, 0.1);
  expect(display.root.children).toHaveLength(0);
});

it("a scan's points are those within its range, in the fixed frame", () => {
  const at = { position: new Vector3(1, 0, 0.5), orientation: new Quaternion() };
  const cloud = project(
    scan({
      ranges: new Float32Array([1, 0.05, 10, NaN, Infinity, 2]),
      intensities: new Float32Array([7, 8, 9, 1, 2, 3]),
    }),
    at,
    at,
  );
  expect(cloud.count).toBe(2);
  const values = [...cloud.floats].map((value) => Math.round(value * 1e4) / 1e4);
  expect(values).toEqual([2, 0, 0.5, 7, 1, 2, 0.5, 3]);
});

it("a scan's rays are placed where the sensor was when each was measured", () => {
  const start = { position: new Vector3(0, 0, 0), orientation: new Quaternion() };
  const end = {
    position: new Vector3(0, 1, 0),
    orientation: new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), Math.PI / 2),
  };
  const cloud = project(scan({ angle_increment: 0, ranges: new Float32Array([1, 1, 1]) }), start, end);
  const half = Math.SQRT1_2;
  [1, 0, 0, half, 0.5 + half, 0, 0, 2, 0].forEach((value, index) => expect(cloud.floats[index]).toBeCloseTo(value, 5));
});

it("a long scan waits for its last ray's transform, and is named", () => {
  const { display, around } = start("rviz/LaserScan", "/scan", SCAN);
  const times: bigint[] = [];
  around.frames.poses.set("laser", (time) => {
    times.push(time);
    return time <= 2_000_000_000n ? { position: new Vector3(), orientation: new Quaternion() } : null;
  });
  around.connection.receive("/scan", scan({ time_increment: 0.75 }));
  expect(times).toEqual([1_000_000_000n, 2_500_000_000n]);
  expect(status(display, "Scan Time")).toMatch(/^warn: Laser scan time.* is rather large: 2s/);
  expect(status(display, "Transform")).toBeUndefined();
});

it("Temperature colors by its own channel and hides what rviz hides", () => {
  const { display, around } = start("rviz/Temperature", "/t", "sensor_msgs/Temperature");
  around.frames.set("laser");
  around.connection.receive("/t", { header: header("laser"), temperature: 25, variance: 0 });
  display.update(0n, 0.1);
  const { cloudProperties } = display;
  expect([cloudProperties.minIntensity.value.value, cloudProperties.maxIntensity.value.value]).toEqual([0, 100]);
  const shown = cloudProperties.all.filter(({ options }) => options.visible?.value ?? true).map(({ name }) => name);
  expect(shown).toEqual([
    "Selectable",
    "Style",
    "Size (m)",
    "Alpha",
    "Decay Time",
    "Use rainbow",
    "Min Intensity",
    "Max Intensity",
  ]);
});

it("saves and loads as rviz writes it", () => {
  const around = fakes();
  const display = displayClass("rviz_default_plugins/PointCloud2")?.create(around.context) as CloudDisplay<LaserScan>;
  const file = {
    Alpha: 0.5,
    "Autocompute Intensity Bounds": false,
    "Autocompute Value Bounds": { "Max Value": 3, "Min Value": -1, Value: false },
    Axis: "X",
    "Channel Name": "ring",
    "Color Transformer": "AxisColor",
    "Decay Time": 2,
    "Position Transformer": "XYZ",
    "Size (Pixels)": 5,
    "Size (m)": 0.05,
    Style: "Boxes",
    Topic: "/points",
    "Use rainbow": false,
  };
  expect(display.load(file)).toEqual([]);
  expect(display.save()).toMatchObject(file);
});
