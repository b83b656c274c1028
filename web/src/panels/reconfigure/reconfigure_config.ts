/** Messages of dynamic_reconfigure: ConfigDescription, Config and the request of set_parameters. */

import type { RosMessage, RosValue } from "../../protocol/ros_types";
import { isList, isMessage } from "../messages/field_path";
import { parseLiteral } from "./python_literal";

export type OptionValue = number | boolean | string;

interface Choice {
  readonly name: string;
  readonly value: OptionValue;
  readonly description: string;
}

export interface Option {
  readonly name: string;
  readonly type: "int" | "double" | "bool" | "str";
  readonly description: string;
  readonly choices: readonly Choice[];
  readonly lower: number | null;
  readonly upper: number | null;
  readonly initial: OptionValue | undefined;
}

export interface OptionGroup {
  readonly name: string;
  readonly id: number;
  readonly parent: number;
  readonly options: readonly Option[];
}

export type OptionValues = ReadonlyMap<string, OptionValue>;

/** Lists of a Config by option type; its values carry `name` and `value`. */
const LISTS = { bool: "bools", int: "ints", str: "strs", double: "doubles" } as const;
const LARGEST_RANGE = 1e6;

/** Values of a `dynamic_reconfigure/Config`. */
export function configValues(config: RosValue | undefined): OptionValues {
  const values = new Map<string, OptionValue>();
  for (const list of Object.values(LISTS)) {
    for (const entry of messages(config, list)) {
      const value = entry["value"];
      if (typeof value === "number" || typeof value === "boolean" || typeof value === "string") {
        values.set(text(entry, "name"), list === "bools" ? Boolean(value) : value);
      }
    }
  }
  return values;
}

/** Groups of a `dynamic_reconfigure/ConfigDescription`, each with its options and their limits. */
export function describedGroups(description: RosMessage): readonly OptionGroup[] {
  const lower = configValues(description["min"]);
  const upper = configValues(description["max"]);
  const initial = configValues(description["dflt"]);
  return messages(description, "groups").map((group) => ({
    name: text(group, "name"),
    id: Number(group["id"] ?? 0),
    parent: Number(group["parent"] ?? 0),
    options: messages(group, "parameters").map((option) => {
      const name = text(option, "name");
      return {
        name,
        type: optionType(text(option, "type")),
        description: text(option, "description"),
        choices: choicesOf(text(option, "edit_method")),
        lower: limit(lower.get(name)),
        upper: limit(upper.get(name)),
        initial: initial.get(name),
      };
    }),
  }));
}

/** The request of `set_parameters` that sets one option. */
export function setRequest(option: Option, value: OptionValue): RosMessage {
  const lists = Object.fromEntries([...Object.values(LISTS), "groups"].map((list): [string, RosValue] => [list, []]));
  return { config: { ...lists, [LISTS[option.type]]: [{ name: option.name, value }] } };
}

/** True if the limits are narrow enough for a slider. */
export function hasSlider(option: Option): boolean {
  const { lower, upper } = option;
  return lower !== null && upper !== null && upper > lower && upper - lower <= LARGEST_RANGE;
}

function optionType(name: string): Option["type"] {
  return name === "int" || name === "bool" || name === "str" ? name : "double";
}

function choicesOf(method: string): readonly Choice[] {
  const literal = method === "" ? undefined : parseLiteral(method);
  if (typeof literal !== "object" || literal === null || !("enum" in literal)) return [];
  const list = literal.enum;
  if (!Array.isArray(list)) return [];
  return list.flatMap((entry: unknown) => {
    const { name, value, description } = entry as { name?: unknown; value?: unknown; description?: unknown };
    if (
      typeof name !== "string" ||
      !(typeof value === "number" || typeof value === "string" || typeof value === "boolean")
    )
      return [];
    return [{ name, value, description: typeof description === "string" ? description : "" }];
  });
}

function limit(value: OptionValue | undefined): number | null {
  return typeof value === "number" && Number.isFinite(value) ? value : null;
}

function text(message: RosMessage, field: string): string {
  const value = message[field];
  return typeof value === "string" ? value : "";
}

function messages(owner: RosValue | undefined, field: string): readonly RosMessage[] {
  if (owner === undefined || !isMessage(owner)) return [];
  const list = owner[field];
  return list !== undefined && isList(list) ? list.filter(isMessage) : [];
}
