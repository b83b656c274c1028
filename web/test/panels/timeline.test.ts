// @vitest-environment jsdom
/** Lanes of the timeline. */

import { describe, expect, it } from "vitest";

import type { Lanes } from "../../src/protocol/generated/page_messages";
import { requestTo } from "../../src/app/dialogs/time_dialog";
import { ContactTimes, touchingPairs } from "../../src/panels/timeline/contact_times";
import { Intervals, united } from "../../src/panels/timeline/intervals";
import { stretchesOf, TopicTimes } from "../../src/panels/timeline/topic_times";
import { TimelineState } from "../../src/panels/timeline/timeline_state";
import { FakeConnection } from "../fake_connection";
import { fakePage } from "../fake_page";

const BAG: Lanes = {
  start_ns: 100e9,
  bucket_ns: 0.5e9,
  topics: {
    "/tf": {
      count: 7,
      bands: [
        [0, 3],
        [10, 10],
      ],
    },
    "/scan": { count: 1, bands: [[2, 2]] },
  },
};

describe("lanes of a bag", () => {
  it("are by topic, in seconds; a stretch ends with its last bucket", () => {
    expect(stretchesOf(BAG)).toEqual([
      { topic: "/scan", count: 1, bands: [[101, 101.5]] },
      {
        topic: "/tf",
        count: 7,
        bands: [
          [100, 102],
          [105, 105.5],
        ],
      },
    ]);
  });

  it("replace observed messages", () => {
    const connection = new FakeConnection();
    const lanes = new TopicTimes(connection);
    connection.advertise("/tf", "tf2_msgs/TFMessage");
    connection.subscribe("/tf", () => undefined);
    connection.receive("/tf", { transforms: [] });
    lanes.look({ start: 0, end: 10, known: 10, isSeekable: true }, 2);
    expect(lanes.all.map(({ topic, count }) => [topic, count])).toEqual([["/tf", null]]);
    connection.receiveRaw("trundle/lanes", new DataView(new TextEncoder().encode(JSON.stringify(BAG)).buffer));
    expect(lanes.all).toEqual(stretchesOf(BAG));
  });
});

describe("topics of a run", () => {
  it("keep received messages in ever longer buckets while the span grows", () => {
    const connection = new FakeConnection();
    const topics = new TopicTimes(connection);
    connection.advertise("/tf", "tf2_msgs/TFMessage");
    connection.subscribe("/tf", () => undefined);
    for (let tick = 0; tick <= 1000; tick += 1) {
      const now = tick / 5;
      if (now < 90 || now > 150) connection.receive("/tf", { transforms: [] });
      topics.look({ start: 0, end: now, known: now, isSeekable: true }, now);
    }
    const [first, second] = topics.all[0]?.bands ?? [];
    expect(topics.all[0]?.bands.length).toBe(2);
    expect(first?.[0]).toBe(0);
    expect(first?.[1]).toBeCloseTo(90, 0);
    expect(second?.[0]).toBeCloseTo(150, 0);
    expect(second?.[1]).toBeGreaterThanOrEqual(200);
  });
});

describe("intervals", () => {
  it("are extended while the activity is on", () => {
    const intervals = new Intervals();
    for (const [isOn, time] of [
      [false, 1],
      [true, 2],
      [true, 3],
      [false, 4],
      [false, 5],
      [true, 6],
    ] as const)
      intervals.note(isOn, time);
    expect(intervals.bands).toEqual([
      [2, 4],
      [6, 6],
    ]);
  });

  it("after a time are dropped when time goes back to it", () => {
    const intervals = new Intervals();
    for (const [isOn, time] of [
      [true, 1],
      [true, 4],
      [false, 5],
      [true, 7],
      [true, 8],
      [false, 3],
    ] as const)
      intervals.note(isOn, time);
    expect(intervals.bands).toEqual([[1, 3]]);
  });
});

it("unites the intervals of many lanes", () => {
  expect(united([])).toEqual([]);
  expect(
    united([
      [5, 6],
      [1, 2],
      [1.5, 3],
      [3, 4],
      [5.2, 5.4],
    ]),
  ).toEqual([
    [1, 4],
    [5, 6],
  ]);
});

describe("the past", () => {
  it("is shown while a simulation is paused before its newest moment", () => {
    const page = fakePage();
    const state = new TimelineState(page);
    const set = (time: number, paused: boolean): void => {
      const clock = { time_ns: time * 1e9, paused, real_time_factor: null, speed: 1, recording: null };
      page.world.state.value = { ...clock, timeline: { start_ns: 0, end_ns: 100e9 } };
    };
    set(21, true);
    expect(state.past()).toBe(79);
    set(21, false);
    expect(state.past()).toBeNull();
    set(100, true);
    expect(state.past()).toBeNull();
  });
});

function contacts(...pairs: readonly (readonly [number, number])[]): DataView {
  const view = new DataView(new ArrayBuffer(16 + 72 * pairs.length));
  view.setUint32(8, 3, true);
  view.setUint32(12, pairs.length, true);
  pairs.flat().forEach((body, i) => view.setFloat64(16 + 72 * (i >> 1) + 8 * (i & 1), body, true));
  return view;
}

describe("contacts", () => {
  const models = new Map([
    [0, "floor"],
    [1, "cart"],
    [2, "cart"],
    [3, "crate"],
  ]);

  it("are of pairs of models, in either order, and not within one", () => {
    expect([...touchingPairs(contacts([1, 0], [0, 2], [3, 2], [1, 2], [-1, 3]), 3, models)]).toEqual([
      "cart · floor",
      "cart · crate",
    ]);
    expect(touchingPairs(contacts([1, 0]), 4, models).size).toBe(0);
    expect(touchingPairs(new DataView(contacts([1, 0], [3, 2]).buffer, 0, 100), 3, models).size).toBe(1);
  });

  it("are recorded with their times, once for each time", () => {
    const lanes = new ContactTimes();
    const floor = new Set(["cart · floor"]);
    for (const [touching, time, known] of [
      [floor, 1, 1],
      [new Set([...floor, "cart · crate"]), 2, 1],
      [floor, 3, 2],
      [new Set(["a · b"]), 1.5, 3],
    ] as const)
      lanes.note(touching, time, known);
    expect(lanes.all).toEqual([
      { pair: "cart · crate", bands: [[2, 3]] },
      { pair: "cart · floor", bands: [[1, 3]] },
    ]);
  });

  it("of many pairs are kept for the latest contacts", () => {
    const lanes = new ContactTimes();
    for (let i = 0; i < 1000; i += 1) lanes.note(new Set([`a · ${i}`, "b · floor"]), i, 0);
    expect(lanes.all.length).toBe(40);
    expect(lanes.all.map(({ pair }) => pair)).toContain("b · floor");
  });

  it("of too many simultaneous pairs are kept for those that began first", () => {
    const lanes = new ContactTimes();
    const pairs = Array.from({ length: 60 }, (_, i) => `crate ${i} · floor`);
    for (let time = 0; time < 10; time += 1) lanes.note(new Set(pairs), time, 0);
    expect(lanes.all.map(({ bands }) => bands)).toEqual(Array.from({ length: 40 }, () => [[0, 9]]));
  });
});

describe("a time to go to", () => {
  const state = { time_ns: 2e9, paused: true, real_time_factor: null, speed: 1 };

  it("is sought if recorded, and otherwise simulated", () => {
    const timeline = { start_ns: 1e9, end_ns: 5e9 };
    expect(requestTo(3.5, { ...state, timeline })).toEqual(["seek", { time_ns: 3.5e9 }]);
    expect(requestTo(6, { ...state, timeline })).toEqual(["run_to", { time_ns: 6e9 }]);
    expect(requestTo(1, state)).toEqual(["run_to", { time_ns: 1e9 }]);
  });
});
