import { readFileSync } from "node:fs";

import { describe, expect, test, vi } from "vitest";

import { NoTransform, type Transform } from "../../src/frames/transform";
import { TransformTree } from "../../src/frames/transform_tree";
import type { TransformStamped } from "../../src/protocol/generated/ros_messages";

type Triple = [number, number, number];
/** w, x, y, z */
type Wxyz = [number, number, number, number];

interface Lookups {
  readonly transforms: readonly {
    readonly parent: string;
    readonly child: string;
    readonly stamp: string;
    readonly translation: Triple;
    readonly rotation: Wxyz;
    readonly static: boolean;
  }[];
  readonly lookups: readonly ({ readonly target: string; readonly source: string; readonly stamp: string } & (
    | { readonly error: string }
    | { readonly error?: undefined; readonly translation: Triple; readonly rotation: Wxyz }
  ))[];
}

function stamped(
  parent: string,
  child: string,
  stamp: bigint,
  [x, y, z]: Triple = [0, 0, 0],
  [qw, qx, qy, qz]: Wxyz = [1, 0, 0, 0],
): TransformStamped {
  const time = { sec: Number(stamp / 1_000_000_000n), nsec: Number(stamp % 1_000_000_000n) };
  return {
    header: { seq: 0, stamp: time, frame_id: parent },
    child_frame_id: child,
    transform: { translation: { x, y, z }, rotation: { x: qx, y: qy, z: qz, w: qw } },
  };
}

/** Tree of frames that move along x by 1 m/s, one transform per stamp [s]. */
function moving(parent: string, child: string, ...seconds: readonly number[]): TransformTree {
  const tree = new TransformTree();
  for (const s of seconds) tree.add([stamped(parent, child, BigInt(s * 1e9), [s, 0, 0])], false);
  return tree;
}

function x(result: Transform | NoTransform): number | string {
  return result instanceof NoTransform ? `${result.text}: ${result.advice}` : result.position.x;
}

describe("our buffer in Python answers the same", () => {
  const recorded = JSON.parse(readFileSync(new URL("tf_lookups.json", import.meta.url), "utf8")) as Lookups;
  const tree = new TransformTree();
  for (const { parent, child, stamp, translation, rotation, ...one } of recorded.transforms) {
    tree.add([stamped(parent, child, BigInt(stamp), translation, rotation)], one.static);
  }

  test.each(recorded.lookups)("$source in $target at $stamp", (lookup) => {
    const result = tree.lookup(lookup.target, lookup.source, BigInt(lookup.stamp));
    if (lookup.error !== undefined) {
      expect(result).toBeInstanceOf(NoTransform);
      const words = lookup.error === "does not exist" ? "nothing publishes nowhere" : lookup.error;
      expect((result as NoTransform).advice).toContain(words);
      return;
    }
    expect(result).not.toBeInstanceOf(NoTransform);
    const { position, orientation: q } = result as Transform;
    position.toArray().forEach((value, i) => expect(value).toBeCloseTo(lookup.translation[i] ?? NaN, 6));
    const [w, i, j, k] = lookup.rotation;
    const cosine = q.w * w + q.x * i + q.y * j + q.z * k;
    expect(Math.abs(cosine)).toBeCloseTo(1, 6); // q and −q are the same rotation
  });
});

describe("as tf2 does", () => {
  test("a leading slash is ignored, and a frame in itself needs no transform", () => {
    const tree = moving("/map", "/base", 1);
    expect(tree.frames.value).toEqual(["base", "map"]);
    expect(x(tree.lookup("/map", "base", 0n))).toBe(1);
    expect(x(tree.lookup("unknown", "/unknown", 5n))).toBe(0);
  });

  test("time 0 is the newest common one", () => {
    const tree = moving("map", "base", 1, 2, 3);
    tree.add([stamped("map", "other", 2_000_000_000n)], false);
    expect(x(tree.lookup("other", "base", 0n))).toBe(2);
    expect(x(tree.lookup("map", "base", 0n))).toBe(3);
  });

  test("extrapolation is refused, in tf2's words", () => {
    const tree = moving("map", "base", 1, 2.5);
    const end = "when looking up transform from frame [base] to frame [map]";
    expect(x(tree.lookup("map", "base", 2_500_000_001n))).toBe(
      "No transform from [base] to [map]: Lookup would require extrapolation into the future. " +
        `Requested time 2.500000001 but the latest data is at time 2.500000000, ${end}`,
    );
    expect(x(tree.lookup("map", "base", 1n))).toBe(
      "No transform from [base] to [map]: Lookup would require extrapolation into the past. " +
        `Requested time 0.000000001 but the earliest data is at time 1.000000000, ${end}`,
    );
    expect(x(moving("map", "base", 1).lookup("map", "base", 2_000_000_000n))).toContain(
      "Lookup would require extrapolation at time 2.000000000, but only time 1.000000000 is in the buffer",
    );
  });

  test("the cache keeps ten seconds", () => {
    const tree = moving("map", "base", 1, 2, 11.5);
    expect(x(tree.lookup("map", "base", 1_500_000_000n))).toContain("earliest data is at time 2.000000000");
    tree.add([stamped("map", "base", 1_400_000_000n)], false);
    expect(x(tree.lookup("map", "base", 1_500_000_000n))).toContain("earliest data is at time 2.000000000");
  });

  test("transforms may come in any order, and replace one of the same stamp", () => {
    const tree = moving("map", "base", 3, 1, 2, 2);
    tree.add([stamped("map", "base", 2_000_000_000n, [7, 0, 0])], false);
    expect([1.5, 2, 2.5].map((s) => x(tree.lookup("map", "base", BigInt(s * 1e9))))).toEqual([4, 7, 5]);
  });

  test("between stamps of two parents, the earlier parent is used", () => {
    const tree = moving("map", "base", 1);
    tree.add([stamped("odom", "base", 3_000_000_000n, [5, 0, 0]), stamped("map", "odom", 0n)], false);
    expect(x(tree.lookup("odom", "base", 3_000_000_000n))).toBe(5);
    expect(x(tree.lookup("odom", "base", 2_000_000_000n))).toContain("At that time 'map' had no parent");
  });

  test("static transforms are valid at any time, and survive a jump back in time", () => {
    const tree = moving("map", "base", 1);
    tree.add([stamped("base", "laser", 99n, [0.5, 0, 0])], true);
    expect(x(tree.lookup("base", "laser", 123n))).toBe(0.5);
    expect(x(tree.lookup("map", "laser", 0n))).toBe(1.5);
    tree.clearMoving();
    expect(tree.frames.value).toEqual(["base", "laser"]);
    expect(x(tree.lookup("laser", "base", 0n))).toBe(-0.5);
  });
});

describe("errors", () => {
  test("the error of an unknown frame names it and the known frames", () => {
    expect(x(moving("map", "base", 1).lookup("map", "laser", 0n))).toBe(
      "No transform from [laser] to [map]: nothing publishes laser. Frames here: base, map",
    );
    expect(x(new TransformTree().lookup("map", "laser", 0n))).toBe(
      "No transform from [laser] to [map]: nothing publishes laser, nor any other transform",
    );
    const many = new TransformTree();
    many.add(
      [...Array(20).keys()].map((i) => stamped("a", `b${String(i).padStart(2, "0")}`, 1n)),
      true,
    );
    expect(x(many.lookup("a", "c", 0n))).toContain(
      "Frames here: a, b00, b01, b02, b03, b04, b05, b06, b07, b08, b09, b10 and 9 more",
    );
  });

  test("a loop is refused", () => {
    const tree = new TransformTree();
    tree.add([stamped("a", "b", 1n), stamped("b", "c", 1n), stamped("c", "a", 1n), stamped("c", "d", 1n)], false);
    expect(x(tree.lookup("a", "d", 0n))).toContain("The tf tree is invalid because it contains a loop");
  });

  test("invalid transforms are dropped", () => {
    const tree = moving("map", "base", 1);
    tree.add(
      [
        stamped("map", "map", 1n),
        stamped("", "a", 1n),
        stamped("map", "/", 1n),
        stamped("map", "a", 1n, [NaN, 0, 0]),
        stamped("map", "a", 1n, [0, 0, 0], [Infinity, 0, 0, 0]),
      ],
      false,
    );
    expect(tree.frames.value).toEqual(["base", "map"]);
  });

  test("an all-zero rotation is the identity, and others are normalized", () => {
    const tree = new TransformTree();
    tree.add([stamped("map", "a", 1n, [1, 0, 0], [0, 0, 0, 0]), stamped("a", "b", 1n, [1, 0, 0], [2, 0, 0, 0])], true);
    expect(x(tree.lookup("map", "b", 0n))).toBe(2);
    expect((tree.lookup("map", "b", 0n) as Transform).orientation.toArray()).toEqual([0, 0, 0, 1]);
  });

  test("the numbers of frames and of transforms per frame are bounded", () => {
    const tree = new TransformTree();
    tree.add(
      [...Array(10_050).keys()].map((i) => stamped("map", `a${String(i)}`, 1n)),
      false,
    );
    expect(tree.frames.value).toHaveLength(10_000);

    const fast = new TransformTree();
    for (let i = 1; i <= 10_001; i++) fast.add([stamped("map", "base", BigInt(i))], false);
    expect(x(fast.lookup("map", "base", 1n))).toContain("earliest data is at time 0.000000002");
  });
});

test("the frames' list changes only when a frame appears", () => {
  const tree = moving("map", "base", 1);
  const { value } = tree.frames;
  tree.add([stamped("map", "base", 2_000_000_000n)], false);
  expect(tree.frames.value).toBe(value);
});

test("describes frames with parents, stamps and rates", () => {
  vi.useFakeTimers({ toFake: ["performance"] });
  const tree = moving("map", "base", 1);
  tree.add([stamped("base", "laser", 5n)], true);
  const bare = { parent: null, isStatic: false, stamp: 0n, rate: null, publisher: null };
  expect(tree.describe()).toEqual([
    { ...bare, name: "base", parent: "map", stamp: 1_000_000_000n },
    { ...bare, name: "laser", parent: "base", isStatic: true },
    { ...bare, name: "map" },
  ]);
  vi.advanceTimersByTime(500);
  tree.add([stamped("map", "base", 2_000_000_000n)], false);
  expect(tree.describe()[0]).toMatchObject({ stamp: 2_000_000_000n, rate: 2 });
  vi.useRealTimers();
});

test("the frames' list changes when a root gets a parent", () => {
  const tree = new TransformTree();
  tree.add([stamped("base", "laser", 0n), stamped("map", "odom", 0n)], true);
  let changes = -1; // the first is at once
  tree.frames.subscribe(() => (changes += 1));
  tree.add([stamped("odom", "base", 1n)], false);
  tree.add([stamped("odom", "base", 2n)], false);
  expect(changes).toBe(1);
});
