/** A plot: its curves, and the ranges of its axes. */

import type { Curve } from "./curve";

export interface Plot {
  readonly id: number;
  readonly curves: readonly Curve[];
}

export type Range = readonly [number, number];

/** Smallest margin: numerical noise of what is at rest stays a flat line. */
const SMALLEST_MARGIN = 1e-5;

/** Range of values with a margin of a tenth above and below. */
export function paddedRange(values: readonly Float64Array[]): Range {
  let min = Infinity;
  let max = -Infinity;
  for (const ys of values) {
    for (const y of ys) {
      if (y < min) min = y;
      if (y > max) max = y;
    }
  }
  if (min > max) return [0, 1];
  const margin = max > min ? Math.max((max - min) * 0.1, SMALLEST_MARGIN) : Math.max(Math.abs(max) * 0.1, 0.1);
  return [min - margin, max + margin];
}
