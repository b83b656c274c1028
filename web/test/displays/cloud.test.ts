import { Matrix4, Raycaster, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { readCloud, type Cloud } from "../../src/displays/clouds/cloud";
import {
  axisBounds,
  channelBounds,
  choose,
  intensityChannel,
  packedColor,
  range,
  supported,
} from "../../src/displays/clouds/cloud_colors";
import { describePoint } from "../../src/displays/clouds/cloud_look";
import { nearestPoint, pointsWithin } from "../../src/displays/clouds/pick_point";
import type { PointCloud2, PointField } from "../../src/protocol/generated/ros_messages";
import { header } from "./fakes";

const INT8 = 1,
  UINT8 = 2,
  UINT16 = 4,
  UINT32 = 6,
  FLOAT32 = 7,
  FLOAT64 = 8;

function field(name: string, offset: number, datatype = FLOAT32): PointField {
  return { name, offset, datatype, count: 1 };
}
const XYZ = [field("x", 0), field("y", 4), field("z", 8)];

function message(points: readonly number[][], changes: Partial<PointCloud2> = {}): PointCloud2 {
  const data = new Uint8Array(new Float32Array(points.flat()).buffer);
  const step = 4 * (points[0]?.length ?? 3);
  return {
    header: header("map"),
    height: 1,
    width: points.length,
    fields: XYZ,
    is_bigendian: false,
    point_step: step,
    row_step: step * points.length,
    data,
    is_dense: true,
    ...changes,
  };
}

function cloud(read: Cloud | string): Cloud {
  if (typeof read === "string") throw new Error(read);
  return read;
}

function positions(of: Cloud): number[][] {
  const axes = ["x", "y", "z"].map((name) => of.channel(name));
  return Array.from({ length: of.count }, (_, index) =>
    axes.map((axis) => (axis === undefined ? NaN : of.value(axis, index))),
  );
}

describe("a cloud", () => {
  it("is read without a copy where its bytes are aligned", () => {
    const sent = message([
      [1, 2, 3],
      [4, 5, 6],
    ]);
    const read = cloud(readCloud(sent));
    expect(read.words.buffer).toBe(sent.data.buffer);
    expect(positions(read)).toEqual([
      [1, 2, 3],
      [4, 5, 6],
    ]);
  });

  it("is copied where its bytes begin at an odd address", () => {
    const sent = message([[1, 2, 3]]);
    const shifted = new Uint8Array(sent.data.length + 1);
    shifted.set(sent.data, 1);
    expect(positions(cloud(readCloud({ ...sent, data: shifted.subarray(1) })))).toEqual([[1, 2, 3]]);
  });

  it("keeps values of every type when its layout fits no words, of either byte order", () => {
    const fields = [
      ...XYZ,
      field("a", 12, UINT8),
      field("b", 13, UINT16),
      field("c", 15, FLOAT64),
      field("d", 23, UINT32),
    ];
    for (const little of [true, false]) {
      const view = new DataView(new ArrayBuffer(2 * 27));
      for (const at of [0, 27]) {
        [1.5, -2.5, 1e-3].forEach((value, axis) => view.setFloat32(at + 4 * axis, value, little));
        view.setUint8(at + 12, 200);
        view.setUint16(at + 13, 60000, little);
        view.setFloat64(at + 15, 98765.25, little);
        view.setUint32(at + 23, 4000000000, little);
      }
      const data = new Uint8Array(view.buffer);
      const read = cloud(readCloud(message([], { data, width: 2, fields, point_step: 27, is_bigendian: !little })));
      const values = fields.map(({ name }) => read.channels.find((channel) => channel.name === name));
      expect(values.map((channel) => (channel === undefined ? NaN : read.value(channel, 1)))).toEqual([
        1.5,
        -2.5,
        Math.fround(1e-3),
        200,
        60000,
        98765.25,
        4000000000,
      ]);
    }
  });

  it("reads signed integers without their sign, as rviz", () => {
    const sent = message([[0, 0, 0, 0]], { fields: [...XYZ, field("i", 12, INT8)] });
    sent.data[12] = 255;
    const read = cloud(readCloud(sent));
    expect(channelBounds(read, field("i", 12, INT8))).toEqual({ min: 255, max: 255 });
  });

  it.each([
    [
      "width of a thousand millions",
      { width: 1e9 },
      "Data size (12 bytes) does not match width (1000000000) times height (1) times point_step (12).  Dropping message.",
    ],
    [
      "height times width beyond 32 bits",
      { width: 65536, height: 65536, data: new Uint8Array(0) },
      /^Data size \(0 bytes\) does not match/,
    ],
    [
      "points of no bytes",
      { width: 4e9, point_step: 0, data: new Uint8Array(0) },
      "Field x at offset 0 reaches beyond point_step (0).  Dropping message.",
    ],
    [
      "a field outside of the point",
      { fields: [...XYZ, field("i", 12)] },
      "Field i at offset 12 reaches beyond point_step (12).  Dropping message.",
    ],
    [
      "an offset outside of the data",
      { fields: [field("x", 4e9), ...XYZ.slice(1)] },
      /^Field x at offset 4000000000 reaches/,
    ],
    ["no z", { fields: XYZ.slice(0, 2) }, "No position transformer available for cloud"],
    [
      "an x of doubles",
      { fields: [field("x", 0, FLOAT64), ...XYZ.slice(1)] },
      "No position transformer available for cloud",
    ],
    [
      "a datatype that does not exist",
      { fields: [field("x", 0, 77), ...XYZ.slice(1)] },
      "No position transformer available for cloud",
    ],
  ])("with %s is refused", (_name, changes, sentence) => {
    expect(readCloud(message([[1, 2, 3]], changes))).toEqual(
      typeof sentence === "string" ? sentence : expect.stringMatching(sentence),
    );
  });

  it("of no points is valid", () => {
    expect(cloud(readCloud(message([]))).count).toBe(0);
  });
});

describe("color transformers", () => {
  const plain = cloud(readCloud(message([[0, 0, 0]])));
  const colored = cloud(readCloud(message([[0, 0, 0, 0]], { fields: [...XYZ, field("rgb", 12)] })));
  const floats = cloud(
    readCloud(message([[0, 0, 0, 1, 0.5, 0]], { fields: [...XYZ, field("r", 12), field("g", 16), field("b", 20)] })),
  );

  it("are those that rviz offers", () => {
    expect(supported(plain)).toEqual(["AxisColor", "FlatColor", "Intensity"]);
    expect(supported(colored)).toEqual(["AxisColor", "FlatColor", "Intensity", "MONO8", "RGB8"]);
    expect(supported(floats)).toEqual(["AxisColor", "FlatColor", "Intensity", "RGBF32"]);
  });

  it("prefer the saved one, then RGB8, then Intensity", () => {
    expect(choose("FlatColor", supported(colored))).toBe("FlatColor");
    expect(choose("", supported(colored))).toBe("RGB8");
    expect(choose("RGB8", supported(plain))).toBe("Intensity");
  });

  it("ignore packed colors of another type", () => {
    expect(
      packedColor(cloud(readCloud(message([[0, 0, 0, 0]], { fields: [...XYZ, field("rgb", 12, UINT16)] })))),
    ).toBeUndefined();
  });

  it("use the channel intensities for intensity", () => {
    const old = cloud(readCloud(message([[0, 0, 0, 7]], { fields: [...XYZ, field("intensities", 12)] })));
    expect(intensityChannel(old, "intensity")?.name).toBe("intensities");
    expect(intensityChannel(old, "other")).toBeUndefined();
  });
});

describe("bounds", () => {
  const points = [
    [0, 0, 1, 5],
    [1, 0, 2, NaN],
    [0, 1, -3, -2],
    [NaN, 0, 0, Infinity],
    [0, 0, Infinity, 1],
  ];
  const read = cloud(readCloud(message(points, { fields: [...XYZ, field("intensity", 12)] })));

  it("of a channel leave NaN out and stay within rviz's limits", () => {
    expect(channelBounds(read, field("intensity", 12))).toEqual({ min: -2, max: 999999 });
  });

  it("of an axis are in the fixed frame and ignore non-finite points", () => {
    expect(axisBounds(read, 2, new Matrix4())).toEqual({ min: -3, max: 2 });
    expect(axisBounds(read, 2, new Matrix4().makeTranslation(0, 0, 10))).toEqual({ min: 7, max: 12 });
    expect(axisBounds(read, 0, new Matrix4().makeRotationZ(Math.PI / 2)).min).toBeCloseTo(-1);
  });

  it("that are equal have rviz's range", () => {
    expect(range({ min: 3, max: 3 }, 1e20)).toBe(1e20);
    expect(range({ min: 1, max: 3 }, 1e20)).toBe(2);
  });
});

it("a picked point has its fields, numbered as rviz numbers them", () => {
  const sent = message([[1, 2, 3, 0, 9]], { fields: [...XYZ, field("rgb", 12, UINT32), field("intensity", 16)] });
  new DataView(sent.data.buffer).setUint32(12, 0xff102030, true);
  expect(describePoint(cloud(readCloud(sent)), 0)).toEqual({
    Point: 0,
    Position: { x: 1, y: 2, z: 3 },
    "3: rgb": { r: 16, g: 32, b: 48, alpha: 1 },
    "4: intensity": 9,
  });
});

describe("a pointer", () => {
  const read = cloud(
    readCloud(
      message([
        [5, 0, 0],
        [2, 0.02, 0],
        [NaN, 0, 0],
        [3, 1, 0],
        [-1, 0, 0],
      ]),
    ),
  );
  const ray = (to: Vector3): Raycaster => new Raycaster(new Vector3(), to.normalize());

  it("picks the nearest point that it hits", () => {
    expect(nearestPoint(read, 0.05, new Matrix4(), ray(new Vector3(1, 0, 0)))?.index).toBe(1);
  });

  it("picks the point that it passes closest if it hits none", () => {
    expect(nearestPoint(read, 0.001, new Matrix4(), ray(new Vector3(1, 0.001, 0)))?.index).toBe(0);
  });

  it("picks points of a moved cloud", () => {
    const hit = nearestPoint(read, 0.05, new Matrix4().makeTranslation(0, -1, 0), ray(new Vector3(1, 0, 0)));
    expect([hit?.index, hit?.distance]).toEqual([3, 3]);
  });

  it("picks nothing beside the points", () => {
    expect(nearestPoint(read, 0.05, new Matrix4(), ray(new Vector3(0, 0, 1)))).toBeNull();
  });

  it("a box picks points of a moved cloud", () => {
    const right = (point: Vector3): boolean => point.x > 1.5;
    const here = pointsWithin(read, new Matrix4(), right);
    const shifted = pointsWithin(read, new Matrix4().makeTranslation(-100, 0, 0), right);
    expect(here.length).toBeGreaterThan(0);
    expect(here.length).toBeLessThan(read.count);
    expect(shifted).toEqual([]);
  });
});
