/** Time of a replay: plays in a loop at a speed, or is paused. */

import { signal } from "@preact/signals";

export class Player {
  /** Time since the recording's start [s]. */
  readonly time = signal(0);
  readonly isPlaying = signal(true);
  /** Recorded seconds per second. */
  readonly speed = signal(1);

  constructor(readonly duration: number) {}

  /** Advance by wall time [s]. */
  advance(elapsed: number): void {
    if (!this.isPlaying.peek() || this.duration <= 0) return;
    this.time.value = (this.time.peek() + elapsed * this.speed.peek()) % this.duration;
  }

  seek(time: number): void {
    this.time.value = Math.min(this.duration, Math.max(0, time));
  }

  toggle(): void {
    this.isPlaying.value = !this.isPlaying.peek();
  }
}
