/** Message values from text and YAML, checked against their type. */

import { parse } from "yaml";

import type { RosMessage, RosTime, RosValue } from "../../protocol/ros_types";
import type { Field, MessageType } from "./definition";

/** A value does not fit its field; the message is a sentence for the person who typed it. */
export class ValueError extends Error {}

const INTEGERS: Readonly<Record<string, readonly [bigint, bigint]>> = {
  int8: [-128n, 127n],
  uint8: [0n, 255n],
  int16: [-32768n, 32767n],
  uint16: [0n, 65535n],
  int32: [-2147483648n, 2147483647n],
  uint32: [0n, 4294967295n],
  int64: [-(2n ** 63n), 2n ** 63n - 1n],
  uint64: [0n, 2n ** 64n - 1n],
};
const NANOSECONDS = 1_000_000_000n;

export function isNumeric(type: string): boolean {
  return type === "float32" || type === "float64" || type in INTEGERS;
}

/** A message of zeros, empty texts and empty arrays, as genpy makes. */
export function emptyMessage(type: MessageType): RosMessage {
  return Object.fromEntries(type.root.fields.map((field) => [field.name, emptyValue(type, field)]));
}

/** Number of values of the empty message; infinite where a type contains itself. */
export function emptyValues(type: MessageType): number {
  const counts = new Map<string, number>();
  const countOf = (within: MessageType): number =>
    within.root.fields.reduce(
      (sum, field) => sum + (field.isArray ? (field.length ?? 0) : 1) * elementOf(within, field),
      0,
    );
  const elementOf = (within: MessageType, { isComplex, type: name }: Field): number => {
    if (!isComplex) return 1;
    const known = counts.get(name);
    if (known !== undefined) return known;
    counts.set(name, Infinity); // while counting, so that recursion ends
    const count = countOf(within.within(name));
    counts.set(name, count);
    return count;
  };
  return countOf(type);
}

function emptyValue(type: MessageType, field: Field): RosValue {
  if (!field.isArray) return emptyElement(type, field);
  return Array.from({ length: field.length ?? 0 }, () => emptyElement(type, field));
}

function emptyElement(type: MessageType, field: Field): RosValue {
  if (field.isComplex) return emptyMessage(type.within(field.type));
  if (field.type === "string") return "";
  if (field.type === "bool") return false;
  if (isTime(field.type)) return { sec: 0, nsec: 0 };
  return is64(field.type) ? 0n : 0;
}

function is64(type: string): boolean {
  return type === "int64" || type === "uint64";
}

function isTime(type: string): boolean {
  return type === "time" || type === "duration";
}

/** Value of a field from typed text; arrays and messages are YAML. */
export function valueFromText(type: MessageType, field: Field, text: string, now: bigint): RosValue {
  if (field.type === "string" && !field.isArray) return text;
  return valueFromYaml(type, field, parseYaml(text), now);
}

/** Message from YAML as `rostopic pub` takes it: a mapping of fields, or the fields in order. */
export function messageFromText(type: MessageType, text: string, now: bigint): RosMessage {
  return messageFromYaml(type, parseYaml(text), "The message", now);
}

function parseYaml(text: string): unknown {
  try {
    return parse(text, { intAsBigInt: true, maxAliasCount: 0, schema: "core" }) as unknown;
  } catch (error) {
    const [first = ""] = String(error instanceof Error ? error.message : error).split("\n");
    throw new ValueError(`This is not YAML: ${first.replace(/:$/, "")}`);
  }
}

function messageFromYaml(type: MessageType, yaml: unknown, path: string, now: bigint): RosMessage {
  const { fields } = type.root;
  const message: Record<string, RosValue> = { ...emptyMessage(type) };
  if (yaml === null) return message;
  let entries: readonly (readonly [string, unknown])[];
  if (Array.isArray(yaml)) {
    if (yaml.length !== fields.length) {
      throw new ValueError(`${path} has ${fields.length} fields, not ${yaml.length}`);
    }
    entries = fields.map((field, index) => [field.name, yaml[index]]);
  } else if (typeof yaml === "object") {
    entries = Object.entries(yaml);
  } else {
    throw new ValueError(`${path} must be a mapping of ${names(fields)}`);
  }
  for (const [name, value] of entries) {
    const field = fields.find((known) => known.name === name);
    if (field === undefined) throw new ValueError(`${path} has no field ${name}; fields here: ${names(fields)}`);
    message[name] = valueFromYaml(type, field, value, now);
  }
  return message;
}

function names(fields: readonly Field[]): string {
  return fields.map((field) => field.name).join(", ") || "none";
}

function valueFromYaml(type: MessageType, field: Field, yaml: unknown, now: bigint): RosValue {
  if (!field.isArray) return elementFromYaml(type, field, yaml, field.name, now);
  if (!Array.isArray(yaml)) throw new ValueError(`${field.name} must be a list, as [1, 2]`);
  if (field.length !== null && yaml.length !== field.length) {
    throw new ValueError(`${field.name} has ${field.length} elements, not ${yaml.length}`);
  }
  return yaml.map((element: unknown, index) => elementFromYaml(type, field, element, `${field.name}[${index}]`, now));
}

function elementFromYaml(type: MessageType, field: Field, yaml: unknown, path: string, now: bigint): RosValue {
  if (field.isComplex) return messageFromYaml(type.within(field.type), yaml, path, now);
  if (field.type === "string") return textOf(yaml, path);
  if (field.type === "bool") return boolOf(yaml, path);
  if (isTime(field.type)) return timeOf(yaml, path, now);
  const range = INTEGERS[field.type];
  if (range !== undefined) return integerOf(yaml, field.type, range, path);
  if (typeof yaml === "number" || typeof yaml === "bigint") return Number(yaml);
  throw new ValueError(`${path} must be a number`);
}

function textOf(yaml: unknown, path: string): string {
  if (typeof yaml === "string") return yaml;
  if (yaml === null) return "";
  if (typeof yaml === "number" || typeof yaml === "bigint" || typeof yaml === "boolean") return String(yaml);
  throw new ValueError(`${path} must be a text`);
}

function boolOf(yaml: unknown, path: string): boolean {
  if (typeof yaml === "boolean") return yaml;
  if (yaml === 0n || yaml === 1n) return yaml === 1n;
  throw new ValueError(`${path} must be true or false`);
}

function integerOf(yaml: unknown, type: string, [lowest, highest]: readonly [bigint, bigint], path: string): RosValue {
  const value = typeof yaml === "number" && Number.isInteger(yaml) ? BigInt(yaml) : yaml;
  if (typeof value === "boolean") return integerOf(value ? 1n : 0n, type, [lowest, highest], path);
  if (typeof value !== "bigint" || value < lowest || value > highest) {
    throw new ValueError(`${path} must be a whole number from ${lowest.toString()} to ${highest.toString()}`);
  }
  return is64(type) ? value : Number(value);
}

/** Seconds, `now`, or `{secs, nsecs}` as rostopic prints it. */
function timeOf(yaml: unknown, path: string, now: bigint): RosTime {
  if (yaml === null) return { sec: 0, nsec: 0 };
  if (yaml === "now") return { sec: Number(now / NANOSECONDS), nsec: Number(now % NANOSECONDS) };
  if (typeof yaml === "number" || typeof yaml === "bigint") {
    const sec = Math.floor(Number(yaml));
    return { sec, nsec: Math.round((Number(yaml) - sec) * 1e9) };
  }
  if (typeof yaml === "object") {
    const parts = yaml as Readonly<Record<string, unknown>>;
    const sec = parts["secs"] ?? parts["sec"] ?? 0n;
    const nsec = parts["nsecs"] ?? parts["nsec"] ?? 0n;
    if (typeof sec === "bigint" && typeof nsec === "bigint") return { sec: Number(sec), nsec: Number(nsec) };
  }
  throw new ValueError(`${path} must be seconds, or now`);
}
