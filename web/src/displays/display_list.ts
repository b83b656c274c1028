/** Interface of the list of displays and of rviz's global options. */

import type { ReadonlySignal, Signal } from "@preact/signals";

import type { TopicInfo } from "../protocol/connection";
import type { Display, Status } from "./display";
import type { ColorProperty, IntProperty } from "../rviz/properties";

/** Topic that no display shows, with a class that can show it. */
export interface Offer {
  readonly topic: TopicInfo;
  readonly className: string;
}

/** An entry of the file that cannot be shown: its class and the reason. */
export interface Unsupported {
  readonly className: string;
  readonly name: string;
  readonly reason: string;
}

export interface DisplayList {
  /** Displays of the outermost level; a `Group` has its own. */
  readonly displays: ReadonlySignal<readonly Display[]>;
  readonly unsupported: ReadonlySignal<readonly Unsupported[]>;
  readonly offers: ReadonlySignal<readonly Offer[]>;
  /** Fixed frame as set; `fixedFrame` is the one in use, which is computed if none is set. */
  readonly fixedFrameSetting: Signal<string>;
  readonly fixedFrame: ReadonlySignal<string>;
  /** rviz's global status of the fixed frame. */
  readonly fixedFrameStatus: ReadonlySignal<Status>;
  readonly backgroundColor: ColorProperty;
  readonly frameRate: IntProperty;
  /** rviz's classes that can be added, in rviz's order. */
  readonly classes: readonly string[];

  /** Add a display of a class; with a topic, on that topic. Undoable. */
  add(className: string, topic?: string): Display;
  remove(display: Display): void;
  duplicate(display: Display): Display;
  move(display: Display, to: number): void;
  reset(): void;
  /** Call once per frame: ROS time [ns] and wall seconds since the last frame. */
  update(now: bigint, elapsed: number): void;

  /** Load an .rviz file's text; returns sentences about entries that are not understood. */
  load(text: string): readonly string[];
  /** Text of the current .rviz file, with entries that were not understood. */
  save(): string;
  /** Note that the current file was saved. */
  markSaved(): void;
  /** Number of changes by a person since the file was loaded or saved; values that displays compute do not count. */
  readonly changes: ReadonlySignal<number>;
  /** Make a change of the file that can be undone. */
  edit(title: string, redo: () => void, undo: () => void): void;
}
