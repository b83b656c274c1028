import { describe, expect, test } from "vitest";

import { readMessage } from "../../src/protocol/reader";
import { parseSchema } from "../../src/protocol/schema";

function bytes(hex: string, offset = 0): DataView {
  const values = hex.replaceAll(/\s/g, "").match(/../g) ?? [];
  const buffer = new Uint8Array([...Array<number>(offset).fill(0xee), ...values.map((pair) => parseInt(pair, 16))]);
  return new DataView(buffer.buffer, offset);
}

const HEADER = `Header header
uint8 kind
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
`;

describe("reading", () => {
  test("reads every primitive, little-endian", () => {
    const schema = parseSchema(
      "a/All",
      "bool a\nint8 b\nuint8 c\nint16 d\nuint16 e\nint32 f\nuint32 g\nint64 h\nuint64 i\nfloat32 j\nfloat64 k\n" +
        "string l\ntime m\nduration n\nbyte o\nchar p\nint32 CONSTANT=7\n",
    );
    const payload = bytes(
      "01 ff ff feff feff fdffffff fdffffff fcffffffffffffff fcffffffffffffff 0000c03f 000000000000f83f" +
        "03000000 c3a978 02000000 01000000 feffffff ffffffff ff ff",
    );

    expect(readMessage(schema, payload)).toEqual({
      a: true,
      b: -1,
      c: 255,
      d: -2,
      e: 65534,
      f: -3,
      g: 4294967293,
      h: -4n,
      i: 18446744073709551612n,
      j: 1.5,
      k: 1.5,
      l: "éx",
      m: { sec: 2, nsec: 1 },
      n: { sec: -2, nsec: -1 },
      o: -1,
      p: 255,
    });
  });

  test("reads nested messages and arrays of them", () => {
    const schema = parseSchema("a/Poly", "Point[] points\nPoint[1] one\n===\nMSG: a/Point\nint8 x\n");

    expect(readMessage(schema, bytes("02000000 01 02 03"))).toEqual({ points: [{ x: 1 }, { x: 2 }], one: [{ x: 3 }] });
  });

  test("a Header is std_msgs/Header, and a bare name is in the same package", () => {
    const schema = parseSchema("a/B", `${HEADER}===\nMSG: b/C\nint8 x\n`);

    expect(readMessage(schema, bytes("05000000 0100000002000000 01000000 61 07"))).toEqual({
      header: { seq: 5, stamp: { sec: 1, nsec: 2 }, frame_id: "a" },
      kind: 7,
    });
    const two = "Point p\n===\nMSG: geometry_msgs/Point\nfloat64 x\n===\nMSG: a/Point\nint8 x\n";
    expect(readMessage(parseSchema("a/B", two), bytes("09"))).toEqual({ p: { x: 9 } });
  });

  test("numeric arrays are views of the payload where aligned, else copies", () => {
    const schema = parseSchema("a/B", "uint8[] data\nfloat32[1] one\n");
    const aligned = bytes("04000000 01020304 0000c03f");
    const skewed = bytes("04000000 01020304 0000c03f", 13);
    const buffers = new Set<ArrayBuffer>();

    const message = readMessage(schema, aligned, buffers) as { data: Uint8Array; one: Float32Array };
    expect(message.data.buffer).toBe(aligned.buffer);
    expect(message.one.buffer).toBe(aligned.buffer);
    expect([...buffers]).toEqual([aligned.buffer]);

    const copied = readMessage(schema, skewed, buffers) as { data: Uint8Array; one: Float32Array };
    expect([...copied.data]).toEqual([1, 2, 3, 4]);
    expect([...copied.one]).toEqual([1.5]);
    expect(copied.one.buffer).not.toBe(skewed.buffer);
    expect(buffers.size).toBe(3);
  });

  test("names of Object.prototype are ordinary fields", () => {
    const schema = parseSchema("a/B", "int8 constructor\nint8 hasOwnProperty\nint8 toString\nint8 valueOf\n");
    const message = readMessage(schema, bytes("01020304"));

    expect(Object.entries(message)).toEqual([
      ["constructor", 1],
      ["hasOwnProperty", 2],
      ["toString", 3],
      ["valueOf", 4],
    ]);
  });

  test("a definition with the field __proto__ is refused", () => {
    expect(() => parseSchema("a/B", "int8 __proto__\n")).toThrow(
      "the definition of a/B cannot be read: Could not parse line: 'int8 __proto__'",
    );
    expect(({} as Record<string, unknown>)["polluted"]).toBeUndefined();
  });

  test("strings of any length are UTF-8", () => {
    const schema = parseSchema("a/B", "string s\n");
    for (const text of ["", "plain", "é", "x".repeat(47), "x".repeat(48), "日本語".repeat(40)]) {
      const utf8 = new TextEncoder().encode(text);
      const payload = new Uint8Array(4 + utf8.length);
      new DataView(payload.buffer).setUint32(0, utf8.length, true);
      payload.set(utf8, 4);
      expect(readMessage(schema, new DataView(payload.buffer))).toEqual({ s: text });
    }
  });
});

describe("hostile messages", () => {
  test.each([
    ["float64[] x", "ffffffff", "a/B: the field 'x' takes 34359738360 bytes, and the message has 0 more"],
    ["string x", "ffffff7f 61", "a/B: the field 'x' takes 2147483647 bytes, and the message has 1 more"],
    ["string[] x", "10000000 00000000", "a/B: the field 'x' takes 64 bytes, and the message has 4 more"],
    ["float64[1000000000] x", "00", "a/B: the field 'x' takes 8000000000 bytes, and the message has 1 more"],
    ["uint32 x", "0000", "a/B: the field 'x' takes 4 bytes, and the message has 2 more"],
  ])("%s", (definition, payload, sentence) => {
    expect(() => readMessage(parseSchema("a/B", definition), bytes(payload))).toThrow(sentence);
  });

  test("arrays of empty messages cannot grow without bytes", () => {
    const empty = "Empty[] x\n===\nMSG: a/Empty\n";
    expect(() => readMessage(parseSchema("a/B", empty), bytes("ffffffff"))).toThrow(
      "a/Empty: more values than a message of this size has",
    );
    expect(readMessage(parseSchema("a/B", empty), bytes("02000000"))).toEqual({ x: [{}, {}] });
  });

  test("a definition that doubles forty times is read in bounded time", () => {
    const types = Array.from({ length: 40 }, (_, i) => `===\nMSG: a/T${String(i)}\nT${String(i + 1)}[2] x\n`);
    const schema = parseSchema("a/B", `T0 x\n${types.join("")}===\nMSG: a/T40\n`);

    expect(() => readMessage(schema, bytes("00"))).toThrow("more values than a message of this size has");
  });

  test("recursive and missing types are refused", () => {
    expect(() => parseSchema("a/B", "C c\n===\nMSG: a/C\nB[] b\n===\nMSG: a/B\nC c\n")).toThrow("a/B contains itself");
    expect(() => parseSchema("a/B", "c/D d\n")).toThrow("the definition of a/B lacks that of c/D");
  });
});
