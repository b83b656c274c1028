/** Definitions of message types, read from their text. */

import { parse } from "@foxglove/rosmsg";

export interface Field {
  readonly name: string;
  /** Type, as `float64` or `geometry_msgs/Point`. */
  readonly type: string;
  readonly isComplex: boolean;
  readonly isArray: boolean;
  /** Length of an array of fixed length. */
  readonly length: number | null;
}

interface Constant {
  readonly name: string;
  readonly type: string;
  readonly text: string;
}

/** Fields and constants of one type. */
export interface Definition {
  readonly fields: readonly Field[];
  readonly constants: readonly Constant[];
}

/** A type with all types that it contains. */
export class MessageType {
  private constructor(
    readonly root: Definition,
    private readonly types: ReadonlyMap<string, Definition>,
  ) {}

  /** Read a full text, as `rosmsg show` and the Foxglove protocol have it. */
  static parse(text: string): MessageType {
    const types = new Map<string, Definition>();
    let root: Definition = { fields: [], constants: [] };
    for (const { name, definitions } of parse(text)) {
      const fields: Field[] = [];
      const constants: Constant[] = [];
      for (const entry of definitions) {
        if (entry.isConstant === true) {
          constants.push({ name: entry.name, type: entry.type, text: entry.valueText ?? "" });
        } else {
          const { isComplex = false, isArray = false, arrayLength } = entry;
          fields.push({ name: entry.name, type: entry.type, isComplex, isArray, length: arrayLength ?? null });
        }
      }
      if (name === undefined) root = { fields, constants };
      else types.set(name, { fields, constants });
    }
    return new MessageType(root, types);
  }

  /** Definition of a type that this one contains. */
  of(type: string): Definition {
    const definition = this.types.get(type);
    if (definition === undefined) throw new Error(`The definition lacks ${type}`);
    return definition;
  }

  /** The same types with another as root. */
  within(type: string): MessageType {
    return new MessageType(this.of(type), this.types);
  }
}
