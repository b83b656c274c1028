/** Where the last simulated seconds went (`trundle/performance`), received while it is looked at. */

import { signal } from "@preact/signals";

import type { Page } from "../../page/page";
import type { Subscription } from "../../protocol/connection";
import { perPage } from "../per_page";

export const GROUPS = ["physics", "cameras", "sensors", "plugins", "ros", "page", "other", "waiting"] as const;
export type Group = (typeof GROUPS)[number];

export const GROUP_NAMES: Readonly<Record<Group, string>> = {
  physics: "Physics",
  cameras: "Cameras",
  sensors: "Sensors",
  plugins: "Plugins",
  ros: "ROS",
  page: "Page",
  other: "Other",
  waiting: "Waiting",
};

export interface Part {
  readonly group: Group;
  readonly name: string;
  /** Wall time [s]. */
  readonly wall_s: number;
}

/** About a second of wall time. */
export interface Profile {
  readonly wall_s: number;
  readonly simulated_s: number;
  readonly steps: number;
  readonly contacts: number;
  readonly bodies: number;
  /** Resting trees of bodies, which the physics skips. */
  readonly asleep: number;
  /** Processor time of the graph's thread, which runs beside the simulation's [s]; null: not known, or without ROS. */
  readonly graph_s: number | null;
  readonly parts: readonly Part[];
}

/** A row of the table. */
export interface Row extends Part {
  /** Wall time per simulated second [ms]. */
  readonly perSecond: number;
  /** Of the wall time, 0 to 1. */
  readonly share: number;
}

/** Profiles of which the real-time factor is drawn. */
const KEPT = 120;

export class PerformanceState {
  readonly profile = signal<Profile | null>(null);
  /** Real-time factors, the newest last. */
  readonly factors = signal<readonly number[]>([]);

  constructor(private readonly page: Page) {}

  /** Receive profiles until it is closed. */
  follow(): Subscription {
    return this.page.connection.subscribeRaw("trundle/performance", (payload) => {
      const text = new TextDecoder().decode(new Uint8Array(payload.buffer, payload.byteOffset, payload.byteLength));
      this.receive(JSON.parse(text) as Profile);
    });
  }

  receive(profile: Profile): void {
    this.profile.value = profile;
    if (profile.wall_s > 0)
      this.factors.value = [...this.factors.peek(), profile.simulated_s / profile.wall_s].slice(-KEPT);
  }
}

export const performanceState = perPage((page) => new PerformanceState(page));

/** The most expensive parts first; waiting, which costs nothing, last. */
export function rowsOf({ parts, wall_s, simulated_s }: Profile): readonly Row[] {
  if (wall_s <= 0 || simulated_s <= 0) return [];
  const rows = parts.map((part) => ({
    ...part,
    perSecond: (1000 * part.wall_s) / simulated_s,
    share: part.wall_s / wall_s,
  }));
  return rows.sort(
    (one, other) => Number(one.group === "waiting") - Number(other.group === "waiting") || other.wall_s - one.wall_s,
  );
}

/** Rows as they lie in the bar: group by group. */
export function barOf(rows: readonly Row[]): readonly Row[] {
  return GROUPS.flatMap((group) => rows.filter((row) => row.group === group));
}

/** Points of a line through values, in a box of 100 × 20 whose top is the greatest value or 1. */
export function sparkline(values: readonly number[]): string {
  const top = Math.max(1, ...values);
  const step = 100 / Math.max(1, values.length - 1);
  return values.map((value, index) => `${(index * step).toFixed(1)},${(19 - (18 * value) / top).toFixed(1)}`).join(" ");
}
