import { expect, test } from "vitest";

import { feedTransforms } from "../../src/frames/tf_topics";
import { TransformTree } from "../../src/frames/transform_tree";
import { FakeConnection } from "../fake_connection";

function message(child: string, sec: number) {
  const transform = { translation: { x: 0, y: 0, z: 0 }, rotation: { x: 0, y: 0, z: 0, w: 1 } };
  return {
    transforms: [{ header: { seq: 0, stamp: { sec, nsec: 0 }, frame_id: "map" }, child_frame_id: child, transform }],
  };
}

function fed() {
  const connection = new FakeConnection();
  const tree = new TransformTree();
  const subscription = feedTransforms(tree, connection);
  connection.time = 50_000_000_000n;
  connection.receive("/tf", message("base", 50));
  connection.receive("/tf_static", message("laser", 0));
  return { connection, tree, subscription };
}

test("transforms are read from both topics until the subscription is closed", () => {
  const { connection, tree, subscription } = fed();
  expect(tree.frames.value).toEqual(["base", "laser", "map"]);
  subscription.close();
  expect(connection.subscriptions("/tf") + connection.subscriptions("/tf_static")).toBe(0);
});

test("moving transforms are forgotten when time goes back", () => {
  const { connection, tree } = fed();
  connection.time = 49_950_000_000n; // a clock that is corrected
  connection.receive("/tf", message("other", 49));
  expect(tree.frames.value).toEqual(["base", "laser", "map", "other"]);
  connection.time = 1_000_000_000n;
  connection.receive("/tf", message("other", 1));
  expect(tree.frames.value).toEqual(["laser", "map", "other"]);
});

test("a transform from before a jump back, decoded after it, is dropped", () => {
  const { connection, tree } = fed();
  connection.time = 1_000_000_000n; // the clock is back
  connection.receive("/tf", message("late", 51), { time: 51_000_000_000n });
  connection.receive("/tf", message("base", 1), { time: 1_000_000_000n });
  connection.receive("/tf_static", message("laser", 0), { time: 0n });
  connection.receive("/tf", message("base", 2), { time: 2_000_000_000n });
  expect(tree.frames.value).toEqual(["base", "laser", "map"]);
  expect(tree.lookup("map", "base", 1_500_000_000n)).toMatchObject({ position: { x: 0 } });
});

test("all transforms are forgotten in a new connection", () => {
  const { connection, tree } = fed();
  connection.state.value = { kind: "lost", retryInSeconds: 1 };
  expect(tree.frames.value).toHaveLength(3);
  connection.state.value = { kind: "connected" };
  expect(tree.frames.value).toEqual([]);
});
