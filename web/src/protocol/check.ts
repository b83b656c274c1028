/** Checks that a value from outside has its declared type; `generated/page_checks.ts` is made of these functions. */

import { parseJson, type Json } from "./json";

/** The page cannot read a message; the text is a sentence for a person. */
export class MessageFault extends Error {}

/** Returns the value as a T; throws a `Mismatch` if it is not a T. */
export type Check<T> = (value: unknown) => T;

/** Mismatch of a value with its type; `path` is the field or item at fault, such as `links[2].name`; empty: the value itself. */
class Mismatch extends Error {
  constructor(
    readonly reason: string,
    readonly path = "",
  ) {
    super(reason);
  }
}

/** Parse and check a message; `name` says what it is. Throws a `MessageFault`. */
export function read<T>(text: string, name: string, check: Check<T>): T {
  let value: Json;
  try {
    value = parseJson(text);
  } catch {
    throw fault(name, "it is not JSON");
  }
  return checked(value, name, check);
}

/** Parse and check the text of a payload. Throws a `MessageFault`. */
export function readPayload<T>(payload: AllowSharedBufferSource, name: string, check: Check<T>): T {
  return read(new TextDecoder().decode(payload), name, check);
}

/** Check a value; `name` says what it is. Throws a `MessageFault`. */
export function checked<T>(value: unknown, name: string, check: Check<T>): T {
  try {
    return check(value);
  } catch (error) {
    if (!(error instanceof Mismatch)) throw error;
    throw fault(name, `${error.path === "" ? "it" : `'${error.path}'`} ${error.reason}`);
  }
}

/** Error for the person about a message that cannot be read. */
export function fault(name: string, reason: string): MessageFault {
  return new MessageFault(
    `The page cannot read ${name}: ${reason}. The server may be of another version: load the page again.`,
  );
}

function wrong(value: unknown, kind: string): never {
  throw new Mismatch(value === undefined ? "is missing" : `is not ${kind}`);
}

/** A mismatch inside of a value, at one of its fields, `name`, or items, `[2]`. */
function inside(error: unknown, step: string): unknown {
  if (!(error instanceof Mismatch)) return error;
  const { path, reason } = error;
  return new Mismatch(reason, path === "" || path.startsWith("[") ? step + path : `${step}.${path}`);
}

export const text: Check<string> = (value) => (typeof value === "string" ? value : wrong(value, "a text"));

export const flag: Check<boolean> = (value) => (typeof value === "boolean" ? value : wrong(value, "true or false"));

export const number: Check<number> = (value) => (typeof value === "number" ? value : wrong(value, "a number"));

/** Number, or null, which the server writes for non-finite numbers: JSON has none. */
export const float: Check<number> = (value) => (value === null ? NaN : number(value));

export const json: Check<Json> = (value) => (value === undefined ? wrong(value, "JSON") : (value as Json));

/* @__NO_SIDE_EFFECTS__ */
export function literal<T extends string>(...words: readonly T[]): Check<T> {
  return (value) => words.find((word) => word === value) ?? wrong(value, `one of: ${words.join(", ")}`);
}

/* @__NO_SIDE_EFFECTS__ */
export function nullable<T>(check: Check<T>): Check<T | null> {
  return (value) => (value === null ? null : check(value));
}

/* @__NO_SIDE_EFFECTS__ */
export function optional<T>(check: Check<T>): Check<T> {
  return (value) => (value === undefined ? (value as T) : check(value)); // accepts a missing field
}

/* @__NO_SIDE_EFFECTS__ */
export function list<T>(check: Check<T>): Check<readonly T[]> {
  return (value) => {
    if (!Array.isArray(value)) return wrong(value, "a list");
    checkItems(value, () => check);
    return value as readonly T[];
  };
}

/* @__NO_SIDE_EFFECTS__ */
export function tuple<T extends readonly unknown[]>(...checks: { readonly [K in keyof T]: Check<T[K]> }): Check<T> {
  return (value) => {
    if (!Array.isArray(value) || value.length !== checks.length) return wrong(value, `a list of ${checks.length}`);
    checkItems(value, (index) => checks[index] ?? json);
    return value as unknown as T;
  };
}

/* @__NO_SIDE_EFFECTS__ */
export function record<T>(check: Check<T>): Check<{ readonly [name: string]: T }> {
  return (value) => {
    const object = mapping(value);
    for (const [name, entry] of Object.entries(object)) checkField(entry, check, name);
    return object as { readonly [name: string]: T };
  };
}

/** `fields` is called when the first value is checked: structs may contain each other. */
/* @__NO_SIDE_EFFECTS__ */
export function struct<T>(fields: () => { readonly [K in keyof NoInfer<T>]-?: Check<NoInfer<T>[K]> }): Check<T> {
  let checks: readonly (readonly [string, Check<unknown>])[] | null = null;
  return (value) => {
    const object = mapping(value);
    checks ??= Object.entries(fields());
    for (const [name, check] of checks) checkField(object[name], check, name);
    return object as T;
  };
}

/** One of several structs, by their tag field. */
/* @__NO_SIDE_EFFECTS__ */
export function tagged<T>(tag: string, structs: () => Readonly<Record<string, Check<NoInfer<T>>>>): Check<T> {
  let checks: Readonly<Record<string, Check<T>>> | null = null;
  return (value) => {
    const kind = checkField(mapping(value)[tag], text, tag);
    checks ??= structs();
    const check = Object.hasOwn(checks, kind) ? checks[kind] : undefined;
    if (check === undefined) throw new Mismatch(`has the unknown value '${kind}'`, tag);
    return check(value);
  };
}

/** One of several kinds of values; the last check reports the mismatch. */
/* @__NO_SIDE_EFFECTS__ */
export function oneOf<T extends readonly unknown[]>(
  ...checks: { readonly [K in keyof T]: Check<T[K]> }
): Check<T[number]> {
  return (value) => {
    let mismatch: unknown;
    for (const check of checks) {
      try {
        return check(value);
      } catch (error) {
        mismatch = error;
      }
    }
    throw mismatch;
  };
}

function checkItems(items: readonly unknown[], checkOf: (index: number) => Check<unknown>): void {
  let index = 0;
  try {
    for (; index < items.length; index++) checkOf(index)(items[index]);
  } catch (error) {
    throw inside(error, `[${index}]`);
  }
}

/** Check a field. */
function checkField<T>(value: unknown, check: Check<T>, name: string): T {
  try {
    return check(value);
  } catch (error) {
    throw inside(error, name);
  }
}

function mapping(value: unknown): Readonly<Record<string, unknown>> {
  const isMapping = typeof value === "object" && value !== null && !Array.isArray(value);
  return isMapping ? (value as Readonly<Record<string, unknown>>) : wrong(value, "an object");
}
