import { expect, test } from "vitest";

import { age, bytes, exact, significant, timeText } from "../../src/panels/messages/format";
import { unitOf } from "../../src/panels/messages/units";

test("numbers have a true minus sign, and zero none", () => {
  expect([significant(-0.000123456), significant(123456), significant(0)]).toEqual(["−0.0001235", "123456", "0"]);
  expect(significant(6.02e23)).toBe("6.020e+23");
});

test("echo writes a float32 by its shortest text, a float64 exactly", () => {
  expect([exact(Math.fround(0.1)), exact(0.1), exact(1 / 3), exact(123456792), exact(-5n), exact(Infinity)]).toEqual([
    "0.1",
    "0.1",
    "0.3333333333333333",
    "123456792",
    "−5",
    "inf",
  ]);
});

test("sizes and ages", () => {
  expect([bytes(960), bytes(29_400), bytes(13_800_000), bytes(999_960)]).toEqual([
    "960 B",
    "29.4 kB",
    "13.8 MB",
    "1.0 MB",
  ]);
  expect([age(0.036), age(61), age(7300)]).toEqual(["0.04 s", "1 min", "2 h"]);
});

test("times of a simulation and of the wall", () => {
  expect([timeText(12.48), timeText(3, 0)]).toEqual(["0:12.48", "0:03"]);
  const noon = new Date(2024, 4, 6, 12, 3, 20).getTime() / 1000;
  const midnight = new Date(2024, 4, 6, 0, 3, 20).getTime() / 1000;
  expect([timeText(noon + 0.25), timeText(midnight, 0)]).toEqual(["12:03:20.25", "0:03:20"]);
});

test("units come from the type and the field above", () => {
  expect(unitOf("nav_msgs/Odometry", ["twist", "twist", "linear", "x"])).toBe("m/s");
  expect(unitOf("geometry_msgs/Twist", ["angular", "z"])).toBe("rad/s");
  expect(unitOf("geometry_msgs/AccelStamped", ["accel", "linear", "x"])).toBe("m/s²");
  expect(unitOf("sensor_msgs/LaserScan", ["ranges", "3"])).toBe("m");
  expect(unitOf("std_msgs/Float64", ["data"])).toBe("");
});
