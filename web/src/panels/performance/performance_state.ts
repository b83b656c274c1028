/** Profiles of the last simulated seconds (`trundle/performance`), received while the panel is open. */

import { signal } from "@preact/signals";

import type { Page } from "../../page/page";
import type { Subscription } from "../../protocol/connection";
import type { Profile, ProfilePart } from "../../protocol/generated/page_messages";
import { perPage } from "../per_page";

export type Group = ProfilePart["group"];
const GROUPS: readonly Group[] = ["physics", "cameras", "sensors", "plugins", "ros", "page", "other", "waiting"];

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

/** A row of the table. */
export interface Row extends ProfilePart {
  /** Wall time per simulated second [ms]. */
  readonly perSecond: number;
  /** Ratio of the wall time, 0…1. */
  readonly share: number;
}

/** Profiles whose real-time factors are drawn. */
const MAX_FACTORS = 120;

class PerformanceState {
  readonly profile = signal<Profile | null>(null);
  /** Real-time factors, the newest last. */
  readonly factors = signal<readonly number[]>([]);

  constructor(private readonly page: Page) {}

  /** Receive profiles until it is closed. */
  follow(): Subscription {
    return this.page.connection.subscribeJson("trundle/performance", (profile) => this.receive(profile));
  }

  receive(profile: Profile): void {
    this.profile.value = profile;
    if (profile.wall_s > 0)
      this.factors.value = [...this.factors.peek(), profile.simulated_s / profile.wall_s].slice(-MAX_FACTORS);
  }
}

export const performanceState = perPage((page) => new PerformanceState(page));

/** Most expensive parts first; waiting last, since it costs nothing. */
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

/** Rows in the order of the bar: group by group. */
export function barOf(rows: readonly Row[]): readonly Row[] {
  return GROUPS.flatMap((group) => rows.filter((row) => row.group === group));
}

/** Points of a line through values, in a box of 100 × 20 whose top is the largest value or 1. */
export function sparkline(values: readonly number[]): string {
  const top = Math.max(1, ...values);
  const step = 100 / Math.max(1, values.length - 1);
  return values.map((value, index) => `${(index * step).toFixed(1)},${(19 - (18 * value) / top).toFixed(1)}`).join(" ");
}
