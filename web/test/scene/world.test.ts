import "../../src/scene/conventions";

import { BufferGeometry, Group, Quaternion, Vector3 } from "three";
import { describe, expect, test } from "vitest";

import type { Manifest } from "../../src/protocol/generated/page_messages";
import type { DrawnFrames } from "../../src/frames/frame_tree";
import { NoTransform, type Transform } from "../../src/frames/transform";
import { TransformTree } from "../../src/frames/transform_tree";
import { BodyPoses } from "../../src/scene/world/body_poses";
import { readJoints } from "../../src/scene/world/joint_states";
import { WorldPlacement } from "../../src/scene/world/placement";
import { isHidden } from "../../src/scene/world/world_feed";
import { readLines, WorldLines } from "../../src/scene/world/world_lines";

/** A message of `trundle/poses` at an odd offset of its buffer, as frames of the socket have it. */
function poseMessage(time: bigint, generation: number, poses: readonly (readonly [number, ...number[]])[]): DataView {
  const buffer = new ArrayBuffer(13 + 16 + 32 * poses.length);
  const view = new DataView(buffer, 13);
  view.setBigUint64(0, time, true);
  view.setUint32(8, generation, true);
  view.setUint32(12, poses.length, true);
  poses.forEach(([body, ...numbers], i) => {
    view.setUint32(16 + 4 * i, body, true);
    numbers.forEach((number, j) => {
      view.setFloat32(16 + 4 * poses.length + 28 * i + 4 * j, number, true);
    });
  });
  return view;
}

test("poses move only the objects of their bodies", () => {
  const poses = new BodyPoses();
  const [a, b] = [new Group(), new Group()];
  poses.attach(3, a);
  poses.attach(200, b);

  const isTaken = poses.apply(poseMessage(5n, 2, [[200, 1, 2, 3, 0, 0, 1, 0]]), 2);

  expect(isTaken).toBe(true);
  expect(b.position.toArray()).toEqual([1, 2, 3]);
  expect(b.quaternion.toArray()).toEqual([0, 0, 1, 0]);
  expect(a.position.toArray()).toEqual([0, 0, 0]);
  expect(poses.pose(3)).toBeNull();
  expect(poses.pose(200)?.position.z).toBe(3);
});

test("a body that physics hardly moves rests in the picture, and one that creeps does not", () => {
  const poses = new BodyPoses();
  const body = new Group();
  poses.attach(0, body);
  const apply = (time: number, x: number): boolean => {
    poses.apply(poseMessage(BigInt(time), 1, [[0, x, 0, 0, 0, 0, 0, 1]]), 1);
    return poses.takeMoved();
  };
  expect(apply(1, 1)).toBe(true);
  for (let time = 2; time < 20; time += 1) expect(apply(time, 1 + 1e-6 * (time % 3))).toBe(false);
  for (let time = 20; time < 40; time += 1) apply(time, 1 + 3e-5 * (time - 20));
  expect(Math.abs(body.position.x - (1 + 3e-5 * 19))).toBeLessThan(1.1e-4);
  expect(poses.pose(0)?.position.x).toBeCloseTo(1 + 3e-5 * 19, 6);
});

test("a body whose model is loaded after its pose is placed at once", () => {
  const poses = new BodyPoses();
  poses.apply(poseMessage(5n, 1, [[0, 7, 0, 0, 0, 0, 0, 1]]), 1);
  const late = new Group();
  poses.attach(0, late);
  expect(late.position.x).toBe(7);
});

test("poses of another generation and truncated messages change nothing", () => {
  const poses = new BodyPoses();
  const whole = poseMessage(5n, 1, [[0, 7, 0, 0, 0, 0, 0, 1]]);
  expect(poses.apply(whole, 2)).toBe(false);
  expect(poses.apply(new DataView(whole.buffer, 13, 40), 1)).toBe(false);
  expect(poses.apply(new DataView(new ArrayBuffer(3)), 1)).toBe(false);
  expect(poses.pose(0)).toBeNull();
});

test("joints are read in order", () => {
  const view = new DataView(new ArrayBuffer(16 + 48));
  view.setUint32(8, 4, true);
  view.setUint32(12, 2, true);
  [1, 2, 3, 4, 5, 6].forEach((number, i) => {
    view.setFloat64(16 + 8 * i, number, true);
  });
  const joints = readJoints(view, 4);
  expect([0, 1, 2, -1, NaN].map((index) => joints?.at(index))).toEqual([
    { position: 1, velocity: 2, effort: 3 },
    { position: 4, velocity: 5, effort: 6 },
    undefined,
    undefined,
    undefined,
  ]);
  expect(readJoints(view, 5)).toBeNull();
  expect(readJoints(new DataView(view.buffer, 0, 16 + 47), 4)).toBeNull();
});

function lineMessage(
  lines: readonly { readonly id: string; readonly kind: number; readonly points: readonly number[] }[],
): DataView {
  const bytes: number[] = [];
  const u32 = (value: number): void => void bytes.push(...new Uint8Array(new Uint32Array([value]).buffer));
  bytes.push(0, 0, 0, 0, 0, 0, 0, 0);
  u32(lines.length);
  for (const { id, kind, points } of lines) {
    const text = new TextEncoder().encode(id);
    u32(text.length);
    bytes.push(...text, 255, 0, 51, 255);
    u32(kind);
    u32(points.length / 3);
    bytes.push(...new Uint8Array(new Float32Array(points).buffer));
  }
  return new DataView(new Uint8Array(bytes).buffer);
}

test("lines are drawn, changed and dropped by their ids", () => {
  const drawn = new WorldLines();
  const strip = { id: "räder", kind: 0, points: [0, 0, 0, 1, 0, 0, 1, 1, 0] };
  const rays = { id: "scan", kind: 1, points: [0, 0, 0, 5, 0, 0] };

  drawn.show(readLines(lineMessage([strip, rays])) ?? []);
  expect(drawn.children.map(({ type }) => type)).toEqual(["Line", "LineSegments"]);
  drawn.show(readLines(lineMessage([{ ...strip, points: [0, 0, 0, 2, 0, 0] }])) ?? []);

  expect(drawn.children).toHaveLength(1);
  const geometry = (drawn.children[0] as unknown as { geometry: BufferGeometry }).geometry;
  expect(geometry.drawRange.count).toBe(2);
  expect(geometry.getAttribute("position").getX(1)).toBe(2);
  const whole = lineMessage([rays]);
  expect(readLines(new DataView(whole.buffer, 0, whole.byteLength - 4))).toBeNull();
});

test("a link is hidden with its model and those around it", () => {
  expect(isHidden("arm::hand::tip", new Set(["arm"]))).toBe(true);
  expect(isHidden("arm::hand::tip", new Set(["arm::hand"]))).toBe(true);
  expect(isHidden("arm::hand::tip", new Set(["arm::hand::tip"]))).toBe(true);
  expect(isHidden("arm2::tip", new Set(["arm", "tip"]))).toBe(false);
});

function at(x: number, yaw = 0): Transform {
  return { position: new Vector3(x, 0, 0), orientation: new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), yaw) };
}

const MANIFEST = {
  generation: 1,
  robot: 0,
  frames: [{ frame: "base_link", parent: "odom", body: 0 }],
} as unknown as Manifest;

/** The robot drives at 1 m/s from x = 10; odom began there, and tf is 0.1 s late. */
function drivingRobot(poses: BodyPoses, time: bigint): DrawnFrames {
  poses.apply(poseMessage(time, 1, [[0, 10 + Number(time) * 1e-9, 0, 0, 0, 0, 0, 1]]), 1);
  const lookup = (target: string, source: string, query: bigint): Transform | NoTransform =>
    target === "odom" && source === "base_link" && query <= time - 100_000_000n
      ? at(Number(query) * 1e-9)
      : new NoTransform("", "");
  return { lookup } as unknown as DrawnFrames;
}

test("the world stays fixed in odom while the robot drives and tf is late", () => {
  const poses = new BodyPoses();
  const world = new Group();
  let now = 0n;
  const frames: DrawnFrames = {
    lookup: (...query: [string, string, bigint]) => drivingRobot(poses, now).lookup(...query),
  } as unknown as DrawnFrames;
  const placement = new WorldPlacement(world, poses, frames);
  const moved: boolean[] = [];
  for (let i = 0; i <= 20; i += 1) {
    now = BigInt(i) * 50_000_000n;
    drivingRobot(poses, now);
    placement.remember(MANIFEST);
    moved.push(placement.update(MANIFEST, "odom"));
  }
  expect(world.position.x).toBeCloseTo(-10, 4);
  expect(moved.filter(Boolean)).toHaveLength(1);
});

test("in the robot's own frame the world moves around it; in world it stays", () => {
  const poses = new BodyPoses();
  const world = new Group();
  const frames = { lookup: () => new NoTransform("", "") } as unknown as DrawnFrames;
  const placement = new WorldPlacement(world, poses, frames);
  poses.apply(poseMessage(0n, 1, [[0, 4, 0, 0, 0, 0, 0, 1]]), 1);
  placement.remember(MANIFEST);
  placement.update(MANIFEST, "/base_link");
  expect(world.position.x).toBeCloseTo(-4);
  placement.update(MANIFEST, "world");
  expect(world.position.x).toBeCloseTo(0);
});

describe("one time for bodies and frames", () => {
  const MS = 1_000_000n;

  /** A robot that drives at 1 m/s, its poses at 50 ms and 100 ms, tf at the given times [ms]. */
  function driving(times: readonly bigint[]) {
    const poses = new BodyPoses();
    const frames = new TransformTree();
    const placement = new WorldPlacement(new Group(), poses, frames);
    const robot = new Group();
    poses.attach(0, robot);
    for (const time of [50n, 100n]) {
      poses.apply(poseMessage(time * MS, 1, [[0, Number(time) / 1000, 0, 0, 0, 0, 0, 1]]), 1);
      placement.remember(MANIFEST);
    }
    for (const time of times) {
      const header = { seq: 0, stamp: { sec: 0, nsec: Number(time * MS) }, frame_id: "odom" };
      const rotation = { x: 0, y: 0, z: 0, w: 1 };
      const transform = { translation: { x: Number(time) / 1000, y: 0, z: 0 }, rotation };
      frames.add([{ header, child_frame_id: "base_link", transform }], false);
    }
    const frameX = (): number => (frames.lookup("odom", "base_link", 0n) as Transform).position.x;
    return { poses, frames, placement, robot, frameX };
  }

  test("the world is drawn at tf's newest time if its poses are newer", () => {
    const { poses, placement, robot, frameX } = driving([40n, 80n]);

    poses.takeMoved();
    placement.synchronize("odom", false);

    expect(robot.position.x).toBeCloseTo(0.08);
    expect(frameX()).toBeCloseTo(0.08);
    expect(poses.takeMoved()).toBe(true);
    placement.synchronize("odom", false);
    expect(poses.takeMoved()).toBe(false);
  });

  test("frames are drawn at the poses' time if tf is newer", () => {
    const { placement, robot, frameX } = driving([80n, 120n]);

    placement.synchronize("odom", false);

    expect(robot.position.x).toBeCloseTo(0.1);
    expect(frameX()).toBeCloseTo(0.1);
  });

  test("a world that stands still is drawn as it is", () => {
    const { poses, placement, robot, frameX } = driving([40n, 80n]);
    placement.synchronize("odom", false);

    poses.takeMoved();
    placement.synchronize("odom", true);
    expect(poses.takeMoved()).toBe(true);

    expect(robot.position.x).toBeCloseTo(0.1);
    expect(frameX()).toBeCloseTo(0.08);
  });

  test("a world does not wait for a tf that has stopped", () => {
    const { poses, placement, robot } = driving([20n]);
    poses.apply(poseMessage(400n * MS, 1, [[0, 0.4, 0, 0, 0, 0, 0, 1]]), 1);

    placement.synchronize("odom", false);

    expect(robot.position.x).toBeCloseTo(0.4);
  });

  /** Send the robot's pose at the time at which all stands still. */
  function drag(poses: BodyPoses, x: number, y = 0): void {
    poses.apply(poseMessage(100n * MS, 1, [[0, x, y, 0, 0, 0, 0, 1]]), 1);
  }

  test.each(["odom", "base_link"])("frames follow what is moved while time stands still, in %s", (fixedFrame) => {
    const { poses, placement, frames } = driving([100n]);
    const lens = { header: { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "base_link" }, child_frame_id: "lens" };
    const rotation = { x: 0, y: 0, z: 0, w: 1 };
    frames.add([{ ...lens, transform: { translation: { x: 0, y: 0, z: 1 }, rotation } }], true);
    const show = (): void => {
      placement.update(MANIFEST, fixedFrame);
      placement.moveFrames(MANIFEST, fixedFrame, true);
    };
    const positionOf = (target: string, source: string): readonly number[] =>
      (frames.lookup(target, source, 0n) as Transform).position.toArray().map((part) => Number(part.toFixed(4)) + 0);

    show();
    drag(poses, 0.1);
    show();
    expect(positionOf("odom", "base_link")).toEqual([0.1, 0, 0]);
    drag(poses, 7, 2);
    show();
    expect(positionOf("odom", "base_link")).toEqual([7, 2, 0]);
    expect(positionOf("odom", "lens")).toEqual([7, 2, 1]);
    expect(positionOf("base_link", "odom")).toEqual([-7, -2, 0]);
    expect(positionOf("base_link", "lens")).toEqual([0, 0, 1]);
    drag(poses, 0.1);
    show();
    expect(positionOf("odom", "lens")).toEqual([0.1, 0, 1]);
  });

  test("frames are as tf has them once time goes on", () => {
    const { poses, placement, frameX } = driving([100n]);
    drag(poses, 7);
    placement.moveFrames(MANIFEST, "odom", true);
    poses.apply(poseMessage(150n * MS, 1, [[0, 7, 0, 0, 0, 0, 0, 1]]), 1);
    placement.moveFrames(MANIFEST, "odom", false);
    expect(frameX()).toBeCloseTo(0.1);
  });

  test("what is moved while time stands still is drawn at once", () => {
    const { poses, placement, robot } = driving([40n, 80n]);
    poses.apply(poseMessage(100n * MS, 1, [[0, 7, 0, 0, 0, 0, 0, 1]]), 1);

    placement.synchronize("odom", false);

    expect(robot.position.x).toBeCloseTo(7);
  });
});
