/** Converts the server's times to this page's clock, and tells how late the page is. */

import { signal } from "@preact/signals";

import type { Lag } from "./connection";

/** Interval at which the lag is read [ms]. */
const TICK = 250;
/** The server sends something at least each second; a longer silence is a lag [ms]. */
const MAX_SILENCE = 1500;
/** A lag is shown from the first limit on, and until it falls below the second [ms]. */
const SHOWN = 500;
const HIDDEN = 300;
/** Time for which the shortest delay is remembered, at most twice as long, since the clocks drift apart [ms]. */
const MEMORY = 60_000;

export class ServerClock {
  /** Null: the shown data are at most half a second old. */
  readonly lag = signal<Lag | null>(null);
  /** Shortest differences between arrival and server's time, in this period and in the one before [ms]. */
  #offset = Infinity;
  #olderOffset = Infinity;
  #turnAt = 0;
  /** Shortest delay since the last tick, and time of the last arrival [ms]. */
  #delay = Infinity;
  #arrivedAt = 0;
  #wasLate = false;
  #timer: ReturnType<typeof setInterval> | null = null;

  /** Begin with a server that has just greeted. */
  start(): void {
    this.stop();
    this.#offset = this.#olderOffset = this.#delay = Infinity;
    this.#turnAt = this.#arrivedAt = performance.now();
    this.#wasLate = false;
    this.#timer = setInterval(() => this.#tick(performance.now()), TICK);
  }

  /** The connection is lost. */
  stop(): void {
    if (this.#timer !== null) clearInterval(this.#timer);
    this.#timer = null;
    this.lag.value = null;
  }

  /**
   * Time at which the server had a message, by `performance.now()` [ms].
   * The fastest messages of the last minutes are assumed to arrive without delay.
   */
  sentAt(serverTime: number): number {
    const now = performance.now();
    if (now >= this.#turnAt) {
      this.#turnAt = now + MEMORY;
      this.#olderOffset = this.#offset;
      this.#offset = Infinity;
    }
    this.#offset = Math.min(this.#offset, now - serverTime);
    const sentAt = serverTime + Math.min(this.#offset, this.#olderOffset);
    this.#delay = Math.min(this.#delay, now - sentAt);
    this.#arrivedAt = now;
    return sentAt;
  }

  #tick(now: number): void {
    const silence = now - this.#arrivedAt;
    if (this.#delay === Infinity && silence < MAX_SILENCE) return;
    const late = Math.max(this.#delay === Infinity ? 0 : this.#delay, silence < MAX_SILENCE ? 0 : silence);
    this.#delay = Infinity;
    const shown = this.lag.peek();
    if (shown === null) {
      if (late >= SHOWN && this.#wasLate) this.lag.value = { seconds: late / 1000, since: Date.now() - late };
      this.#wasLate = late >= SHOWN;
    } else this.lag.value = late < HIDDEN ? null : { seconds: late / 1000, since: shown.since };
  }
}
