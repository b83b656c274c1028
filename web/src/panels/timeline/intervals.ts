/** Intervals of simulated time. */

/** Interval that the timeline shows. */
export interface Span {
  /** [s] */
  readonly start: number;
  readonly end: number;
  /** Latest simulated or recorded time; a running simulation's timeline extends beyond it. */
  readonly known: number;
  /** True if one can go to a time. */
  readonly isSeekable: boolean;
}

/** Intervals that are in any of the given ones, in order, as few as possible. */
export function united(intervals: readonly (readonly [number, number])[]): readonly (readonly [number, number])[] {
  const whole: [number, number][] = [];
  for (const [start, end] of intervals.toSorted(([one], [other]) => one - other)) {
    const last = whole.at(-1);
    if (last !== undefined && start <= last[1]) last[1] = Math.max(last[1], end);
    else whole.push([start, end]);
  }
  return whole;
}

/** Largest number of intervals; the oldest are dropped. */
const MAX_INTERVALS = 200;

/** Intervals of an activity, such as a drive or a recording. */
export class Intervals {
  private intervals: [number, number][] = [];
  private isOn = false;
  private known = 0; // s

  /** Intervals: start and end [s]. */
  get bands(): readonly (readonly [number, number])[] {
    return this.intervals;
  }

  /** Record whether the activity is on at a time [s]; later records are dropped if time went back. */
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
