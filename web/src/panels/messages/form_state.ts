/** Values typed into a form made from a definition. */

import { signal } from "@preact/signals";

import type { RosMessage, RosValue } from "../../protocol/ros_types";
import type { Field, MessageType } from "./definition";
import { emptyMessage, emptyValues, messageFromText, valueFromText, ValueError } from "./values";

/** Largest number of values in a form. */
const MAX_VALUES = 100_000;

/** A row of the form: a field that takes a value, or the heading of a message's fields. */
export interface FormRow {
  /** `pose.position.x`. */
  readonly path: string;
  readonly depth: number;
  readonly field: Field;
  /** The definition that the field is read with. */
  readonly type: MessageType;
  readonly isHeading: boolean;
  /** Text of the value while nothing is typed. */
  readonly initial: string;
}

export interface Built {
  readonly message: RosMessage;
  /** Sentences by the path of their row. */
  readonly faults: ReadonlyMap<string, string>;
}

export class FormState {
  readonly texts = signal<ReadonlyMap<string, string>>(new Map());
  readonly rows: readonly FormRow[];

  /** Throws an Error with a sentence where the type holds too much for a form. */
  constructor(readonly type: MessageType) {
    if (!(emptyValues(type) <= MAX_VALUES))
      throw new Error(`It holds more than ${MAX_VALUES.toLocaleString("en")} values, too many for a form.`);
    this.rows = formRows(type, "", 0);
  }

  text(row: FormRow): string {
    return this.texts.value.get(row.path) ?? row.initial;
  }

  set(path: string, text: string): void {
    this.texts.value = new Map(this.texts.peek()).set(path, text);
  }

  /** Error sentence if a text does not fit its row; null: it fits. */
  fault(row: FormRow, text: string): string | null {
    try {
      valueFromText(row.type, row.field, text, 0n);
      return null;
    } catch (error) {
      if (error instanceof ValueError) return error.message;
      throw error;
    }
  }

  /** Load a whole message from YAML; returns a sentence if it does not fit. */
  load(yaml: string): string | null {
    try {
      const message = messageFromText(this.type, yaml, 0n);
      const texts = new Map<string, string>();
      for (const row of this.rows) if (!row.isHeading) texts.set(row.path, textOf(at(message, row.path)));
      this.texts.value = texts;
      return null;
    } catch (error) {
      if (error instanceof ValueError) return error.message;
      throw error;
    }
  }

  /** Build the message; `now` [ns] replaces `now` in times. */
  build(now: bigint): Built {
    const faults = new Map<string, string>();
    const texts = this.texts.peek();
    const part = (type: MessageType, prefix: string): RosMessage => {
      const message: Record<string, RosValue> = { ...emptyMessage(type) };
      for (const field of type.root.fields) {
        const path = prefix === "" ? field.name : `${prefix}.${field.name}`;
        if (field.isComplex && !field.isArray) message[field.name] = part(type.within(field.type), path);
        const text = texts.get(path);
        if (text === undefined) continue;
        try {
          message[field.name] = valueFromText(type, field, text, now);
        } catch (error) {
          if (!(error instanceof ValueError)) throw error;
          faults.set(path, error.message);
        }
      }
      return message;
    };
    return { message: part(this.type, ""), faults };
  }
}

function formRows(type: MessageType, prefix: string, depth: number): readonly FormRow[] {
  return type.root.fields.flatMap((field) => {
    const path = prefix === "" ? field.name : `${prefix}.${field.name}`;
    const isHeading = field.isComplex && !field.isArray;
    const row = { path, depth, field, type, isHeading, initial: isHeading ? "" : textOf(initialOf(type, field)) };
    return isHeading ? [row, ...formRows(type.within(field.type), path, depth + 1)] : [row];
  });
}

function initialOf(type: MessageType, field: Field): RosValue | undefined {
  return emptyMessage(type)[field.name];
}

function at(message: RosMessage, path: string): RosValue | undefined {
  let value: RosValue | undefined = message;
  for (const name of path.split(".")) value = (value as RosMessage | undefined)?.[name];
  return value;
}

/** A value as YAML on one line. */
function textOf(value: RosValue | undefined): string {
  if (value === undefined) return "";
  if (typeof value === "string") return value;
  return flow(value);
}

function flow(value: RosValue): string {
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value !== "object") return String(value);
  if (Array.isArray(value) || ArrayBuffer.isView(value))
    return `[${Array.from(value as ArrayLike<RosValue>, flow).join(", ")}]`;
  const message = value as RosMessage;
  const { sec, nsec } = message;
  if (typeof sec === "number" && typeof nsec === "number") {
    return nsec === 0 ? String(sec) : `${sec}.${String(nsec).padStart(9, "0").replace(/0+$/, "")}`;
  }
  return `{${Object.entries(message)
    .map(([name, part]) => `${name}: ${flow(part)}`)
    .join(", ")}}`;
}
