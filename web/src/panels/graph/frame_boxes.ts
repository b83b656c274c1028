/** Frames of tf as boxes: parent, publisher, rate, age and faults. */

import type { FrameInfo } from "../../frames/frame_tree";
import { age } from "../messages/format";
import type { DrawnArrow, DrawnBox } from "./graph_drawing";

const OLD = 10; // s: tf drops older transforms

/** Boxes and arrows from parents to children; `now` in ROS time [ns]. */
export function frameBoxes(
  frames: readonly FrameInfo[],
  fixedFrame: string,
  now: bigint,
): readonly [readonly DrawnBox[], readonly DrawnArrow[]] {
  const byName = new Map(frames.map((frame) => [frame.name, frame]));
  const root = rootOf(byName, fixedFrame);
  const names = new Set(frames.flatMap((frame) => (frame.parent === null ? [frame.name] : [frame.name, frame.parent])));
  const boxes = [...names].map((name) => {
    const frame = byName.get(name);
    const fault = faultOf(byName, name, names.has(fixedFrame) ? root : null, fixedFrame, now);
    const caption = captionOf(frame, now);
    const publisher = frame?.publisher === null || frame?.publisher === undefined ? "" : `, by ${frame.publisher}`;
    const title = `${name}${frame?.parent ? ` in ${frame.parent}` : ""}: ${caption}${publisher}${fault.text === "" ? "" : `. ${fault.text}`}`;
    return { id: name, name, caption: fault.text === "" ? caption : fault.short, kind: `frame ${fault.kind}`, title };
  });
  const arrows = frames.flatMap(({ name, parent }) =>
    parent === null ? [] : [{ from: parent, to: name, title: `${parent} → ${name}` }],
  );
  return [boxes, arrows];
}

function captionOf(frame: FrameInfo | undefined, now: bigint): string {
  if (frame === undefined || frame.parent === null) return "root";
  if (frame.isStatic) return "static";
  const rate = frame.rate === null ? "" : `${frame.rate.toFixed(1)} Hz · `;
  return `${rate}${age(secondsOld(frame, now))}`;
}

function secondsOld(frame: FrameInfo, now: bigint): number {
  return Number(now - frame.stamp) / 1e9;
}

/** Root ancestor; null if the parents form a loop. */
function rootOf(frames: ReadonlyMap<string, FrameInfo>, name: string): string | null {
  const climbed = new Set<string>();
  let at = name;
  for (;;) {
    if (climbed.has(at)) return null;
    climbed.add(at);
    const parent = frames.get(at)?.parent ?? null;
    if (parent === null) return at;
    at = parent;
  }
}

interface Fault {
  readonly kind: "" | "warn" | "error";
  readonly text: string;
  readonly short: string;
}

function faultOf(
  frames: ReadonlyMap<string, FrameInfo>,
  name: string,
  root: string | null,
  fixedFrame: string,
  now: bigint,
): Fault {
  const frameRoot = rootOf(frames, name);
  if (frameRoot === null) return { kind: "error", text: "Its parents form a loop", short: "loop of parents" };
  const frame = frames.get(name);
  if (frame !== undefined && frame.parent !== null && !frame.isStatic && secondsOld(frame, now) > OLD) {
    const text = age(secondsOld(frame, now));
    return { kind: "warn", text: `Not updated for ${text}`, short: `${text} old` };
  }
  if (root !== null && frameRoot !== root)
    return { kind: "warn", text: `Not connected with ${fixedFrame}`, short: "not connected" };
  return { kind: "", text: "", short: "" };
}
