import { describe, expect, test } from "vitest";

import { MessageType } from "../../src/panels/messages/definition";
import { emptyMessage, messageFromText, valueFromText, ValueError } from "../../src/panels/messages/values";

const TEXT = `
std_msgs/Header header
byte WARN=2
int8 level
uint8[] data
float64[3] position
geometry_msgs/Point[] points
uint64 big
bool on
string name
duration timeout
===
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
===
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
`;
const type = MessageType.parse(TEXT);
const NOW = 12_500_000_000n;

function value(name: string, text: string): unknown {
  const field = type.root.fields.find((known) => known.name === name);
  if (field === undefined) throw new Error(name);
  return valueFromText(type, field, text, NOW);
}

describe("a message of defaults", () => {
  test("has zeros, empty texts and arrays of the fixed length", () => {
    expect(emptyMessage(type)).toEqual({
      header: { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "" },
      level: 0,
      data: [],
      position: [0, 0, 0],
      points: [],
      big: 0n,
      on: false,
      name: "",
      timeout: { sec: 0, nsec: 0 },
    });
    expect(type.root.constants).toEqual([{ name: "WARN", type: "int8", text: "2" }]);
  });
});

describe("typed values", () => {
  test.each([
    ["level", "-3", -3],
    ["big", "18446744073709551615", 18446744073709551615n],
    ["data", "[1, 0x10]", [1, 16]],
    ["position", "[1, 2.5, -3]", [1, 2.5, -3]],
    ["name", "12: not yaml", "12: not yaml"],
    ["on", "true", true],
    ["timeout", "1.5", { sec: 1, nsec: 500_000_000 }],
    ["timeout", "now", { sec: 12, nsec: 500_000_000 }],
    [
      "points",
      "[{x: 1}, [4, 5, 6]]",
      [
        { x: 1, y: 0, z: 0 },
        { x: 4, y: 5, z: 6 },
      ],
    ],
  ])("%s: %s", (name, text, expected) => expect(value(name, text)).toEqual(expected));

  test.each([
    ["level", "200", "level must be a whole number from -128 to 127"],
    ["level", "1.5", "level must be a whole number from -128 to 127"],
    ["position", "[1, 2]", "position has 3 elements, not 2"],
    ["data", "3", "data must be a list, as [1, 2]"],
    ["points", "[{w: 1}]", "points[0] has no field w; fields here: x, y, z"],
    ["points", "[[1, 2]]", "points[0] has 3 fields, not 2"],
    ["on", "maybe", "on must be true or false"],
    ["timeout", "soon", "timeout must be seconds, or now"],
    ["position", "[1", /^This is not YAML: /],
  ])("%s: %s is refused", (name, text, sentence) => {
    expect(() => value(name, text)).toThrow(ValueError);
    expect(() => value(name, text)).toThrow(sentence);
  });
});

test("a whole message as rostopic pub takes it", () => {
  const message = messageFromText(type, "{header: {frame_id: map, stamp: now}, points: [[1, 2, 3]]}", NOW);
  expect(message["header"]).toEqual({ seq: 0, stamp: { sec: 12, nsec: 500_000_000 }, frame_id: "map" });
  expect(message["points"]).toEqual([{ x: 1, y: 2, z: 3 }]);
});
