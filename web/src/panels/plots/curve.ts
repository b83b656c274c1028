/** A curve: the numbers at a path, with their times. */

import { effect, signal } from "@preact/signals";

import type { Page } from "../../page/page";
import type { Subscription } from "../../protocol/connection";
import { seconds, type RosMessage, type RosTime } from "../../protocol/ros_types";
import {
  isList,
  isMessage,
  numberAt,
  parsePath,
  stepsText,
  valueAt,
  type Step,
  type TopicPath,
} from "../messages/field_path";
import { unitOf } from "../messages/units";
import { RingBuffer } from "./ring_buffer";
import { seriesFeed } from "./series_feed";

const CAPACITY = 120_000; // points: two minutes at 1 kHz

export class Curve {
  readonly points = new RingBuffer(CAPACITY);
  /** Reason why nothing is drawn; empty: drawn. */
  readonly fault = signal("");
  readonly unit = signal("");
  readonly axis = signal<"left" | "right">("left");
  /** True for commands and other messages without a stamp: a value holds until the next message. */
  readonly isHeld = signal(false);
  /** Counts points, so that a drawing knows whether there are new ones. */
  revision = 0;
  private subscription: Subscription | undefined;
  private readonly dispose: () => void;

  constructor(
    private readonly page: Page,
    /** Path as typed. */
    readonly path: string,
    private readonly givenName?: string,
  ) {
    const isWorld = page.session.kind === "simulation" || page.session.kind === "log";
    let last = "";
    this.dispose = effect(() => {
      const topicPath = parsePath(path, page.connection.topics.value.keys());
      if (!path.startsWith("/") && isWorld) {
        if (last !== path) this.followWorld();
        last = path;
        return;
      }
      const next = topicPath && topicPath.topic + stepsText(topicPath.steps);
      if (next === last) return;
      last = next ?? "";
      this.subscription?.close();
      this.subscription = undefined;
      if (topicPath !== null) this.follow(topicPath);
      else this.fault.value = "Not a path; example: /odom.twist.twist.linear.x";
    });
  }

  /** Name in the legend: the given one, else the path's last two steps, or a joint without its model. */
  get name(): string {
    if (this.givenName !== undefined) return this.givenName;
    const { steps } = this.split();
    return steps.length === 0
      ? this.path.slice(this.modelEnd > 0 ? this.modelEnd + 2 : 0)
      : stepsText(steps.slice(-2)).replace(/^\./, "");
  }

  /** Part of the path that the legend's name omits. */
  get caption(): string {
    if (this.givenName !== undefined) return this.path;
    const { topic, steps } = this.split();
    return steps.length === 0
      ? this.path.slice(0, Math.max(0, this.modelEnd))
      : `${topic} ${stepsText(steps.slice(0, -2)).replace(/^\./, "")}`.trim();
  }

  close(): void {
    this.dispose();
    this.subscription?.close();
  }

  /** Index at which the name of a joint's model ends: `outer::inner::joint.velocity`. */
  private get modelEnd(): number {
    return this.path.startsWith("/") ? -1 : this.path.lastIndexOf("::");
  }

  private split(): TopicPath {
    return parsePath(this.path, this.page.connection.topics.peek().keys()) ?? { topic: "", steps: [] };
  }

  private follow({ topic, steps }: TopicPath): void {
    this.fault.value = "No message yet";
    const fields = steps.filter((step): step is string => typeof step === "string");
    const receive = (message: RosMessage, type: string, time: bigint): void => {
      const value = numberAt(message, steps);
      this.fault.value = value === null ? faultAt(message, steps) : "";
      if (value === null) return;
      this.unit.value = unitOf(type, fields);
      const stamp = stampOf(message);
      this.isHeld.value = stamp === null || topic === this.page.drive.topic.peek();
      this.add(stamp ?? Number(time) / 1e9, value);
    };
    this.subscription = this.page.connection.subscribe(
      topic,
      ({ message, type, time }) => receive(message, type, time),
      { every: true, onError: (text) => void (this.fault.value = text) },
    );
  }

  private followWorld(): void {
    this.fault.value = "No value yet";
    this.subscription = seriesFeed(this.page).follow(this.path, {
      onValue: (time, value) => {
        this.fault.value = "";
        if (time <= (this.points.lastX ?? -Infinity)) this.points.truncate(time); // the world went back in time
        this.add(time, value);
      },
      onUnit: (unit) => void (this.unit.value = unit),
      onFault: (text) => void (this.fault.value = text),
    });
  }

  private add(time: number, value: number): void {
    if (!Number.isFinite(value)) return;
    this.points.push(time, value);
    this.revision += 1;
  }
}

/** Stamp of the header [s]; null where there is none or it is zero. */
function stampOf(message: RosMessage): number | null {
  const stamp = (message["header"] as { readonly stamp?: RosTime } | undefined)?.stamp;
  if (stamp === undefined || (stamp.sec === 0 && stamp.nsec === 0)) return null;
  return seconds(stamp);
}

/** Reason why a path has no number: its first invalid step, and the fields that exist instead. */
function faultAt(message: RosMessage, steps: readonly Step[]): string {
  for (let count = 0; count <= steps.length; count += 1) {
    const value = valueAt(message, steps.slice(0, count));
    if (value === undefined) {
      const step = stepsText(steps.slice(count - 1, count));
      const above = valueAt(message, steps.slice(0, count - 1));
      const instead = above !== undefined && isMessage(above) ? `; fields here: ${Object.keys(above).join(", ")}` : "";
      const length = above !== undefined && isList(above) ? `; it has ${above.length} elements` : "";
      return `There is no ${step.replace(/^\./, "")}${instead}${length}`;
    }
  }
  const value = valueAt(message, steps);
  if (value !== undefined && isMessage(value))
    return `This is not a number; fields here: ${Object.keys(value).join(", ")}`;
  return value !== undefined && isList(value)
    ? `This is a list of ${value.length}; choose one, as [0]`
    : "This is not a number";
}
