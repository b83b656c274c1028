import { expect, test } from "vitest";

import { MessageType } from "../../src/panels/messages/definition";
import { FormState } from "../../src/panels/messages/form_state";
import { numericPaths } from "../../src/panels/messages/numeric_paths";

const TYPE = MessageType.parse(`std_msgs/Header header
geometry_msgs/Point point
bool latched
uint8[] data
===
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
===
MSG: geometry_msgs/Point
float64 x
float64[2] yz
`);

test("a form has a row per field, with the value of an empty message", () => {
  const form = new FormState(TYPE);
  expect(form.rows.map((row) => [row.path, row.depth, row.isHeading, row.initial])).toEqual([
    ["header", 0, true, ""],
    ["header.seq", 1, false, "0"],
    ["header.stamp", 1, false, "0"],
    ["header.frame_id", 1, false, ""],
    ["point", 0, true, ""],
    ["point.x", 1, false, "0"],
    ["point.yz", 1, false, "[0, 0]"],
    ["latched", 0, false, "false"],
    ["data", 0, false, "[]"],
  ]);
});

test("typed values become the message; now is the time of sending", () => {
  const form = new FormState(TYPE);
  form.set("header.frame_id", "map");
  form.set("header.stamp", "now");
  form.set("point.yz", "[1, -2]");
  expect(form.build(3_000_000_001n)).toEqual({
    message: {
      header: { seq: 0, stamp: { sec: 3, nsec: 1 }, frame_id: "map" },
      point: { x: 0, yz: [1, -2] },
      latched: false,
      data: [],
    },
    faults: new Map(),
  });
});

test("an invalid field is named", () => {
  const form = new FormState(TYPE);
  form.set("point.x", "far");
  form.set("data", "[256]");
  expect([...form.build(0n).faults]).toEqual([
    ["point.x", "x must be a number"],
    ["data", "data[0] must be a whole number from 0 to 255"],
  ]);
});

test("YAML fills the form", () => {
  const form = new FormState(TYPE);
  expect(form.load("{point: {x: 1.5, yz: [2, 3]}, header: {stamp: 2.5}, data: [7, 8]}")).toBeNull();
  const text = (path: string): string =>
    form.rows
      .filter((row) => row.path === path)
      .map((row) => form.text(row))
      .join();
  expect([text("point.x"), text("point.yz"), text("header.stamp"), text("data")]).toEqual([
    "1.5",
    "[2, 3]",
    "2.5",
    "[7, 8]",
  ]);
  expect(form.load("{width: 1}")).toBe("The message has no field width; fields here: header, point, latched, data");
});

test("numbers that can be plotted", () => {
  expect(numericPaths(TYPE)).toEqual([
    ".header.seq",
    ".point.x",
    ".point.yz[0]",
    ".point.yz[1]",
    ".latched",
    ".data[0]",
  ]);
});

test("a type of more values than a form can hold is refused with a sentence", () => {
  const nested = Array.from(
    { length: 30 },
    (_, level) => `===\nMSG: a/L${level}\na/L${level + 1} one\na/L${level + 1} other\n`,
  ).join("");
  for (const text of [
    "float64[1000000000] values",
    `a/L0 first\n${nested}===\nMSG: a/L30\nbool end\n`,
    "a/A first\nbool end\n===\nMSG: a/A\na/A same\n",
  ]) {
    expect(() => new FormState(MessageType.parse(text))).toThrow(
      "It holds more than 100,000 values, too many for a form.",
    );
  }
  expect(new FormState(MessageType.parse("float64[36] covariance")).rows).toHaveLength(1);
});

test("numbers are found in a recursive type", () => {
  expect(numericPaths(MessageType.parse("a/A[] same\n===\nMSG: a/A\nstring name\na/A[] one\na/A[] other\n"))).toEqual(
    [],
  );
});
