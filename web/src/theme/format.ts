/** Numbers as the page writes them: fixed decimals, a true minus sign, no negative zero. */

/** Number with fixed decimals; "—": no value. */
export function fixed(value: number | null | undefined, decimals: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "—";
  const text = value.toFixed(decimals);
  return text.startsWith("-") ? (Number(text) === 0 ? text.slice(1) : `−${text.slice(1)}`) : text;
}

/** Number with at most six significant digits, without trailing zeros. */
export function plain(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(6))).replace("-", "−") : String(value);
}

/** Typed number, with either minus sign; null: not a number. */
export function parseNumber(text: string): number | null {
  const trimmed = text.trim().replace("−", "-").replace(",", ".");
  const value = Number(trimmed);
  return trimmed === "" || !Number.isFinite(value) ? null : value;
}

/** Seconds as `0:12.48`, with hours where there are some. */
export function clock(seconds: number, decimals = 2): string {
  const sign = seconds < 0 ? "−" : "";
  const scale = 10 ** decimals;
  const ticks = Math.floor(Math.abs(seconds) * scale + 1e-6);
  const whole = Math.floor(ticks / scale);
  const fraction = decimals > 0 ? `.${String(ticks % scale).padStart(decimals, "0")}` : "";
  const [hours, minutes, rest] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  const two = (number: number): string => String(number).padStart(2, "0");
  return hours > 0
    ? `${sign}${hours}:${two(minutes)}:${two(rest)}${fraction}`
    : `${sign}${minutes}:${two(rest)}${fraction}`;
}

/** ROS time [ns]: the time of day if it counts from 1970, otherwise as `clock`. */
export function rosTime(nanoseconds: bigint): string {
  const seconds = Number(nanoseconds / 1_000_000n) / 1000;
  if (seconds < 1e9) return clock(seconds);
  const day = new Date(seconds * 1000);
  return clock(day.getHours() * 3600 + day.getMinutes() * 60 + day.getSeconds(), 0);
}

/** A count with its noun: "1 display", "17 displays". */
export function count(number: number, noun: string, plural = `${noun}s`): string {
  return `${number} ${number === 1 ? noun : plural}`;
}
