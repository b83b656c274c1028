/** A curve's counterpart in the recording that the world is compared with, and the difference from it. */

import type { Reference } from "../../scene/simulated_world";
import { firstAfter, type ReferenceSeries } from "../../scene/world/reference_motion";
import { parsePath, pathText } from "../messages/field_path";
import type { Curve } from "./curve";

export type Points = readonly [Float64Array, Float64Array];
const TURN = 2 * Math.PI;
const NONE: Points = [new Float64Array(0), new Float64Array(0)];

/** Values of the recording under a curve's name; null: it has none. */
export function referenceOf(curve: Pick<Curve, "path">, reference: Reference | null): ReferenceSeries | null {
  if (reference === null) return null;
  const topics = reference.info.topics.map(({ topic }) => topic);
  const path = curve.path.startsWith("/") ? parsePath(curve.path, topics) : null;
  return reference.motion.find(path === null ? curve.path : pathText(path));
}

/** Points of the recording in a range of the run's time [s], with one more on either side. */
export function referenceBetween(series: ReferenceSeries, start: number, from: number, to: number): Points {
  const { times, values } = series;
  const first = Math.max(0, firstAfter(times, from - start) - 1);
  const last = Math.min(times.length, firstAfter(times, to - start) + 1);
  return [times.subarray(first, last).map((time) => time + start), values.subarray(first, last)];
}

/** Differences of a run's points from the recording, at those of the points' times that the recording covers. */
export function differenceOf([xs, ys]: Points, { times, values, isAngle }: ReferenceSeries, start: number): Points {
  const last = times.length - 1;
  const first = xs.findIndex((x) => x >= start);
  if (first < 0 || last < 0) return NONE;
  const [found, differences]: [number[], number[]] = [[], []];
  let after = firstAfter(times, (xs[first] ?? 0) - start);
  for (let at = first; at < xs.length; at += 1) {
    const time = (xs[at] ?? 0) - start;
    if (time > (times[last] ?? 0)) break;
    while (after < last && (times[after] ?? Infinity) <= time) after += 1;
    const before = Math.max(0, after - 1);
    const [t0 = 0, t1 = 0, v0 = NaN, v1 = NaN] = [times[before], times[after], values[before], values[after]];
    const share = t1 > t0 ? Math.min(1, (time - t0) / (t1 - t0)) : 1;
    const step = isAngle ? wrapped(v1 - v0) : v1 - v0;
    const difference = (ys[at] ?? NaN) - (v0 + share * step);
    found.push(xs[at] ?? 0);
    differences.push(isAngle ? wrapped(difference) : difference);
  }
  return [Float64Array.from(found), Float64Array.from(differences)];
}

/** An angle within ±π [rad]. */
function wrapped(angle: number): number {
  return angle - TURN * Math.round(angle / TURN);
}
