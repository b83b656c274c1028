/** Lanes of the timeline. */

import { describe, expect, it } from "vitest";

import { requestTo } from "../../src/app/dialogs/time_dialog";
import { Lanes, lanesOf, type BagLanes } from "../../src/panels/timeline/lanes";
import { Spells } from "../../src/panels/timeline/spells";
import { FakeConnection } from "../fake_connection";

const BAG: BagLanes = {
  start_ns: 100e9,
  bucket_ns: 0.5e9,
  topics: { "/tf": { count: 7, bands: [[0, 3], [10, 10]] }, "/scan": { count: 1, bands: [[2, 2]] } },
};

describe("lanes of a bag", () => {
  it("are by topic, in seconds; a stretch ends with its last bucket", () => {
    expect(lanesOf(BAG)).toEqual([
      { topic: "/scan", count: 1, bands: [[101, 101.5]] },
      { topic: "/tf", count: 7, bands: [[100, 102], [105, 105.5]] },
    ]);
  });

  it("take the place of what was seen to come", () => {
    const connection = new FakeConnection();
    const lanes = new Lanes(connection);
    connection.advertise("/tf", "tf2_msgs/TFMessage");
    connection.subscribe("/tf", () => undefined);
    connection.receive("/tf", { transforms: [] });
    lanes.look({ start: 0, end: 10, known: 10, isSeekable: true }, 2);
    expect(lanes.all.map(({ topic, count }) => [topic, count])).toEqual([["/tf", null]]);
    connection.receiveRaw("trundle/lanes", new DataView(new TextEncoder().encode(JSON.stringify(BAG)).buffer));
    expect(lanes.all).toEqual(lanesOf(BAG));
  });
});

describe("spells", () => {
  it("go on while they are noted", () => {
    const spells = new Spells();
    for (const [isOn, time] of [[false, 1], [true, 2], [true, 3], [false, 4], [false, 5], [true, 6]] as const) spells.note(isOn, time);
    expect(spells.bands).toEqual([[2, 4], [6, 6]]);
  });

  it("after a time are forgotten when it begins again there", () => {
    const spells = new Spells();
    for (const [isOn, time] of [[true, 1], [true, 4], [false, 5], [true, 7], [true, 8], [false, 3]] as const) spells.note(isOn, time);
    expect(spells.bands).toEqual([[1, 3]]);
  });
});

describe("a time to go to", () => {
  const state = { time_ns: 2e9, paused: true, real_time_factor: null, speed: 1 };

  it("is sought where it is kept, and else simulated", () => {
    const timeline = { start_ns: 1e9, end_ns: 5e9 };
    expect(requestTo(3.5, { ...state, timeline })).toEqual(["seek", { time_ns: 3.5e9 }]);
    expect(requestTo(6, { ...state, timeline })).toEqual(["run_to", { time_ns: 6e9 }]);
    expect(requestTo(1, state)).toEqual(["run_to", { time_ns: 1e9 }]);
  });
});
