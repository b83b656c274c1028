/** Intervals of simulated time. */

/** Interval that the timeline shows. */
export interface Span {
  /** [s] */
  readonly start: number;
  readonly end: number;
  /** Up to here something is known; what follows is the future of a simulation. */
  readonly known: number;
  /** Whether one can go to a time. */
  readonly isSeekable: boolean;
}

/** Most that are kept; the oldest go. */
const MAX_INTERVALS = 200;

/** Intervals in which something went on, as a drive or a recording. */
export class Intervals {
  private intervals: [number, number][] = [];
  private isOn = false;
  private known = 0; // s

  /** Beginning and end of each [s]. */
  get bands(): readonly (readonly [number, number])[] {
    return this.intervals;
  }

  /** Note whether it goes on at a time [s]; what was noted after it is forgotten where time has begun again. */
  note(isOn: boolean, known: number): void {
    if (known < this.known) {
      this.intervals = this.intervals
        .filter(([start]) => start < known)
        .map(([start, end]) => [start, Math.min(end, known)]);
      this.isOn = false;
    }
    this.known = known;
    const last = this.intervals.at(-1);
    if (this.isOn && last !== undefined) last[1] = known;
    else if (isOn) this.intervals = [...this.intervals, [known, known] as [number, number]].slice(-MAX_INTERVALS);
    this.isOn = isOn;
  }
}
