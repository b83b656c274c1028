/** Lines of a plot: its curves, and beside them or in their place the recording's curves or the differences. */

import type { Reference } from "../../scene/simulated_world";
import type { Curve } from "./curve";
import { differenceOf, referenceBetween, referenceOf, type Points } from "./reference_curve";

/** What is drawn while the world is compared with a recording. */
export const REFERENCE_MODES = ["With reference", "Difference", "Run alone"] as const;
/** Largest difference between two times that count as one [s]. */
const SAME_TIME = 1e-6;
export type ReferenceMode = (typeof REFERENCE_MODES)[number];

export interface Line {
  readonly curve: Curve;
  /** Index of its curve, which gives its color. */
  readonly index: number;
  /** Name of its column in files. */
  readonly name: string;
  readonly isReference: boolean;
  /** Time after which the line has no value [s]. */
  readonly end: number;
  /** Points of a range of time [s]. */
  readonly between: (from: number, to: number) => Points;
}

export function linesOf(curves: readonly Curve[], mode: ReferenceMode, reference: Reference | null): readonly Line[] {
  const lines = curves.map((curve, index): Line => {
    const series = referenceOf(curve, reference);
    const run = (from: number, to: number): Points => curve.points.between(from, to);
    const name = curve.path;
    if (mode !== "Difference" || series === null || reference === null)
      return { curve, index, name, isReference: false, end: Infinity, between: run };
    const { start } = reference.info;
    const end = start + (series.times.at(-1) ?? -Infinity);
    const between = (from: number, to: number): Points => differenceOf(run(from, to), series, start);
    return { curve, index, name: `${name} (difference)`, isReference: false, end, between };
  });
  if (mode !== "With reference" || reference === null) return lines;
  return lines.flatMap((line) => {
    const series = referenceOf(line.curve, reference);
    if (series === null) return [line];
    const { start } = reference.info;
    const between = (from: number, to: number): Points => referenceBetween(series, start, from, to);
    const end = start + (series.times.at(-1) ?? -Infinity);
    return [line, { ...line, name: `${line.name} (reference)`, isReference: true, end, between }];
  });
}

/** Value of a line's newest point at or before a time; null before the first, and after a recording's end. */
export function valueAt(line: Line, time: number): number | null {
  if (time > line.end + SAME_TIME) return null;
  const [xs, ys] = line.between(time, time);
  for (let at = xs.length - 1; at >= 0; at -= 1) if ((xs[at] ?? Infinity) <= time) return ys[at] ?? null;
  return null;
}
