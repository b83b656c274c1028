import { expect, test } from "vitest";

import { cutAt } from "../../src/theme/name";

const tail = (text: string, beside: readonly string[] = []): string => text.slice(cutAt(text, beside));

test("the end of a long name stays, with what tells it from others", () => {
  expect(tail("warehouse_base_front_left_000017")).toBe("t_000017");
  expect(tail("倉庫の北側にある自律移動ロボットの車輪17号機")).toBe("トの車輪17号機");
});

test("values of two joints differ before their quantity, which stays, too", () => {
  expect(tail("chassis_left_wheel.velocity")).toBe("ft_wheel.velocity");
  expect(tail("chassis_right_wheel.velocity")).toBe("ht_wheel.velocity");
});

test("the end that stays begins where a name differs from those beside it", () => {
  const wheels = ["chassis_left_wheel.velocity", "chassis_right_wheel.velocity", "arm.velocity"];
  expect(wheels.map((name) => tail(name, wheels))).toEqual(["left_wheel.velocity", "right_wheel.velocity", ""]);
  expect(tail("a_very_long_wheel_name", ["another_long_wheel_name"])).toBe("eel_name");
  expect(tail("x_👩‍🚀_of_the_first_crew", ["x_👩‍🚀_of_the_second_crew"])).toBe("first_crew");
});

test("a short name has no end that stays", () => {
  expect(tail("netbook_webcam")).toBe("");
});

test("no character is torn apart: neither one of several code points nor letters that join", () => {
  expect(tail(`${"x".repeat(20)}${"👩‍🚀".repeat(8)}`)).toBe("👩‍🚀".repeat(8));
  expect(tail("العجلة_الأمامية_اليسرى_12")).toBe("_12");
  expect(tail("العجلة الأمامية اليسرى")).toBe("");
});
