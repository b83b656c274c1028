/** Reader of ROS 1 messages: interprets a schema, generates no code. */

import type { NumberArray, RosMessage, RosValue } from "./ros_types";
import { PRIMITIVES, type Field, type Primitive, type Schema } from "./schema";

/** Typed arrays; numbers of a message are little-endian, as those of every machine with a browser. */
const ARRAYS = {
  int8: Int8Array,
  uint8: Uint8Array,
  int16: Int16Array,
  uint16: Uint16Array,
  int32: Int32Array,
  uint32: Uint32Array,
  int64: BigInt64Array,
  uint64: BigUint64Array,
  float32: Float32Array,
  float64: Float64Array,
} as const;

type Numeric = keyof typeof ARRAYS;

/** Extra objects of a message beyond 8 per byte, since empty ones take no bytes. */
const MAX_EMPTY = 10_000;

/** Below this size a string is decoded without TextDecoder, whose calls are slow. */
const SHORT_STRING = 48;

const text = new TextDecoder();

/**
 * Read a message.
 *
 * Numeric arrays are views of the payload where their alignment allows, else copies. Buffers below the arrays are
 * added to `buffers`, for a transfer. Throws an Error whose message is a sentence.
 */
export function readMessage(schema: Schema, payload: DataView, buffers = new Set<ArrayBuffer>()): RosMessage {
  return new Reader(payload, buffers).message(schema);
}

class Reader {
  #offset = 0;
  /** Objects that may still be created. */
  #objects: number;
  readonly #view: DataView;
  readonly #bytes: Uint8Array;
  readonly #buffers: Set<ArrayBuffer>;

  constructor(payload: DataView, buffers: Set<ArrayBuffer>) {
    this.#view = payload;
    this.#bytes = new Uint8Array(payload.buffer, payload.byteOffset, payload.byteLength);
    this.#buffers = buffers;
    this.#objects = 8 * payload.byteLength + MAX_EMPTY;
  }

  message(schema: Schema): RosMessage {
    if (--this.#objects < 0) throw new Error(`${schema.name}: more values than a message of this size has`);
    // Field names begin with a letter, so none is __proto__; other names of Object.prototype become own properties.
    const message: Record<string, RosValue> = {};
    for (const field of schema.fields) message[field.name] = this.#field(schema, field);
    return message;
  }

  #field(schema: Schema, field: Field): RosValue {
    const { type, length } = field;
    if (length === null) return typeof type === "string" ? this.#primitive(type, schema, field) : this.message(type);
    const count = length === "any" ? this.#length(schema, field) : length;
    const size = typeof type === "string" ? PRIMITIVES[type] : type.minimum;
    this.#need(count * size, schema, field);
    if (typeof type === "string" && isNumeric(type)) return this.#numbers(type, count);
    const values: RosValue[] = [];
    for (let i = 0; i < count; i++) {
      values.push(typeof type === "string" ? this.#primitive(type, schema, field) : this.message(type));
    }
    return values;
  }

  #primitive(type: Primitive, schema: Schema, field: Field): RosValue {
    this.#need(PRIMITIVES[type], schema, field);
    if (type === "string") return this.#string(schema, field);
    const at = this.#offset;
    this.#offset += PRIMITIVES[type];
    switch (type) {
      case "bool":
        return this.#view.getUint8(at) !== 0;
      case "int8":
        return this.#view.getInt8(at);
      case "uint8":
        return this.#view.getUint8(at);
      case "int16":
        return this.#view.getInt16(at, true);
      case "uint16":
        return this.#view.getUint16(at, true);
      case "int32":
        return this.#view.getInt32(at, true);
      case "uint32":
        return this.#view.getUint32(at, true);
      case "int64":
        return this.#view.getBigInt64(at, true);
      case "uint64":
        return this.#view.getBigUint64(at, true);
      case "float32":
        return this.#view.getFloat32(at, true);
      case "float64":
        return this.#view.getFloat64(at, true);
      case "time":
        return { sec: this.#view.getUint32(at, true), nsec: this.#view.getUint32(at + 4, true) };
      case "duration":
        return { sec: this.#view.getInt32(at, true), nsec: this.#view.getInt32(at + 4, true) };
    }
  }

  #numbers(type: Numeric, count: number): NumberArray {
    const start = this.#bytes.byteOffset + this.#offset;
    const end = start + count * PRIMITIVES[type];
    this.#offset += count * PRIMITIVES[type];
    const payload = this.#bytes.buffer as ArrayBuffer;
    const aligned = start % PRIMITIVES[type] === 0;
    const buffer = aligned ? payload : payload.slice(start, end);
    if (count > 0) this.#buffers.add(buffer);
    return new ARRAYS[type](buffer, aligned ? start : 0, count);
  }

  #string(schema: Schema, field: Field): string {
    const length = this.#length(schema, field);
    this.#need(length, schema, field);
    const start = this.#offset;
    this.#offset += length;
    if (length < SHORT_STRING) {
      let short = "";
      let at = start;
      for (; at < this.#offset; at++) {
        const code = this.#view.getUint8(at);
        if (code > 0x7f) break;
        short += String.fromCharCode(code);
      }
      if (at === this.#offset) return short;
    }
    return text.decode(this.#bytes.subarray(start, this.#offset));
  }

  #length(schema: Schema, field: Field): number {
    this.#need(4, schema, field);
    const length = this.#view.getUint32(this.#offset, true);
    this.#offset += 4;
    return length;
  }

  #need(bytes: number, schema: Schema, field: Field): void {
    const left = this.#bytes.byteLength - this.#offset;
    if (bytes <= left) return;
    throw new Error(
      `${schema.name}: the field '${field.name}' takes ${String(bytes)} bytes, and the message has ${String(left)} more`,
    );
  }
}

function isNumeric(type: Primitive): type is Numeric {
  return Object.hasOwn(ARRAYS, type);
}
