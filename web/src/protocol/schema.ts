/** Definitions of ROS 1 messages, as the reader and the writer interpret them. */

import { parse } from "@foxglove/rosmsg";

/** Primitive types and their size [bytes]; of a string the minimum. */
export const PRIMITIVES = {
  bool: 1,
  int8: 1,
  uint8: 1,
  int16: 2,
  uint16: 2,
  int32: 4,
  uint32: 4,
  int64: 8,
  uint64: 8,
  float32: 4,
  float64: 8,
  string: 4,
  time: 8,
  duration: 8,
} as const;

export type Primitive = keyof typeof PRIMITIVES;

export interface Field {
  readonly name: string;
  readonly type: Primitive | Schema;
  /** null: a single value; "any": an array of variable length; otherwise the length of the array. */
  readonly length: null | "any" | number;
}

export interface Schema {
  /** Datatype, as `sensor_msgs/LaserScan`. */
  readonly name: string;
  readonly fields: readonly Field[];
  /** Smallest size of a message [bytes]. */
  readonly minimum: number;
}

type Definition = ReturnType<typeof parse>[number];

/**
 * Parse the full text of a definition: that of `name`, then those of the types in it, each after a line of `=` and
 * `MSG: its name`. Throws an Error whose message is a sentence.
 */
export function parseSchema(name: string, text: string): Schema {
  const [root = { definitions: [] }, ...others] = parseText(name, text);
  const definitions = new Map<string, Definition>([[name, root]]);
  for (const other of others) if (other.name !== undefined) definitions.set(other.name, other);
  const done = new Map<string, Schema>();
  const open = new Set<string>();

  function schemaOf(type: string, definition: Definition): Schema {
    const known = done.get(type);
    if (known !== undefined) return known;
    if (open.has(type)) throw new Error(`the definition of ${name} is wrong: ${type} contains itself`);
    open.add(type);
    const fields = definition.definitions
      .filter((field) => field.isConstant !== true)
      .map(
        (field): Field => ({
          name: field.name,
          type: field.isComplex === true ? nested(field.type, type) : primitive(field.type),
          length: field.isArray === true ? (field.arrayLength ?? "any") : null,
        }),
      );
    open.delete(type);
    const schema = { name: type, fields, minimum: fields.reduce((sum, field) => sum + minimumOf(field), 0) };
    done.set(type, schema);
    return schema;
  }

  function nested(type: string, owner: string): Schema {
    const full = type.includes("/") ? type : type === "Header" ? "std_msgs/Header" : `${packageOf(owner)}/${type}`;
    const definition = definitions.get(full);
    if (definition === undefined) throw new Error(`the definition of ${name} lacks that of ${full}`);
    return schemaOf(full, definition);
  }

  function primitive(type: string): Primitive {
    if (!Object.hasOwn(PRIMITIVES, type)) throw new Error(`the definition of ${name} has the unknown type ${type}`);
    return type as Primitive;
  }

  return schemaOf(name, root);
}

function parseText(name: string, text: string): readonly Definition[] {
  try {
    return parse(text, { skipTypeFixup: true });
  } catch (error) {
    const first = (error instanceof Error ? error.message : String(error)).split("\n", 1)[0];
    throw new Error(`the definition of ${name} cannot be read: ${first ?? ""}`, { cause: error });
  }
}

function packageOf(type: string): string {
  return type.slice(0, type.indexOf("/"));
}

function minimumOf(field: Field): number {
  if (field.length === "any") return 4;
  const size = typeof field.type === "string" ? PRIMITIVES[field.type] : field.type.minimum;
  return size * (field.length ?? 1);
}
