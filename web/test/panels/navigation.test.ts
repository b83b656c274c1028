// @vitest-environment jsdom
import { afterEach, expect, test, vi } from "vitest";

import { mapFiles } from "../../src/panels/navigation/map_files";
import { NavigationState } from "../../src/panels/navigation/navigation_state";
import { fakePage } from "../fake_page";

const HERE = { position: { x: 1, y: 2, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
const THERE = { position: { x: 4, y: 6, z: 0 }, orientation: { x: 0, y: 0, z: 1, w: 0 } };

afterEach(() => vi.useRealTimers());

function setUp() {
  const page = fakePage();
  const { connection } = page;
  connection.advertise("/move_base/feedback", "move_base_msgs/MoveBaseActionFeedback");
  const state = new NavigationState(page);
  page.goals.add({ frame: "map", pose: HERE });
  page.goals.add({ frame: "map", pose: THERE });
  const sent = (): string[] =>
    connection.published
      .filter(({ topic }) => topic === "/move_base/goal")
      .map(({ message }) => (message["goal_id"] as { id: string }).id);
  const report = (status: number, text = ""): void => {
    const goal_id = { id: sent().at(-1) ?? "", stamp: { sec: 1, nsec: 0 } };
    connection.receive("/move_base/status", { status_list: [{ goal_id, status, text }] });
  };
  const states = () => page.goals.goals.value.map((goal) => goal.state);
  return { page, connection, state, sent, report, states };
}

test("goals are sent one after the other", () => {
  const { connection, state, sent, report, states } = setUp();
  state.start();
  expect(sent()).toHaveLength(1);
  const { message } = connection.published[0] ?? {};
  expect(message?.["goal"]).toMatchObject({ target_pose: { header: { frame_id: "map" }, pose: HERE } });
  report(1, "");
  expect(states()).toEqual(["driving", "waiting"]);
  report(3);
  expect(sent()).toHaveLength(2);
  expect(new Set(sent()).size).toBe(2);
  report(3);
  expect(states()).toEqual(["reached", "reached"]);
  expect(state.isRunning.value).toBe(false);
});

test("a failed goal ends the tour, with the node's reason", () => {
  const { page, state, report, states, sent } = setUp();
  state.start();
  report(4, "Failed to find a valid plan.");
  expect(states()).toEqual(["failed", "waiting"]);
  expect(page.goals.goals.value[0]?.reason).toBe("Failed to find a valid plan.");
  expect(sent()).toHaveLength(1);
  state.start();
  expect(states()).toEqual(["failed", "sent"]);
});

test("Stop cancels what the robot drives to, and the others wait", () => {
  const { connection, state, report, states } = setUp();
  state.start();
  report(1);
  state.stop();
  expect(connection.published.at(-1)).toMatchObject({ topic: "/move_base/cancel", message: { id: "" } });
  report(2);
  expect(states()).toEqual(["canceled", "waiting"]);
});

test("a goal that the node has forgotten fails", () => {
  vi.useFakeTimers({ toFake: ["performance"] });
  const { connection, state, report, states } = setUp();
  state.start();
  report(1);
  vi.advanceTimersByTime(6000);
  connection.receive("/move_base/status", { status_list: [] });
  expect(states()).toEqual(["failed", "waiting"]);
});

test("a goal of another program is followed, with its distance", () => {
  const { connection, state } = setUp();
  const goal_id = { id: "of a script", stamp: { sec: 9, nsec: 0 } };
  const older = { id: "older", stamp: { sec: 8, nsec: 0 } };
  connection.receive("/move_base/status", {
    status_list: [
      { goal_id, status: 1, text: "" },
      { goal_id: older, status: 3, text: "" },
    ],
  });
  connection.receive("/move_base/current_goal", { header: { frame_id: "map" }, pose: THERE });
  connection.receive("/move_base/feedback", {
    feedback: { base_position: { header: { frame_id: "map" }, pose: HERE } },
  });
  expect(state.status.value?.goal_id.id).toBe("of a script");
  expect(state.distance.value).toBeCloseTo(5);
});

test("without the action there is nothing to send to", () => {
  const page = fakePage();
  const state = new NavigationState(page);
  expect(state.server.value).toBeNull();
  expect(state.mapTopic).toBeNull();
});

test("the map is that of no costmap", () => {
  const { connection, state } = setUp();
  for (const name of ["/move_base/global_costmap/costmap", "/robot/map"])
    connection.advertise(name, "nav_msgs/OccupancyGrid");
  expect(state.mapTopic).toBe("/robot/map");
  connection.advertise("/map", "nav_msgs/OccupancyGrid");
  expect(state.mapTopic).toBe("/map");
});

test("a map's files are map_saver's: the picture begins at the top", async () => {
  const info = {
    map_load_time: { sec: 0, nsec: 0 },
    resolution: 0.05,
    width: 2,
    height: 2,
    origin: { position: { x: -1, y: 2.5, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
  };
  const header = { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "map" };
  const files = mapFiles("map", { header, info, data: Int8Array.of(0, 100, -1, 50) });
  if (typeof files === "string") throw new Error(files);
  const pixels = new Uint8Array(await files.pgm.arrayBuffer());
  expect([...pixels.slice(-4)]).toEqual([205, 205, 254, 0]);
  expect(await files.yaml.text()).toBe(
    "image: map.pgm\nresolution: 0.050000\norigin: [-1.000000, 2.500000, 0.000000]\n" +
      "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
  );
  expect(mapFiles("map", { header, info: { ...info, resolution: NaN }, data: new Int8Array(4) })).toContain("invalid");
});
