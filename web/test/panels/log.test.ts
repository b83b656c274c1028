import { expect, test } from "vitest";

import { entryOf, filtered, LEVELS, type LogFilter } from "../../src/panels/log/log_entries";

const message = (level: number, name: string, msg: string) => ({
  header: { seq: 0, stamp: { sec: 3, nsec: 110_000_000 }, frame_id: "" },
  level,
  name,
  msg,
  file: "drive.cpp",
  function: "main",
  line: 42,
  topics: [],
});
const entries = [
  entryOf(1, message(1, "/drive", "tick")),
  entryOf(2, message(4, "/drive", "slow wheel")),
  entryOf(3, message(16, "/map", "no map")),
];
const all: LogFilter = { levels: new Set(LEVELS), node: "", text: "" };
const ids = (filter: Partial<LogFilter>): number[] => filtered(entries, { ...all, ...filter }).map((entry) => entry.id);

test("an entry has time, level and source", () => {
  expect(entries[1]).toMatchObject({
    time: 3.11,
    level: "Warn",
    node: "/drive",
    file: "drive.cpp",
    line: 42,
    function: "main",
  });
  expect(entries[2]?.level).toBe("Fatal");
});

test("filters by level, node and text", () => {
  expect(ids({})).toEqual([1, 2, 3]);
  expect(ids({ levels: new Set(["Warn", "Fatal"]) })).toEqual([2, 3]);
  expect(ids({ node: "DRIVE" })).toEqual([1, 2]);
  expect(ids({ text: "Map" })).toEqual([3]);
  expect(ids({ text: "/^slow|map$/" })).toEqual([2, 3]);
  expect(ids({ text: "/(/" })).toEqual([]);
});
