/** Probes, which tell whether the page's state fulfills a lesson's checks. */

import { effect, signal, type ReadonlySignal } from "@preact/signals";

import { NoTransform } from "../../frames/transform";
import type { Page } from "../../page/page";
import { findJoint, findModel } from "../../page/selection_lookup";
import { bodiesOf } from "../../page/world_nodes";
import { nodeNames } from "../../panels/graph/graph_model";
import type { LessonStep } from "../../protocol/generated/page_messages";
import { isWatcher } from "../../protocol/watchers";
import { fixed } from "../../theme/format";

/** Parts of the page that probes read. */
export interface Watched {
  readonly page: Page;
  /** Name of the robot. */
  readonly robot: ReadonlySignal<string | null>;
}

export type Check = LessonStep["checks"][number]["check"];

export interface Progress {
  readonly done: boolean;
  /** Measured progress, or the reason why the check is not fulfilled; may be empty. */
  readonly detail: string;
}

/** Follows a check from the probe's creation on. */
export interface Probe {
  /** Progress now; it changes when a signal that `poll` reads changes. */
  poll(): Progress;
  close(): void;
}

/** Returns why the check's file does not load; null: it loads. */
export type AskFile = () => Promise<string | null>;

/** Nodes of pages and of rviz, which a page replaces. */
const PAGES = /^\/(rviz|trundle_page)/;
/** Time between questions about a file [ms]. */
const FILE_PERIOD = 1500;
const CLOSE_NOTHING = (): void => undefined;

export function probe(watched: Watched, check: Check, askFile: AskFile): Probe {
  const { page, robot } = watched;
  const { connection, displays } = page;
  const when = (isDone: () => boolean): Probe => ({
    poll: () => ({ done: isDone(), detail: "" }),
    close: CLOSE_NOTHING,
  });
  switch (check.check) {
    case "file":
      return fileProbe(askFile);
    case "model":
      return when(() => findModel(page, check.model) !== null);
    case "robot":
      return when(() => robot.value === check.name);
    case "selected":
      return when(() => selectedModel(page) === check.model);
    case "moved":
      return distanceProbe(check.distance, () => modelPosition(page, check.model));
    case "frame_moved":
      return distanceProbe(check.distance, () => framePosition(page, check.reference, check.frame));
    case "joint_moved":
      return jointProbe(page, check);
    case "node":
      return when(() => nodeNames(connection.graph.value).includes(check.node));
    case "publishes":
      return when(() => (connection.graph.value.publishers.get(check.topic) ?? []).some((node) => !PAGES.test(node)));
    case "subscribes":
      return when(() => (connection.graph.value.subscribers.get(check.topic) ?? []).some((node) => !isWatcher(node)));
    case "rate":
      return rateProbe(page, check);
    case "fixed_frame":
      return when(() => displays.fixedFrame.value === check.frame);
  }
}

function selectedModel(page: Page): string | null {
  const selection = page.selection.value;
  return selection !== null && "model" in selection ? selection.model : null;
}

type Position = readonly number[];

function modelPosition(page: Page, name: string): Position | null {
  const model = findModel(page, name);
  const body = model === null ? undefined : bodiesOf(model)[0];
  return (body === undefined ? null : page.world.pose(body))?.position.toArray() ?? null;
}

function framePosition(page: Page, reference: string, frame: string): Position | null {
  const found = page.frames.lookup(reference, frame, 0n);
  return found instanceof NoTransform ? null : found.position.toArray();
}

/** Probe of the distance [m] from the place where an object was first seen. */
function distanceProbe(distance: number, position: () => Position | null): Probe {
  let start: Position | null = null;
  return {
    poll: () => {
      const now = position();
      start ??= now;
      if (now === null || start === null) return { done: false, detail: "it is not there" };
      const moved = Math.hypot(...now.map((value, axis) => value - (start?.[axis] ?? 0)));
      return { done: moved >= distance, detail: `${fixed(moved, 2)} m so far` };
    },
    close: CLOSE_NOTHING,
  };
}

function jointProbe(page: Page, check: Extract<Check, { readonly check: "joint_moved" }>): Probe {
  let start: number | null = null;
  return {
    poll: () => {
      const joint = findJoint(page, check.model, check.joint);
      const now = joint?.index == null ? undefined : page.world.joints.value.at(joint.index)?.position;
      if (now === undefined) return { done: false, detail: "it is not there" };
      start ??= now;
      const moved = Math.abs(now - start);
      return { done: moved >= check.by, detail: `${fixed(moved, 2)} so far` };
    },
    close: CLOSE_NOTHING,
  };
}

function rateProbe(page: Page, check: Extract<Check, { readonly check: "rate" }>): Probe {
  const { connection } = page;
  const meter = connection.subscribeRaw(check.topic, () => undefined);
  return {
    poll: () => {
      const { rate } = connection.statistics(check.topic);
      return { done: (rate ?? 0) >= check.hz, detail: rate === null ? "no messages" : `${fixed(rate, 1)} Hz` };
    },
    close: () => meter.close(),
  };
}

function fileProbe(askFile: AskFile): Probe {
  let progress: Progress = { done: false, detail: "" };
  let timer: ReturnType<typeof setTimeout> | undefined;
  let isOpen = true;
  const ask = async (): Promise<void> => {
    try {
      const fault = await askFile();
      progress = { done: fault === null, detail: fault ?? "" };
    } catch (error) {
      progress = { done: false, detail: error instanceof Error ? error.message : String(error) };
    }
    if (isOpen) timer = setTimeout(() => void ask(), FILE_PERIOD);
  };
  void ask();
  return {
    poll: () => progress,
    close: () => {
      isOpen = false;
      clearTimeout(timer);
    },
  };
}

/** Poll probes a few times a second, and whenever a signal that they read changes; returns a function that stops. */
export function watchProbes(probes: readonly Probe[], onProgress: (progress: readonly Progress[]) => void): () => void {
  const polls = signal(0);
  const stop = effect(() => {
    if (polls.value >= 0) onProgress(probes.map((each) => each.poll()));
  });
  const timer = setInterval(() => (polls.value += 1), 250);
  return () => {
    clearInterval(timer);
    stop();
    for (const each of probes) each.close();
  };
}
