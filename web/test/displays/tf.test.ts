import { Matrix4, Vector3, type InstancedMesh } from "three";
import { describe, expect, it } from "vitest";

import { Tf } from "../../src/displays/tf";
import { fadeOf, TreeProperty } from "../../src/displays/tf/frame_row";
import { setup, type Setup } from "./support";

function started(properties: Record<string, unknown> = {}): Setup & { tf: Tf; parts: () => InstancedMesh[] } {
  const base = setup();
  const tf = new Tf(base.context);
  tf.load(properties as never);
  tf.start();
  const parts = (): InstancedMesh[] => tf.root.children[0]?.children as InstancedMesh[];
  return { ...base, tf, parts };
}

function matrixAt(mesh: InstancedMesh | undefined, index: number): Matrix4 {
  const matrix = new Matrix4();
  mesh?.getMatrixAt(index, matrix);
  return matrix;
}

describe("TF", () => {
  it("draws three axes of 0.2 m per frame, scaled, and an arrow from child to parent", () => {
    const { tf, frames, parts } = started({ "Marker Scale": 2 });
    frames.set("base", "map", [1, 0, 0]);
    tf.update(1n, 1);
    const [x, y, z, shafts, heads] = parts();
    expect([x?.count, y?.count, z?.count, shafts?.count, heads?.count]).toEqual([2, 2, 2, 1, 1]);
    const tip = new Vector3(1, 0, 0).applyMatrix4(matrixAt(z, 1));
    expect(tip.toArray().map((part) => Number(part.toFixed(6)))).toEqual([1, 0, 0.4]);
    const arrow = matrixAt(heads, 0);
    const [base, point] = [new Vector3().applyMatrix4(arrow), new Vector3(1, 0, 0).applyMatrix4(arrow)];
    expect(base.x).toBeCloseTo(0.2);
    expect(point.length()).toBeCloseTo(0);
  });

  it("labels frames, and removes labels with their frames", () => {
    const { tf, frames, scene } = started();
    frames.set("base", "map", [1, 0, 0]);
    tf.update(1n, 1);
    expect(scene.labels.map((label) => label.text)).toEqual(["map", "base"]);
    frames.forget("base");
    tf.update(2n, 1);
    expect(scene.labels.map((label) => label.text)).toEqual(["map"]);
    tf.names.value.value = false;
    tf.update(3n, 1);
    expect(scene.labels.map((label) => label.isQuiet)).toEqual([true]); // its name shows while it is pointed at
  });

  it("names frames without their robot's prefix, and those near the root first", () => {
    const { tf, frames, scene } = started();
    frames.set("rp2w/base", "map");
    frames.set("rp2w/camera", "rp2w/base");
    tf.update(1n, 1);
    expect(scene.labels.map(({ text, full, rank }) => [text, full, rank])).toEqual([
      ["map", "map", 0],
      ["base", "rp2w/base", 1],
      ["camera", "rp2w/camera", 2],
    ]);
  });

  it("hides frames that are switched off, as the file or a person says", () => {
    const { tf, frames, parts } = started({ Frames: { "All Enabled": false, base: { Value: false } } });
    frames.set("base", "map", [1, 0, 0]);
    tf.update(1n, 1);
    expect(parts()[0]?.count).toBe(1); // the file does not say that map is off, and rviz shows it
    tf.allFrames.value.value = true;
    tf.update(2n, 1);
    expect(parts()[0]?.count).toBe(2);
    tf.allFrames.value.value = false;
    tf.update(3n, 1);
    expect(parts()[0]?.count).toBe(0);
  });

  it("shows frames that match the whitelist and not the blacklist", () => {
    const { tf, frames, parts } = started({ "Filter (whitelist)": "wheel|base", "Filter (blacklist)": "^left" });
    for (const name of ["base", "left_wheel", "right_wheel"]) frames.set(name, "map", [1, 0, 0]);
    tf.update(1n, 1);
    expect(parts()[0]?.count).toBe(2);
  });

  it("reports frames without a transform, in rviz's words", () => {
    const { tf, frames } = started();
    frames.set("alone", null);
    frames.lookup = (() => {
      const lookup = frames.lookup.bind(frames);
      return (target: string, source: string) => lookup(target, source === "alone" ? "nowhere" : source);
    })();
    tf.update(1n, 1);
    expect(tf.statuses.value.get("alone")).toMatchObject({
      level: "warn",
      text: "No transform from [alone] to frame [map]",
    });
  });

  it("removes a frame that is no longer published after the timeout", () => {
    const { tf, frames, parts } = started({ "Frame Timeout": 3 });
    frames.set("base", "map", [1, 0, 0], { stamp: 5n });
    tf.update(1_000_000_000n, 1);
    expect(parts()[0]?.count).toBe(2);
    tf.update(3_500_000_000n, 1);
    expect(parts()[0]?.count).toBe(2);
    tf.update(4_500_000_000n, 1);
    expect(parts()[0]?.count).toBe(1); // the root, which is static
    frames.set("base", "map", [1, 0, 0], { stamp: 6n });
    tf.update(4_600_000_000n, 1);
    expect(parts()[0]?.count).toBe(2);
  });

  it("describes the frame of a picked axis", () => {
    const { tf, frames } = started();
    frames.set("base", "map", [1, 0, 0]);
    tf.update(1n, 1);
    const selectable = tf.root.children[0]?.userData["selectable"] as {
      describe(index: number): Record<string, unknown>;
    };
    expect(selectable.describe(1)).toMatchObject({ Frame: "base", Parent: "map" });
  });

  it("nests the tree by parents", () => {
    const tree = new TreeProperty("Tree");
    tree.draw(
      new Map([
        ["base", "odom"],
        ["odom", "map"],
        ["map", null],
      ]),
    );
    expect(tree.children.map((child) => child.name)).toEqual(["map"]);
    expect(tree.children[0]?.children[0]?.children[0]?.name).toBe("base");
  });

  it("draws nothing while nothing moves", () => {
    const { tf, scene, frames } = started();
    frames.set("base", "map", [1, 0, 0]);
    tf.update(1n, 1);
    tf.update(2n, 0.01); // the rows of the new frames
    const drawn = scene.frames;
    tf.update(3n, 1);
    expect(scene.frames).toBe(drawn);
    frames.set("base", "map", [2, 0, 0]);
    tf.update(4n, 0.01);
    expect(scene.frames).toBe(drawn + 1);
  });
});

describe("the fading of a frame", () => {
  it("begins after a third of the timeout, is grey after two, and ends with it", () => {
    expect(fadeOf(4, 15)).toEqual({ grey: 0, alpha: 1 });
    expect(fadeOf(7.5, 15)).toEqual({ grey: 0.5, alpha: 1 });
    expect(fadeOf(12.5, 15)).toEqual({ grey: 1, alpha: 0.5 });
    expect(fadeOf(15, 15).alpha).toBe(0);
  });
});
