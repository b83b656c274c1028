/** Browser storage of the page. Without storage (private windows, file pages) nothing is remembered. */

import { parseJson } from "../protocol/json";

const PREFIX = "trundle.";

export function remember(key: string, value: unknown): void {
  try {
    localStorage.setItem(PREFIX + key, JSON.stringify(value));
  } catch {
    // full or forbidden: the page works without
  }
}

/** Stored value, or the fallback if none of its type is stored. */
export function recall<T, F = T>(key: string, fallback: F, is: (value: unknown) => value is T): T | F {
  try {
    const value: unknown = parseJson(localStorage.getItem(PREFIX + key) ?? "null");
    return is(value) ? value : fallback;
  } catch {
    return fallback;
  }
}

export function isNumber(value: unknown): value is number {
  return typeof value === "number" && Number.isFinite(value);
}

export function isBoolean(value: unknown): value is boolean {
  return typeof value === "boolean";
}

/** A type guard that accepts one of these words. */
export function isOneOf<T extends string>(...words: readonly T[]): (value: unknown) => value is T {
  return (value): value is T => words.some((word) => word === value);
}
