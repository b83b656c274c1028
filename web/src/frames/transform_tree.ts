/** Buffer of transforms that behaves as tf2's. */

import { signal } from "@preact/signals";
import { Quaternion, Vector3 } from "three";

import type { TransformStamped } from "../protocol/generated/ros_messages";
import { nanoseconds } from "../protocol/ros_types";
import type { DrawnFrames, FrameInfo, MovedFrames } from "./frame_tree";
import { NoTransform, type Transform } from "./transform";
import { TransformHistory, type Sample } from "./transform_history";

/** Ancestors that a frame may have, to find loops; tf2's number. */
const MAX_ANCESTORS = 1000;
/** Bounds the memory that a publisher of ever new names can use. */
const MAX_FRAMES = 10_000;
/** Largest number of frames that an advice lists. */
const MAX_NAMES = 12;

const LOOP = "The tf tree is invalid because it contains a loop";

/** Largest time before the newest pose at which a frame is drawn [ns]: an older time belongs to another run. */
const MAX_PAST = 1_000_000_000n;

export class TransformTree implements DrawnFrames {
  drawnAt: bigint | null = null;
  moved: MovedFrames | null = null;
  readonly frames = signal<readonly string[]>([]);
  readonly #moving = new Map<string, TransformHistory>();
  readonly #static = new Map<string, Sample>();
  /** All frames, including those that are only parents. */
  readonly #names = new Set<string>();

  /** Add transforms; those that tf2 refuses are dropped: NaNs, frames that are their own parents or without a name. */
  add(transforms: readonly TransformStamped[], isStatic: boolean): void {
    let isOther = false;
    for (const { header, child_frame_id, transform } of transforms) {
      const child = bareName(child_frame_id);
      const sample = sampleOf(nanoseconds(header.stamp), bareName(header.frame_id), transform);
      if (sample === null || child === "" || child === sample.parent) continue;
      if (!this.#enter(child) || !this.#enter(sample.parent)) continue;
      isOther ||= this.#parent(child) !== sample.parent;
      this.#set(child, sample, isStatic);
    }
    if (isOther) this.frames.value = [...this.#names].sort();
  }

  /** Forget all but static transforms, as when time goes back: static ones are sent only once. */
  clearMoving(): void {
    this.#moving.clear();
    this.#names.clear();
    for (const [child, { parent }] of this.#static) this.#names.add(child).add(parent);
    this.frames.value = [...this.#names].sort();
  }

  /** Forget all. */
  clear(): void {
    this.#static.clear();
    this.clearMoving();
  }

  describe(): readonly FrameInfo[] {
    const now = performance.now();
    return this.frames.peek().map((name) => {
      const moving = this.#moving.get(name);
      return {
        name,
        parent: this.#parent(name),
        isStatic: this.#static.has(name),
        stamp: moving?.newest.stamp ?? 0n,
        rate: moving?.arrivals.at(now).rate ?? null,
        publisher: null,
      };
    });
  }

  lookup(target: string, source: string, time: bigint): Transform | NoTransform {
    const [to, from] = [bareName(target), bareName(source)];
    if (to === from) return { position: new Vector3(), orientation: new Quaternion() };
    const found = this.#find(to, from, time);
    const result = typeof found === "string" || time !== 0n ? found : this.#asMoved(to, from, found);
    return typeof result === "string" ? new NoTransform(`No transform from [${from}] to [${to}]`, result) : result;
  }

  newestTime(target: string, source: string): bigint {
    const up = this.#ancestors(bareName(source));
    const down = this.#ancestors(bareName(target));
    const common = down === null ? undefined : up?.find((name) => down.includes(name));
    return common === undefined ? 0n : this.#commonTime(up ?? [], down ?? [], common);
  }

  #parent(name: string): string | null {
    return (this.#static.get(name) ?? this.#moving.get(name)?.newest)?.parent ?? null;
  }

  /** Pose of `from` in `to`, or the reason why there is none. */
  #find(to: string, from: string, time: bigint): Transform | string {
    for (const name of [from, to]) if (!this.#names.has(name)) return this.#unknown(name);
    const up = this.#ancestors(from);
    const down = this.#ancestors(to);
    if (up === null || down === null) return LOOP;
    const common = up.find((name) => down.includes(name));
    if (common === undefined) {
      return (
        `Could not find a connection between '${to}' and '${from}' because they are not part of the same tree. ` +
        "Tf has two or more unconnected trees"
      );
    }
    if (time !== 0n) return this.#between(to, from, common, time);
    const newest = this.#commonTime(up, down, common);
    const { drawnAt } = this;
    if (drawnAt !== null && drawnAt < newest && newest - drawnAt < MAX_PAST) {
      const drawn = this.#between(to, from, common, drawnAt);
      if (typeof drawn !== "string") return drawn;
    }
    return this.#between(to, from, common, newest);
  }

  /** Pose of `from` in `to` at a time, by their common ancestor. */
  #between(to: string, from: string, common: string, stamp: bigint): Transform | string {
    const fromPose = this.#compose(from, common, stamp);
    const toPose = this.#compose(to, common, stamp);
    for (const pose of [fromPose, toPose]) {
      if (typeof pose === "string") return `${pose}, when looking up transform from frame [${from}] to frame [${to}]`;
    }
    return relative(toPose as Transform, fromPose as Transform);
  }

  /** Pose of `from` in `to` after the motions of the bodies that carry them. */
  #asMoved(to: string, from: string, pose: Transform): Transform {
    if (this.moved === null) return pose;
    const { fixedFrame, motions } = this.moved;
    const [ofTo, ofFrom] = [to, from].map((name) => this.#motionOf(name, motions));
    const before = to === fixedFrame ? IDENTITY : this.#find(fixedFrame, to, 0n);
    if (ofTo === ofFrom || typeof before === "string") return pose;
    const at = (motion: Transform | undefined, within: Transform): Transform =>
      motion === undefined ? within : compose(motion, within);
    return relative(at(ofTo, before), at(ofFrom, compose(before, pose)));
  }

  /** Motion of the frame itself, or else of its nearest ancestor, that a body carries. */
  #motionOf(name: string, motions: ReadonlyMap<string, Transform>): Transform | undefined {
    const carried = this.#ancestors(name)?.find((one) => motions.has(one));
    return carried === undefined ? undefined : motions.get(carried);
  }

  #unknown(name: string): string {
    const names = this.frames.peek();
    if (names.length === 0) return `nothing publishes ${name}, nor any other transform`;
    const rest = names.length > MAX_NAMES ? ` and ${String(names.length - MAX_NAMES)} more` : "";
    return `nothing publishes ${name}. Frames here: ${names.slice(0, MAX_NAMES).join(", ")}${rest}`;
  }

  /** A frame and its ancestors; null: they form a loop. */
  #ancestors(name: string): string[] | null {
    const chain = [name];
    for (let at = this.#newest(name); at !== undefined; at = this.#newest(at.parent)) {
      chain.push(at.parent);
      if (chain.length > MAX_ANCESTORS) return null;
    }
    return chain;
  }

  /** The newest time at which all moving frames below the common one have a transform; 0n: none moves. */
  #commonTime(up: readonly string[], down: readonly string[], common: string): bigint {
    let time: bigint | null = null;
    for (const chain of [up, down]) {
      for (const name of chain.slice(0, chain.indexOf(common))) {
        const stamp = this.#moving.get(name)?.newest.stamp;
        if (stamp !== undefined && (time === null || stamp < time)) time = stamp;
      }
    }
    return time ?? 0n;
  }

  /** Pose of a frame in an ancestor, or the reason why there is none at that time. */
  #compose(frame: string, ancestor: string, stamp: bigint): Transform | string {
    const position = new Vector3();
    const orientation = new Quaternion();
    let at = frame;
    for (let steps = 0; at !== ancestor; steps++) {
      const step = this.#static.get(at) ?? this.#moving.get(at)?.lookup(stamp);
      if (typeof step === "string") return step;
      if (step === undefined) return `At that time '${at}' had no parent`;
      if (steps > MAX_ANCESTORS) return LOOP;
      position.applyQuaternion(step.orientation).add(step.position);
      orientation.premultiply(step.orientation);
      at = step.parent;
    }
    return { position, orientation };
  }

  #newest(name: string): Sample | undefined {
    return this.#static.get(name) ?? this.#moving.get(name)?.newest;
  }

  /** Add a frame's name; false: too many names. */
  #enter(name: string): boolean {
    if (this.#names.has(name)) return true;
    if (this.#names.size >= MAX_FRAMES) return false;
    this.#names.add(name);
    return true;
  }

  #set(child: string, sample: Sample, isStatic: boolean): void {
    if (isStatic) {
      this.#moving.delete(child);
      this.#static.set(child, sample);
      return;
    }
    this.#static.delete(child);
    const history = this.#moving.get(child);
    if (history === undefined) this.#moving.set(child, new TransformHistory(sample));
    else history.add(sample);
  }
}

/** Name without the slash that tf1 allowed before it. */
function bareName(name: string): string {
  return name.startsWith("/") ? name.slice(1) : name;
}

function sampleOf(
  stamp: bigint,
  parent: string,
  { translation, rotation }: TransformStamped["transform"],
): Sample | null {
  const position = new Vector3(translation.x, translation.y, translation.z);
  const orientation = new Quaternion(rotation.x, rotation.y, rotation.z, rotation.w);
  const length = orientation.length();
  if (parent === "" || !Number.isFinite(length + position.x + position.y + position.z)) return null;
  // Normalized, since float32 quaternions are not quite of length 1; zeros, which some publishers send, are the
  // identity.
  if (length > 0) orientation.normalize();
  else orientation.identity();
  return { stamp, parent, position, orientation };
}

const IDENTITY: Transform = { position: new Vector3(), orientation: new Quaternion() };

/** Compose two poses: `inner` is relative to `outer`; the result is relative to `outer`'s parent. */
function compose(outer: Transform, inner: Transform): Transform {
  return {
    position: inner.position.clone().applyQuaternion(outer.orientation).add(outer.position),
    orientation: outer.orientation.clone().multiply(inner.orientation),
  };
}

/** Pose of b relative to a, from their poses in the same frame. */
function relative(a: Transform, b: Transform): Transform {
  const inverse = a.orientation.clone().invert();
  return {
    position: b.position.clone().sub(a.position).applyQuaternion(inverse),
    orientation: inverse.multiply(b.orientation),
  };
}
