/** Numbers, times and sizes as the page writes them. */

import { clock, fixed } from "../../theme/format";

const MINUS = "\u2212";

/** Number with at most `digits` significant digits, with an exponent only for very large or small ones. */
export function significant(value: number, digits = 4): string {
  if (Number.isNaN(value)) return "nan";
  if (!Number.isFinite(value)) return value > 0 ? "inf" : `${MINUS}inf`;
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e9 || size < 1e-6)) return value.toExponential(digits - 1).replace(/-/g, MINUS);
  return String(Number(size >= 10 ** digits ? value.toFixed(0) : value.toPrecision(digits))).replace("-", MINUS);
}

/** Shortest text that reads back as the same float32, or else float64. */
export function exact(value: number | bigint): string {
  if (typeof value === "bigint" || Number.isInteger(value)) return value.toString().replace("-", MINUS);
  if (!Number.isFinite(value)) return significant(value);
  let shortest = value;
  for (let digits = 6; digits <= 9 && Math.fround(value) === value; digits += 1) {
    shortest = Number(value.toPrecision(digits));
    if (Math.fround(shortest) === value) break;
  }
  return String(shortest).replace(/-/g, MINUS);
}

/** `29.4 kB/s`. */
export function bytes(count: number): string {
  const units = ["B", "kB", "MB", "GB"];
  let value = count;
  let unit = 0;
  while (value >= 999.5 && unit < units.length - 1) {
    value /= 1000;
    unit += 1;
  }
  const decimals = unit === 0 || value >= 99.95 ? 0 : 1;
  return `${value.toFixed(decimals)} ${units[unit] ?? ""}`;
}

/** Age [s] with two decimals up to a minute, then minutes, hours. */
export function age(seconds: number): string {
  if (seconds < 60) return `${fixed(Math.max(0, seconds), 2)} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min`;
  return `${Math.floor(seconds / 3600)} h`;
}

const WALL_CLOCK = 1e8; // s: simulations do not run three years

/** ROS time [s]: `0:12.48` of a simulation, the time of day of a clock on the wall. */
export function timeText(seconds: number, decimals = 2): string {
  if (Math.abs(seconds) < WALL_CLOCK) return clock(seconds, decimals);
  const midnight = new Date(seconds * 1000).setHours(0, 0, 0, 0) / 1000;
  const ofDay = seconds - midnight;
  return ofDay < 3600
    ? `0:${clock(ofDay, decimals).padStart(decimals > 0 ? 6 + decimals : 5, "0")}`
    : clock(ofDay, decimals);
}
