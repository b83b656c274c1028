/** Animation of a planned path: which waypoint is shown as time passes. */

import { signal } from "@preact/signals";

import { readPace, type Waypoint } from "./trajectory";

export interface PlaybackSettings {
  readonly loop: boolean;
  /** A new path replaces the one being shown at once. */
  readonly interrupt: boolean;
  /** rviz's State Display Time. */
  readonly displayTime: string;
}

export class Playback {
  readonly path = signal<readonly Waypoint[]>([]);
  /** Index of the shown waypoint; -1: none. */
  readonly index = signal(-1);
  readonly isPlaying = signal(false);
  private next: readonly Waypoint[] | null = null;
  /** Time within the path, in its own time [s], or in waypoints. */
  private time = 0;

  /** Show a new path; one that is being shown is shown to its end first, unless it is interrupted or loops. */
  show(path: readonly Waypoint[], { interrupt, loop }: PlaybackSettings): void {
    if (this.isPlaying.peek() && !interrupt && !loop) this.next = path;
    else this.begin(path);
  }

  clear(): void {
    this.next = null;
    this.path.value = [];
    this.index.value = -1;
    this.isPlaying.value = false;
  }

  /** Go on, from the start after the end; or stay. */
  play(isPlaying: boolean): void {
    const path = this.path.peek();
    if (isPlaying && (this.index.peek() < 0 || this.index.peek() >= path.length - 1)) this.begin(path);
    else this.isPlaying.value = isPlaying && path.length > 0;
  }

  /** Stay at a waypoint. */
  seek(index: number): void {
    const path = this.path.peek();
    if (path.length === 0) return;
    this.isPlaying.value = false;
    this.index.value = Math.max(0, Math.min(path.length - 1, Math.round(index)));
  }

  /** Let seconds pass. */
  advance(elapsed: number, { loop, displayTime }: PlaybackSettings): void {
    if (!this.isPlaying.peek()) return;
    const path = this.path.peek();
    const pace = readPace(displayTime) ?? { factor: 1 };
    if ("factor" in pace) {
      this.time = Math.max(this.time, path[this.index.peek()]?.time ?? 0) + elapsed * pace.factor;
      const after = path.findIndex(({ time }) => time > this.time);
      this.reach(after < 0 ? path.length : Math.max(after - 1, 0), loop);
    } else {
      this.time += elapsed / pace.period;
      this.reach(Math.floor(this.time), loop);
    }
  }

  private begin(path: readonly Waypoint[]): void {
    this.next = null;
    this.time = 0;
    this.path.value = path;
    this.index.value = path.length > 0 ? 0 : -1;
    this.isPlaying.value = path.length > 0;
  }

  private reach(index: number, loop: boolean): void {
    const path = this.path.peek();
    if (index < path.length) this.index.value = index;
    else if (this.next !== null) this.begin(this.next);
    else if (loop) this.begin(path);
    else {
      this.index.value = -1;
      this.isPlaying.value = false;
    }
  }
}
