/** Queue of messages that wait for their transforms, as tf2's message filter. */

import { NoTransform } from "../frames/transform";

/** Wall seconds after which a waiting message counts as a fault; rviz waits until the queue is full. */
const PATIENCE_S = 1;
/** Queue length for rviz's "no limit". */
const LIMIT_WITHOUT_LIMIT = 100;

interface Waiting<M> {
  readonly message: M;
  waited: number;
}

export class MessageFilter<M, T> {
  private waiting: Waiting<M>[] = [];
  private limit = 10;

  /**
   * `find` looks up a message's transforms, `deliver` gets the message with them, `fail` gets the reason when a
   * message is dropped or waits too long.
   */
  constructor(
    private readonly find: (message: M) => T | NoTransform,
    private readonly deliver: (message: M, result: T) => void,
    private readonly fail: (reason: NoTransform) => void,
  ) {}

  /** Set the length of the queue; 0: rviz's "no limit". */
  setLimit(limit: number): void {
    this.limit = limit > 0 ? limit : LIMIT_WITHOUT_LIMIT;
  }

  add(message: M): void {
    this.waiting.push({ message, waited: 0 });
    this.flush(0);
    const excess = this.waiting.length - this.limit;
    if (excess <= 0) return;
    const [oldest] = this.waiting.splice(0, excess);
    if (oldest === undefined) return;
    const result = this.find(oldest.message);
    if (result instanceof NoTransform) this.fail(result);
  }

  /** Deliver ready messages, in order; `elapsed` is wall seconds since the last call. */
  flush(elapsed: number): void {
    if (this.waiting.length === 0) return;
    const waiting = this.waiting;
    this.waiting = [];
    for (const entry of waiting) {
      const result = this.find(entry.message);
      if (!(result instanceof NoTransform)) {
        this.deliver(entry.message, result);
        continue;
      }
      const isLate = entry.waited < PATIENCE_S && entry.waited + elapsed >= PATIENCE_S;
      entry.waited += elapsed;
      this.waiting.push(entry);
      if (isLate) this.fail(result);
    }
  }

  clear(): void {
    this.waiting = [];
  }
}
