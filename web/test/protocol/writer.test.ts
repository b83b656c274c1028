import { expect, test } from "vitest";

import { readMessage } from "../../src/protocol/reader";
import type { RosMessage } from "../../src/protocol/ros_types";
import { parseSchema } from "../../src/protocol/schema";
import { writeMessage } from "../../src/protocol/writer";

const TEXT = `bool a
int8 b
uint16 c
int32 d
int64 e
uint64 f
float32 g
float64 h
string i
time j
duration k
float32[] l
string[2] m
P[] n
P o
===
MSG: a/P
float64 x
uint8[] data
`;
const schema = parseSchema("a/B", TEXT);

function trip(message: RosMessage): RosMessage {
  const written = writeMessage(schema, message);
  return readMessage(schema, new DataView(written.buffer));
}

test("written messages are read back", () => {
  const message = {
    a: true,
    b: -128,
    c: 65535,
    d: -2147483648,
    e: -(2n ** 63n),
    f: 2n ** 64n - 1n,
    g: 0.5,
    h: Math.PI,
    i: "é".repeat(500),
    j: { sec: 4294967295, nsec: 1 },
    k: { sec: -1, nsec: -5 },
    l: new Float32Array([1, -2]),
    m: ["x", ""],
    n: [{ x: 1, data: new Uint8Array([1, 2]) }],
    o: { x: 2, data: new Uint8Array() },
  };

  expect(trip(message)).toEqual(message);
});

test("absent fields are zero or empty", () => {
  expect(trip({})).toEqual({
    a: false,
    b: 0,
    c: 0,
    d: 0,
    e: 0n,
    f: 0n,
    g: 0,
    h: 0,
    i: "",
    j: { sec: 0, nsec: 0 },
    k: { sec: 0, nsec: 0 },
    l: new Float32Array(),
    m: ["", ""],
    n: [],
    o: { x: 0, data: new Uint8Array() },
  });
});

test.each<[RosMessage, string]>([
  [{ b: 128 }, "a/B.b: 128 does not fit int8"],
  [{ c: -1 }, "a/B.c: -1 does not fit uint16"],
  [{ d: 0.5 }, 'a/B.d is an int32, not "0.5"'],
  [{ i: 5 }, 'a/B.i is a string, not "5"'],
  [{ o: 5 }, 'a/B.o is a/P, not "5"'],
  [{ o: { y: 1 } }, "a/B.o has no field 'y'; fields: x, data"],
  [{ m: ["a"] }, "a/B.m has 2 elements, not 1"],
  [{ n: [{ x: "1" }] }, 'a/B.n[0].x is a number, not "1"'],
  [{ l: "1" }, 'a/B.l is an array, not "1"'],
])("an invalid message is refused: %o", (message, sentence) => {
  expect(() => writeMessage(schema, message)).toThrow(sentence);
});
