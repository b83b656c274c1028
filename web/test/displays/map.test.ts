import { expect, describe, it } from "vitest";

import "../../src/displays/map";
import type { MapDisplay } from "../../src/displays/map";
import { cut, overlap, readMap, tilesOf, writeUpdate, type OccupancyMap } from "../../src/displays/maps/occupancy_map";
import { palette } from "../../src/displays/maps/palette";
import { displayClass } from "../../src/displays/registry";
import type { OccupancyGrid } from "../../src/protocol/generated/ros_messages";
import { fakes, header, status, type Fakes } from "./fakes";

function grid(width: number, height: number, data: readonly number[], resolution = 0.5): OccupancyGrid {
  const origin = { position: { x: -1, y: -2, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
  return {
    header: header("odom"),
    info: { map_load_time: { sec: 0, nsec: 0 }, resolution, width, height, origin },
    data: Int8Array.from(data),
  };
}

function map(read: OccupancyMap | string): OccupancyMap {
  if (typeof read === "string") throw new Error(read);
  return read;
}

/** Color of an occupancy as a person writes it, −128…127. */
function color(scheme: "map" | "costmap" | "raw", value: number): number[] {
  const byte = value & 255;
  return [...palette(scheme).subarray(4 * byte, 4 * byte + 4)];
}

describe("rviz's palette", () => {
  it.each([
    ["map", 0, [255, 255, 255, 255]],
    ["map", 50, [128, 128, 128, 255]],
    ["map", 100, [0, 0, 0, 255]],
    ["map", 33, [171, 171, 171, 255]],
    ["map", -1, [112, 137, 134, 255]],
    ["map", 101, [0, 255, 0, 255]],
    ["map", -128, [255, 0, 0, 255]],
    ["map", -2, [255, 255, 0, 255]],
    ["costmap", 0, [0, 0, 0, 0]],
    ["costmap", 1, [2, 0, 253, 255]],
    ["costmap", 98, [249, 0, 6, 255]],
    ["costmap", 99, [0, 255, 255, 255]],
    ["costmap", 100, [255, 0, 255, 255]],
    ["costmap", -1, [112, 137, 134, 255]],
    ["costmap", 127, [0, 255, 0, 255]],
    ["raw", 0, [0, 0, 0, 255]],
    ["raw", 100, [100, 100, 100, 255]],
    ["raw", -1, [255, 255, 255, 255]],
  ] as const)("%s has for %i the color %j", (scheme, value, rgba) => expect(color(scheme, value)).toEqual(rgba));
});

describe("a map", () => {
  it("is read without a copy", () => {
    const message = grid(2, 2, [0, 100, -1, 50]);
    const read = map(readMap(message));
    expect([...read.cells]).toEqual([0, 100, 255, 50]);
    expect(read.cells.buffer).toBe(message.data.buffer);
  });

  it("of too little data is filled with unknown and named, as in rviz", () => {
    const read = map(readMap(grid(2, 2, [0, 100])));
    expect([...read.cells]).toEqual([0, 100, 255, 255]);
    expect(read.fault).toBe("Data size doesn't match width*height: width = 2, height = 2, data size = 2");
  });

  it.each([
    [
      "of a thousand millions of columns",
      grid(1e9, 1, [0]),
      "Data size doesn't match width*height: width = 1000000000, height = 1, data size = 1",
    ],
    ["of 2^32 squared cells", grid(4294967295, 4294967295, [0]), /^Data size doesn't match/],
    ["of no size", grid(0, 5, []), "Map is zero-sized (0x5)"],
    [
      "whose resolution is no number",
      grid(1, 1, [0], NaN),
      "Message contained invalid floating point values (nans or infs)",
    ],
  ])("%s is refused", (_name, message, sentence) => {
    expect(readMap(message)).toEqual(typeof sentence === "string" ? sentence : expect.stringMatching(sentence));
  });

  it("is drawn in tiles without overlap", () => {
    const wide = {
      width: 10,
      height: 5,
      resolution: 1,
      cells: Uint8Array.from({ length: 50 }, (_, index) => index),
      fault: null,
    };
    const tiles = tilesOf(wide, 4);
    expect(tiles).toHaveLength(6);
    const all = tiles.flatMap((tile) => [...cut(wide, tile)]).sort((a, b) => a - b);
    expect(all).toEqual([...wide.cells]);
    expect(overlap({ x: 0, y: 0, width: 4, height: 4 }, { x: 3, y: 3, width: 9, height: 9 })).toEqual({
      x: 3,
      y: 3,
      width: 1,
      height: 1,
    });
    expect(overlap({ x: 0, y: 0, width: 4, height: 4 }, { x: 4, y: 0, width: 9, height: 9 })).toBeNull();
  });

  it("applies updates within the map, and refuses others", () => {
    const read = map(readMap(grid(3, 3, [0, 0, 0, 0, 0, 0, 0, 0, 0])));
    const update = { header: header("odom"), x: 1, y: 1, width: 2, height: 2, data: Int8Array.of(1, 2, 3, -1) };
    expect(writeUpdate(read, update)).toEqual({ x: 1, y: 1, width: 2, height: 2 });
    expect([...read.cells]).toEqual([0, 0, 0, 0, 1, 2, 0, 3, 255]);
    for (const changes of [{ x: -1 }, { x: 2 }, { height: 4e9 }]) {
      expect(writeUpdate(read, { ...update, ...changes })).toBe("Update area outside of original map area.");
    }
    expect(writeUpdate(read, { ...update, data: new Int8Array(1) })).toBe("Update of 2 x 2 cells has 1 bytes.");
  });
});

function start(): { display: MapDisplay; around: Fakes } {
  const around = fakes();
  around.connection.advertise("/map", "nav_msgs/OccupancyGrid");
  around.connection.advertise("/map_updates", "map_msgs/OccupancyGridUpdate");
  const display = displayClass("rviz/Map")?.create(around.context) as MapDisplay;
  display.topicProperty.value.value = "/map";
  display.start();
  return { display, around };
}

describe("the display", () => {
  it("shows rviz's statuses, and is placed at the map's origin in its frame", () => {
    const { display, around } = start();
    expect(status(display, "Message")).toBe("warn: No map received");
    around.connection.receive("/map", grid(2, 1, [0, 100]));
    expect(status(display, "Transform")).toBe("error: No transform from [odom] to [map]");
    around.frames.set("odom", 10, 0, 0);
    display.update();
    expect([status(display, "Message"), status(display, "Map"), status(display, "Transform")]).toEqual([
      "ok: Map received",
      "ok: Map OK",
      "ok: Transform OK",
    ]);
    expect(display.root.position.toArray()).toEqual([9, -2, 0]);
    const shown = display.properties
      .filter(({ options }) => options.readOnly)
      .map(({ name, value }) => [name, value.value]);
    expect(shown).toEqual([
      ["Resolution", "0.5"],
      ["Width", "2"],
      ["Height", "1"],
      ["Position", "-1; -2; 0"],
      ["Orientation", "0; 0; 0; 1"],
    ]);
  });

  it("does not write updates into a message that others have", () => {
    const { display, around } = start();
    const message = grid(2, 1, [0, 0]);
    around.connection.receive("/map", message);
    around.connection.receive("/map_updates", {
      header: header("odom"),
      x: 0,
      y: 0,
      width: 1,
      height: 1,
      data: Int8Array.of(7),
    });
    expect([...message.data]).toEqual([0, 0]);
    around.connection.receive("/map_updates", {
      header: header("odom"),
      x: 9,
      y: 0,
      width: 1,
      height: 1,
      data: Int8Array.of(7),
    });
    expect(status(display, "Update")).toBe("error: Update area outside of original map area.");
  });

  it("names a message of another type, and saves no values of messages", () => {
    const { display, around } = start();
    around.connection.advertise("/map", "std_msgs/String");
    around.connection.receive("/map", { data: "x" });
    expect(status(display, "Map")).toBe("error: /map is of type std_msgs/String, not nav_msgs/OccupancyGrid");
    expect(Object.keys(display.save()).sort()).toEqual([
      "Alpha",
      "Class",
      "Color Scheme",
      "Draw Behind",
      "Enabled",
      "Name",
      "Topic",
      "Unreliable",
      "Use Timestamp",
      "Value",
    ]);
  });
});
