/** Rate and bandwidth of a topic. */

import type { TopicStatistics } from "./connection";

/** Messages that are remembered. */
const SAMPLES = 256;
/** [ms] */
const WINDOW = 5000;

export class ArrivalStatistics {
  count = 0;
  /** Messages dropped here, and by the server in this connection. */
  dropped = 0;
  serverDropped = 0;
  /** Times [ms] and sizes [bytes] of messages, in rings; made at the first one. */
  #times: Float64Array | null = null;
  #sizes: Float64Array | null = null;

  /** Count a message; `time`: when the server had it, as `performance.now()` [ms]. */
  add(time: number, bytes: number): void {
    this.#times ??= new Float64Array(SAMPLES);
    this.#sizes ??= new Float64Array(SAMPLES);
    this.#times[this.count % SAMPLES] = time;
    this.#sizes[this.count % SAMPLES] = bytes;
    this.count += 1;
  }

  /** Keep the server's drops so far: a new connection counts from 0. */
  keepServerDrops(): void {
    this.dropped += this.serverDropped;
    this.serverDropped = 0;
  }

  /** Statistics at a time [ms] of `performance.now()`. */
  at(now: number): TopicStatistics {
    const dropped = this.dropped + this.serverDropped;
    if (this.count === 0) return { rate: null, bandwidth: 0, lastAt: null, count: 0, dropped };
    const last = this.#time(1);
    let used = 1;
    let bytes = this.#size(1);
    const limit = Math.min(this.count, SAMPLES);
    // The last two messages always count, however old, so that rates below 1/5 Hz have a figure, too.
    while (used < limit && (used < 2 || this.#time(used + 1) >= now - WINDOW)) bytes += this.#size(++used);
    const span = last - this.#time(used);
    const silent = now - last > Math.max(WINDOW, (2 * span) / (used - 1));
    let rate: number | null = null;
    if (used > 1) rate = silent ? 0 : (used - 1) / (Math.max(span, 1) / 1000);
    const bandwidth = rate === null ? 0 : (rate * bytes) / used;
    return { rate, bandwidth, lastAt: last, count: this.count, dropped };
  }

  #time(back: number): number {
    return this.#times?.[(this.count - back) % SAMPLES] ?? 0;
  }

  #size(back: number): number {
    return this.#sizes?.[(this.count - back) % SAMPLES] ?? 0;
  }
}
