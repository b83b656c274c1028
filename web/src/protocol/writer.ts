/** Writer of ROS 1 messages. */

import type { RosMessage, RosValue } from "./ros_types";
import { PRIMITIVES, type Field, type Primitive, type Schema } from "./schema";

const INTEGERS = {
  int8: [-(2n ** 7n), 2n ** 7n - 1n],
  uint8: [0n, 2n ** 8n - 1n],
  int16: [-(2n ** 15n), 2n ** 15n - 1n],
  uint16: [0n, 2n ** 16n - 1n],
  int32: [-(2n ** 31n), 2n ** 31n - 1n],
  uint32: [0n, 2n ** 32n - 1n],
  int64: [-(2n ** 63n), 2n ** 63n - 1n],
  uint64: [0n, 2n ** 64n - 1n],
} as const;

type Integer = keyof typeof INTEGERS;

const text = new TextEncoder();

/** Write a message; absent fields are zero or empty. Throws an Error whose message is a sentence. */
export function writeMessage(schema: Schema, message: RosMessage): Uint8Array<ArrayBuffer> {
  const writer = new Writer();
  writer.message(schema, message, schema.name);
  return writer.written();
}

class Writer {
  #offset = 0;
  #view = new DataView(new ArrayBuffer(256));

  written(): Uint8Array<ArrayBuffer> {
    return new Uint8Array(this.#view.buffer.slice(0, this.#offset));
  }

  message(schema: Schema, value: RosValue | undefined, path: string): void {
    if (value !== undefined && (typeof value !== "object" || isList(value))) throw mismatch(path, schema.name, value);
    const known = new Set(schema.fields.map((field) => field.name));
    for (const name of Object.keys(value ?? {})) {
      if (!known.has(name)) throw new Error(`${path} has no field '${name}'; fields: ${[...known].join(", ")}`);
    }
    for (const field of schema.fields) {
      this.#field(field, ownProperty(value, field.name), `${path}.${field.name}`);
    }
  }

  #field(field: Field, value: RosValue | undefined, path: string): void {
    if (field.length === null) {
      this.#one(field.type, value, path);
      return;
    }
    if (value !== undefined && !isList(value)) throw mismatch(path, "an array", value);
    const values: ArrayLike<RosValue> = value ?? [];
    if (field.length === "any") this.#integer("uint32", BigInt(values.length));
    else if (value !== undefined && values.length !== field.length) {
      throw new Error(`${path} has ${String(field.length)} elements, not ${String(values.length)}`);
    }
    const count = field.length === "any" ? values.length : field.length;
    for (let i = 0; i < count; i++) this.#one(field.type, values[i], `${path}[${String(i)}]`);
  }

  #one(type: Primitive | Schema, value: RosValue | undefined, path: string): void {
    if (typeof type !== "string") this.message(type, value, path);
    else if (type === "string") this.#string(value ?? "", path);
    else if (type === "time" || type === "duration") this.#time(type, value, path);
    else if (type === "bool") this.#integer("uint8", this.#bool(value ?? false, path));
    else if (type === "float32" || type === "float64") this.#float(type, value ?? 0, path);
    else this.#integer(type, inRange(type, value ?? 0, path));
  }

  #bool(value: RosValue, path: string): bigint {
    if (typeof value !== "boolean") throw mismatch(path, "a bool", value);
    return value ? 1n : 0n;
  }

  #time(type: "time" | "duration", value: RosValue | undefined, path: string): void {
    if (value !== undefined && (typeof value !== "object" || isList(value))) throw mismatch(path, `a ${type}`, value);
    const part: Integer = type === "time" ? "uint32" : "int32";
    for (const name of ["sec", "nsec"]) {
      this.#integer(part, inRange(part, ownProperty(value, name) ?? 0, `${path}.${name}`));
    }
  }

  #string(value: RosValue, path: string): void {
    if (typeof value !== "string") throw mismatch(path, "a string", value);
    const bytes = text.encode(value);
    this.#integer("uint32", BigInt(bytes.length));
    const at = this.#take(bytes.length);
    new Uint8Array(this.#view.buffer).set(bytes, at);
  }

  #float(type: "float32" | "float64", value: RosValue, path: string): void {
    if (typeof value !== "number") throw mismatch(path, "a number", value);
    const at = this.#take(PRIMITIVES[type]);
    if (type === "float32") this.#view.setFloat32(at, value, true);
    else this.#view.setFloat64(at, value, true);
  }

  #integer(type: Integer, value: bigint): void {
    const size = PRIMITIVES[type];
    const at = this.#take(size);
    if (size === 1) this.#view.setUint8(at, Number(BigInt.asUintN(8, value)));
    else if (size === 2) this.#view.setUint16(at, Number(BigInt.asUintN(16, value)), true);
    else if (size === 4) this.#view.setUint32(at, Number(BigInt.asUintN(32, value)), true);
    else this.#view.setBigUint64(at, BigInt.asUintN(64, value), true);
  }

  /** Reserve some bytes; returns their offset. */
  #take(bytes: number): number {
    const at = this.#offset;
    this.#offset += bytes;
    if (this.#offset > this.#view.byteLength) {
      const larger = new Uint8Array(Math.max(2 * this.#view.byteLength, this.#offset));
      larger.set(new Uint8Array(this.#view.buffer));
      this.#view = new DataView(larger.buffer);
    }
    return at;
  }
}

function isList(value: RosValue): value is Extract<RosValue, ArrayLike<unknown>> & object {
  return Array.isArray(value) || ArrayBuffer.isView(value);
}

function ownProperty(value: object | undefined, name: string): RosValue | undefined {
  return value !== undefined && Object.hasOwn(value, name) ? (value as RosMessage)[name] : undefined;
}

function inRange(type: Integer, value: RosValue, path: string): bigint {
  const whole = typeof value === "bigint" || (typeof value === "number" && Number.isInteger(value));
  if (!whole) throw mismatch(path, `an ${type}`.replace("an u", "a u"), value);
  const [lowest, highest] = INTEGERS[type];
  const integer = BigInt(value);
  if (integer < lowest || integer > highest) throw new Error(`${path}: ${String(value)} does not fit ${type}`);
  return integer;
}

function mismatch(path: string, expected: string, value: RosValue): Error {
  const shown = typeof value === "object" ? (isList(value) ? "an array" : "an object") : JSON.stringify(String(value));
  return new Error(`${path} is ${expected}, not ${shown}`);
}
