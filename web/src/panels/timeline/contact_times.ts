/** Times of contact between models, as received by this page. */

import { contactCount, HEADER, SIZE } from "../../scene/world/contact_rows";
import { Intervals } from "./intervals";

/** Largest number of pairs; the pair that touched longest ago is dropped first, and among equals the newest pair. */
const MAX_PAIRS = 40;

export interface PairStretches {
  readonly pair: string;
  readonly bands: readonly (readonly [number, number])[];
}

export class ContactTimes {
  private readonly intervals = new Map<string, Intervals>();

  get all(): readonly PairStretches[] {
    const pairs = [...this.intervals].map(([pair, { bands }]) => ({ pair, bands }));
    return pairs.filter(({ bands }) => bands.length > 0).sort((one, other) => one.pair.localeCompare(other.pair));
  }

  /** Record the pairs that touch at a time [s]; times up to `known` [s] are recorded already. */
  note(touching: ReadonlySet<string>, time: number, known: number): void {
    if (time < known) return;
    for (const pair of touching) if (!this.intervals.has(pair)) this.intervals.set(pair, new Intervals());
    for (const [pair, intervals] of this.intervals) intervals.note(touching.has(pair), time);
    while (this.intervals.size > MAX_PAIRS) this.dropOldest();
  }

  private dropOldest(): void {
    const spans = [...this.intervals].map(([pair, { bands }]) => ({
      pair,
      start: bands[0]?.[0] ?? 0,
      end: bands.at(-1)?.[1] ?? -Infinity,
    }));
    const oldest = spans.reduce((one, other) =>
      other.end < one.end || (other.end === one.end && other.start > one.start) ? other : one,
    );
    this.intervals.delete(oldest.pair);
  }
}

/** Pairs of models that touch in a message; `models`: of each body. Contacts of a model with itself do not count. */
export function touchingPairs(
  message: DataView,
  generation: number | undefined,
  models: ReadonlyMap<number, string>,
): ReadonlySet<string> {
  const pairs = new Set<string>();
  const end = HEADER + SIZE * contactCount(message, generation);
  for (let at = HEADER; at < end; at += SIZE) {
    const [one, other] = [models.get(message.getFloat64(at, true)), models.get(message.getFloat64(at + 8, true))];
    if (one !== undefined && other !== undefined && one !== other)
      pairs.add(one < other ? `${one} · ${other}` : `${other} · ${one}`);
  }
  return pairs;
}
