/** Colors and dashes of curves: every second curve is dashed, so that curves differ not only by color. */

export const COLORS = ["--plot-1", "--plot-2", "--plot-3", "--plot-4"] as const;

export function isDashed(index: number): boolean {
  return index % 2 === 1;
}

/** Dashes of the lines of a recording [px]. */
export const REFERENCE_DASH = [1.5, 3];
