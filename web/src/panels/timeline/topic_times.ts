/** Times of each topic's messages: of a bag from its index (`trundle/lanes`), otherwise as they arrive. */

import { signal } from "@preact/signals";

import type { Connection } from "../../protocol/connection";
import type { Lanes } from "../../protocol/generated/page_messages";
import type { Span } from "./intervals";

/** A topic's messages over time. */
export interface TopicStretches {
  readonly topic: string;
  /** Messages in the whole bag; null: not known. */
  readonly count: number | null;
  /** Intervals: start and end [s]. */
  readonly bands: readonly (readonly [number, number])[];
}

/** Largest number of buckets in the visible span. */
const BUCKETS = 600;
const SHORTEST = 0.05; // s
/** Largest time between two calls of `look` [s]; a larger step is a jump in time. */
const LATE = 1;
const NS = 1e9;

export class TopicTimes {
  /** Intervals of a bag's topics; null: no bag is played, or its index is not read yet. */
  private readonly recorded = signal<readonly TopicStretches[] | null>(null);
  /** Buckets in which messages of a topic came. */
  private readonly received = new Map<string, Set<number>>();
  private readonly counts = new Map<string, number>();
  private bucket = SHORTEST; // s
  private lookedAt = -Infinity; // bucket

  constructor(private readonly connection: Connection) {
    connection.subscribeJson("trundle/lanes", (lanes) => {
      this.recorded.value = stretchesOf(lanes);
    });
  }

  /** Intervals of all topics, sorted by topic. */
  get all(): readonly TopicStretches[] {
    return (
      this.recorded.value ??
      [...this.received.keys()].sort().map((topic) => ({ topic, count: null, bands: this.bands(topic) }))
    );
  }

  /**
   * Note which of the page's subscribed topics had messages since the last look.
   *
   * Buckets may be shorter than the time between two looks: messages then count for all buckets since the last look.
   */
  look(span: Span, now: number): void {
    const doublings = Math.ceil(Math.log2((span.end - span.start) / (BUCKETS * SHORTEST)));
    this.setBucket(SHORTEST * 2 ** Math.max(0, doublings));
    const at = Math.floor(now / this.bucket);
    const isLate = at > this.lookedAt && (at - this.lookedAt) * this.bucket <= LATE;
    const first = isLate ? this.lookedAt + 1 : at;
    this.lookedAt = at;
    for (const topic of this.connection.topics.peek().keys()) {
      const { count } = this.connection.statistics(topic);
      const before = this.counts.get(topic) ?? 0;
      this.counts.set(topic, count);
      if (count <= before) continue;
      const buckets = this.received.get(topic) ?? new Set<number>();
      for (let bucket = first; bucket <= at; bucket += 1) buckets.add(bucket);
      this.received.set(topic, buckets);
    }
  }

  /** Change the length of the buckets [s]; shorter ones start empty. */
  private setBucket(length: number): void {
    const ratio = this.bucket / length;
    this.bucket = length;
    if (ratio > 1) {
      this.received.clear();
      this.lookedAt = -Infinity;
    } else if (ratio < 1) {
      for (const [topic, buckets] of this.received)
        this.received.set(topic, new Set([...buckets].map((bucket) => Math.floor(bucket * ratio))));
      this.lookedAt = Math.floor(this.lookedAt * ratio);
    }
  }

  /** Intervals of a topic [s]; adjacent ones are joined. */
  private bands(topic: string): readonly (readonly [number, number])[] {
    const bands: [number, number][] = [];
    for (const bucket of [...(this.received.get(topic) ?? [])].sort((one, other) => one - other)) {
      const [start, end] = [bucket * this.bucket, (bucket + 1) * this.bucket];
      const last = bands.at(-1);
      if (last !== undefined && start - last[1] < this.bucket * 1.5) last[1] = end;
      else bands.push([start, end]);
    }
    return bands;
  }
}

/** Intervals of a bag by topic [s]. */
export function stretchesOf({ start_ns, bucket_ns, topics }: Lanes): readonly TopicStretches[] {
  const time = (bucket: number): number => (start_ns + bucket * bucket_ns) / NS;
  const names = Object.keys(topics).sort();
  return names.map((topic) => {
    const { count, bands } = topics[topic] ?? { count: 0, bands: [] };
    return { topic, count, bands: bands.map(([first, last]) => [time(first), time(last + 1)] as const) };
  });
}
