import { expect, test } from "vitest";

import { messageRows, valueText } from "../../src/panels/messages/message_rows";

const all = (): boolean => true;

test("fields, their units and times", () => {
  const twist = { twist: { linear: { x: -0.25 }, covariance: new Float64Array(2) }, stamp: { sec: 65, nsec: 5 } };
  expect(messageRows("nav_msgs/Odometry", twist, all).map((row) => [row.key, row.depth, row.text, row.unit])).toEqual([
    [".twist", 0, "", ""],
    [".twist.linear", 1, "", ""],
    [".twist.linear.x", 2, "−0.25", "m/s"],
    [".twist.covariance", 1, "[0, 0]", ""],
    [".twist.covariance[0]", 2, "0", ""],
    [".twist.covariance[1]", 2, "0", ""],
    [".stamp", 0, "65.000000005 s  (1:05.00)", ""],
  ]);
});

test("a closed header shows its stamp and frame", () => {
  expect(valueText({ seq: 3, stamp: { sec: 12, nsec: 480_000_000 }, frame_id: "laser" })).toBe("0:12.48 in laser");
});

test("long arrays are summarised, and open by the hundred", () => {
  const message = { ranges: Float32Array.from({ length: 250 }, (_, index) => index / 2) };
  const closed = messageRows("sensor_msgs/LaserScan", message, () => false);
  expect(closed.map((row) => row.text)).toEqual(["[0, 0.5, 1, 1.5, …] 250 elements"]);
  const open = messageRows(
    "sensor_msgs/LaserScan",
    message,
    (key) => key === ".ranges" || key.startsWith(".ranges[200"),
  );
  expect(open.map((row) => row.name).slice(0, 5)).toEqual([
    "ranges",
    "[0 … 99]",
    "[100 … 199]",
    "[200 … 249]",
    "[200]",
  ]);
  expect(open.at(-1)).toMatchObject({ key: ".ranges[249]", text: "124.5", unit: "m" });
  expect(valueText(new Uint8Array(921_600))).toBe("921600 bytes");
});

test("elements with names in the message are shown by name", () => {
  const rows = messageRows("sensor_msgs/JointState", { name: ["left", "right"], position: [1, 2], effort: [] }, all);
  expect(rows.filter((row) => row.key.startsWith(".position[")).map((row) => [row.key, row.name])).toEqual([
    [".position[0]", "left"],
    [".position[1]", "right"],
  ]);
  expect(rows.at(-1)).toMatchObject({ name: "effort", text: "[]", open: undefined });
});
