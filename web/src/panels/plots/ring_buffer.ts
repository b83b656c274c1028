/** Points of a curve: the newest ones, kept contiguous. */

/** Step back in time that means a reset [s]; messages out of order differ by less. */
const RESET = 1;

/**
 * Keeps at least the newest `capacity` points, x ascending. Arrays of twice the size let a view be a plain subarray:
 * when the end is reached the newest half moves to the front, once per `capacity` points.
 */
export class RingBuffer {
  private xs: Float64Array;
  private ys: Float64Array;
  private start = 0;
  private end = 0;

  constructor(readonly capacity: number) {
    this.xs = new Float64Array(2 * capacity);
    this.ys = new Float64Array(2 * capacity);
  }

  get length(): number {
    return this.end - this.start;
  }

  /**
   * Add a point. A point a little older than the last is dropped; a much older one means a reset and clears the buffer.
   */
  push(x: number, y: number): void {
    const last = this.lastX ?? x;
    if (x < last - RESET) this.clear();
    else if (x < last) return;
    if (this.end === this.xs.length) {
      this.xs.copyWithin(0, this.end - this.capacity, this.end);
      this.ys.copyWithin(0, this.end - this.capacity, this.end);
      this.start = 0;
      this.end = this.capacity;
    }
    this.xs[this.end] = x;
    this.ys[this.end] = y;
    this.end += 1;
    this.start = Math.max(this.start, this.end - this.capacity);
  }

  /** Drop the points at and after a time. */
  truncate(x: number): void {
    this.end = this.indexOf(x);
  }

  clear(): void {
    this.start = 0;
    this.end = 0;
  }

  get lastX(): number | null {
    return this.length === 0 ? null : (this.xs[this.end - 1] ?? null);
  }

  get lastY(): number | null {
    return this.length === 0 ? null : (this.ys[this.end - 1] ?? null);
  }

  /** Points of a range of time, with one more on either side so that lines reach the edge; views, not copies. */
  between(from: number, to: number): readonly [Float64Array, Float64Array] {
    const first = Math.max(this.start, this.indexOf(from) - 1);
    const last = Math.min(this.end, this.indexOf(to) + 1);
    return [this.xs.subarray(first, last), this.ys.subarray(first, last)];
  }

  /** Value of the newest point at or before a time; null before the first. */
  at(x: number): number | null {
    let index = this.indexOf(x);
    if (index < this.end && this.xs[index] === x) index += 1;
    return index === this.start ? null : (this.ys[index - 1] ?? null);
  }

  /** Index of the first point at or after a time. */
  private indexOf(x: number): number {
    let low = this.start;
    let high = this.end;
    while (low < high) {
      const middle = (low + high) >>> 1;
      if ((this.xs[middle] ?? Infinity) < x) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}
