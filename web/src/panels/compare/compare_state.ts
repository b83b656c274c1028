/** Differences of the world or the graph from the recording that it is compared with (`trundle/differences`). */

import { signal } from "@preact/signals";

import type { Page } from "../../page/page";
import type { Subscription, TopicInfo } from "../../protocol/connection";
import type { Difference, Differences, ReferenceInfo } from "../../protocol/generated/page_messages";
import { parsePath } from "../messages/field_path";
import { unitOf } from "../messages/units";
import { perPage } from "../per_page";
import { movingJoints } from "../plots/simulated_joints";
import { sentence } from "../use";

const DEGREES = 180 / Math.PI;
const UNITS: Partial<Readonly<Record<Difference["quantity"], string>>> = {
  distance: "m",
  angle: "°",
  velocity: "m/s",
  "angular velocity": "rad/s",
};

/** A row of the table: numbers in its unit, which is empty where it is not known. */
export interface CompareRow {
  readonly name: string;
  readonly quantity: Difference["quantity"];
  readonly unit: string;
  readonly now: number | null;
  readonly maximum: number | null;
  /** [s] */
  readonly maximumTime: number | null;
  readonly rms: number | null;
}

class CompareState {
  readonly differences = signal<Differences | null>(null);
  readonly fault = signal("");

  constructor(private readonly page: Page) {}

  /** Receive differences until it is closed. */
  follow(): Subscription {
    return this.page.connection.subscribeJson("trundle/differences", (differences) => {
      this.differences.value = differences;
    });
  }

  rows(): readonly CompareRow[] {
    const linear = new Set(
      movingJoints(this.page.world.manifest.value)
        .filter(({ joint }) => joint.type === "prismatic")
        .map(({ name }) => name),
    );
    const topics = this.page.connection.topics.value;
    return (this.differences.value?.rows ?? []).map((row) =>
      row.quantity === "value" ? numberRow(row, topics) : compareRow(row, linear),
    );
  }

  /** The table in SI units. */
  csv(): string {
    const lines = (this.differences.peek()?.rows ?? []).map(({ name, quantity, now, maximum, maximum_time, rms }) =>
      [quoted(name), quantity, now ?? "", maximum ?? "", maximum_time ?? "", rms ?? ""].join(","),
    );
    const unit = "[m, rad, m/s, rad/s]";
    const head = `"name","quantity","now ${unit}","maximum ${unit}","at [s]","RMS ${unit}"`;
    return `${[head, ...lines].join("\n")}\n`;
  }

  setOffset(offset: number): void {
    this.ask(this.page.connection.request("reference_offset", { offset }));
  }

  stop(): void {
    this.ask(this.page.connection.request("stop_comparing", {}));
  }

  private ask(request: Promise<unknown>): void {
    request.then(
      () => void (this.fault.value = ""),
      (error: unknown) => void (this.fault.value = sentence(error)),
    );
  }
}

export const compareState = perPage((page) => new CompareState(page));

/** `linear`: joints whose positions are lengths. */
function compareRow(row: Difference, linear: ReadonlySet<string>): CompareRow {
  const { name, quantity, maximum_time: maximumTime } = row;
  const unit = UNITS[quantity] ?? (linear.has(name) ? "m" : "°");
  const shown = (value: number | null): number | null => (value !== null && unit === "°" ? value * DEGREES : value);
  return { name, quantity, unit, now: shown(row.now), maximum: shown(row.maximum), maximumTime, rms: shown(row.rms) };
}

/** A number of a topic's messages, in the unit that ROS fixes. */
function numberRow(row: Difference, topics: ReadonlyMap<string, TopicInfo>): CompareRow {
  const { name, quantity, now, maximum, maximum_time: maximumTime, rms } = row;
  const path = parsePath(name, topics.keys());
  const type = path === null ? undefined : topics.get(path.topic)?.type;
  const fields = path?.steps.filter((step): step is string => typeof step === "string") ?? [];
  return { name, quantity, unit: type === undefined ? "" : unitOf(type, fields), now, maximum, maximumTime, rms };
}

/** State of the recording at a time of the world [s]. */
export function progressText({ start, duration }: Pick<ReferenceInfo, "start" | "duration">, time: number): string {
  const since = time - start;
  if (since < 0) return `starts in ${(-since).toFixed(1)} s`;
  if (since > duration) return `ended ${(since - duration).toFixed(1)} s ago, at its last poses`;
  return `${since.toFixed(1)} of ${duration.toFixed(1)} s`;
}

function quoted(text: string): string {
  return `"${text.replace(/"/g, '""')}"`;
}
