/** Default fixed frame, in which the robot moves, found in the tree of frames. */

import type { FrameInfo } from "../frames/frame_tree";

/** Frames that stand still, as REP 105 names them; a frame above `map` may be far away, as utm is. */
const STILL = ["map", "odom", "world"] as const;

/** Default fixed frame: `map`, `odom` or `world` of the largest tree, otherwise its root. */
export function workOutFixedFrame(frames: readonly FrameInfo[]): string {
  const parents = new Map(frames.map((frame) => [frame.name, frame.parent]));
  const trees = new Map<string, string[]>();
  for (const { name } of frames) {
    const root = rootOf(name, parents);
    const members = trees.get(root) ?? [root];
    if (name !== root) members.push(name);
    trees.set(root, members);
  }
  let best: readonly [string, readonly string[]] = ["map", []];
  for (const tree of trees) if (tree[1].length > best[1].length) best = tree;
  return STILL.find((frame) => best[1].includes(frame)) ?? best[0];
}

function rootOf(name: string, parents: ReadonlyMap<string, string | null>): string {
  let frame = name;
  for (let steps = 0; steps <= parents.size; steps++) {
    const parent = parents.get(frame);
    if (parent === undefined || parent === null) return frame;
    frame = parent;
  }
  return name; // a loop, which tf refuses
}
