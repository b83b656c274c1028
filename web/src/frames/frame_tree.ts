/** Interface of the buffer of transforms. */

import type { ReadonlySignal } from "@preact/signals";

import type { NoTransform, Transform } from "./transform";

export interface FrameInfo {
  readonly name: string;
  readonly parent: string | null;
  readonly isStatic: boolean;
  /** Stamp of the newest transform [ns]; 0 for a static one. */
  readonly stamp: bigint;
  /** Transforms per second over the last seconds; null for a static one and before the second. */
  readonly rate: number | null;
  /** Authority, where it is known. */
  readonly publisher: string | null;
}

/** Motions of frames while time stands still, since nothing publishes their transforms then. */
export interface MovedFrames {
  /** Frame in which the motions are given. */
  readonly fixedFrame: string;
  /** Motion of each frame that a body carries: the frame's pose now times the inverse of its pose in tf. */
  readonly motions: ReadonlyMap<string, Transform>;
}

/** Frames that are drawn at the same time as the simulated world. */
export interface DrawnFrames extends FrameTree {
  /** Latest time [ns] of a frame's pose where a caller asks for the newest; null: no limit. */
  drawnAt: bigint | null;
  /** Motions that are applied where a caller asks for a frame's newest pose, also to its descendants; null: none. */
  moved: MovedFrames | null;
  /** Newest common time of two frames [ns]; 0n: nothing moves between them, or they are not connected. */
  newestTime(target: string, source: string): bigint;
}

export interface FrameTree {
  /** Names of all frames, sorted; changes only when a frame appears, is forgotten or gets another parent. */
  readonly frames: ReadonlySignal<readonly string[]>;
  /** Frames with their parents and ages, now. */
  describe(): readonly FrameInfo[];
  /**
   * Pose of `source` in `target` at a time [ns], interpolated as tf does; at 0n the newest common time.
   * A leading slash of a frame is ignored.
   */
  lookup(target: string, source: string, time: bigint): Transform | NoTransform;
}
