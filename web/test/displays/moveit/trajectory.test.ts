// @vitest-environment jsdom
import { expect, test } from "vitest";

import { ArmModel } from "../../../src/displays/moveit/arm_model";
import { Playback } from "../../../src/displays/moveit/playback";
import { readSrdf } from "../../../src/displays/moveit/srdf";
import { readPace, slowed, waypointsOf } from "../../../src/displays/moveit/trajectory";
import { readUrdf } from "../../../src/displays/robot/urdf";
import { SRDF, URDF } from "./robot";

const model = new ArmModel(readUrdf(URDF), readSrdf(SRDF));
const header = { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "" };

function trajectory(...times: number[]) {
  const points = times.map((time, index) => ({
    positions: Float64Array.of(index),
    velocities: Float64Array.of(2),
    accelerations: Float64Array.of(4),
    effort: new Float64Array(),
    time_from_start: { sec: Math.floor(time), nsec: Math.round((time % 1) * 1e9) },
  }));
  return {
    joint_trajectory: { header, joint_names: ["elbow"], points },
    multi_dof_joint_trajectory: { header, joint_names: [], points: [] },
  };
}

test("waypoints of several trajectories follow each other", () => {
  const path = waypointsOf(model, [trajectory(0, 1), trajectory(0, 0.5)]);
  expect(path.map(({ time }) => time)).toEqual([0, 1, 1, 1.5]);
  expect(path.map(({ positions }) => positions.get("elbow"))).toEqual([0, 1, 0, 1]);
});

test("State Display Time is a factor or a time", () => {
  expect([
    readPace("3x"),
    readPace("REALTIME"),
    readPace("0.05 s"),
    readPace("0.1s"),
    readPace("fast"),
    readPace("0x"),
  ]).toEqual([{ factor: 3 }, { factor: 1 }, { period: 0.05 }, { period: 0.1 }, null, null]);
});

test("a path is shown in its own time, and again where it loops", () => {
  const playback = new Playback();
  const settings = { loop: false, interrupt: false, displayTime: "2x" };
  playback.show(waypointsOf(model, [trajectory(0, 1, 2)]), settings);
  const at = (): number => playback.index.value;
  expect(at()).toBe(0);
  playback.advance(0.4, settings);
  expect(at()).toBe(0);
  playback.advance(0.2, settings);
  expect(at()).toBe(1);
  playback.advance(1, { ...settings, loop: true });
  expect([at(), playback.isPlaying.value]).toEqual([0, true]);
  playback.advance(5, settings);
  expect([at(), playback.isPlaying.value]).toEqual([-1, false]);
});

test("a new path waits for the end of the one that is shown, unless it interrupts", () => {
  const playback = new Playback();
  const settings = { loop: false, interrupt: false, displayTime: "0.1 s" };
  const [first, second] = [waypointsOf(model, [trajectory(0, 1)]), waypointsOf(model, [trajectory(0, 1, 2)])];
  playback.show(first, settings);
  playback.show(second, settings);
  expect(playback.path.value).toBe(first);
  playback.advance(0.25, settings);
  expect(playback.path.value).toBe(second);
  playback.show(first, { ...settings, interrupt: true });
  expect(playback.path.value).toBe(first);
});

test("a person stops at a waypoint, and goes on", () => {
  const playback = new Playback();
  const settings = { loop: true, interrupt: false, displayTime: "1x" };
  playback.show(waypointsOf(model, [trajectory(0, 1, 2)]), settings);
  playback.seek(1);
  playback.advance(5, settings);
  expect(playback.index.value).toBe(1);
  playback.play(true);
  playback.advance(1.1, settings);
  expect(playback.index.value).toBe(0); // past its end
});

test("a slower path takes longer, with lower velocities and accelerations", () => {
  const [, point] = slowed(trajectory(0, 1), 0.5, 1).joint_trajectory.points;
  expect(point?.time_from_start).toEqual({ sec: 2, nsec: 0 });
  expect([point?.velocities[0], point?.accelerations[0]]).toEqual([1, 1]);
  const [, gentle] = slowed(trajectory(0, 1), 1, 0.25).joint_trajectory.points;
  expect(gentle?.time_from_start).toEqual({ sec: 2, nsec: 0 });
});
