/** Parameters as the tree of their namespaces. */

import type { ParameterValue } from "../../protocol/connection";
import { parseJson } from "../../protocol/json";

export interface ParameterRow {
  /** Full name: `/move_base/rate`. */
  readonly name: string;
  readonly depth: number;
  readonly label: string;
  /** Undefined for a namespace. */
  readonly value: ParameterValue | undefined;
  readonly open: boolean | undefined;
}

interface Branch {
  readonly children: Map<string, Branch>;
  value: ParameterValue | undefined;
}

/** Rows of open namespaces; with a filter text, all namespaces with a match are open. */
export function parameterRows(
  parameters: ReadonlyMap<string, ParameterValue>,
  closed: ReadonlySet<string>,
  text: string,
): readonly ParameterRow[] {
  const part = text.trim().toLowerCase();
  const root: Branch = { children: new Map(), value: undefined };
  for (const [name, value] of [...parameters].sort(([one], [other]) => (one < other ? -1 : 1))) {
    if (!name.toLowerCase().includes(part)) continue;
    let branch = root;
    for (const step of name.split("/").filter((step) => step !== "")) {
      const next: Branch = branch.children.get(step) ?? { children: new Map(), value: undefined };
      branch.children.set(step, next);
      branch = next;
    }
    branch.value = value;
  }
  const rows: ParameterRow[] = [];
  const add = (branch: Branch, prefix: string, depth: number): void => {
    for (const [label, child] of branch.children) {
      const name = `${prefix}/${label}`;
      const open = child.children.size === 0 ? undefined : part !== "" || !closed.has(name);
      rows.push({ name, depth, label, value: child.value, open });
      if (open === true) add(child, name, depth + 1);
    }
  };
  add(root, "", 0);
  return rows;
}

/** A value on one line; a whole float keeps its decimal point. */
export function parameterText(value: ParameterValue, isFloat: boolean): string {
  if (typeof value === "string") return value;
  if (typeof value === "number" && isFloat && Number.isInteger(value) && Math.abs(value) < 1e15)
    return value.toFixed(1);
  if (Array.isArray(value)) return `[${value.map((entry: ParameterValue) => quoted(entry, isFloat)).join(", ")}]`;
  return typeof value === "object" ? JSON.stringify(value) : String(value);
}

function quoted(value: ParameterValue, isFloat: boolean): string {
  return typeof value === "string" ? JSON.stringify(value) : parameterText(value, isFloat);
}

/** A parameter's new value, of the old value's type; a sentence if the text does not fit the type. */
export function parameterFromText(
  old: ParameterValue,
  text: string,
  isFloat: boolean,
): { readonly value: ParameterValue } | { readonly fault: string } {
  if (typeof old === "string") return { value: text };
  const json = text
    .replace(/\bTrue\b/g, "true")
    .replace(/\bFalse\b/g, "false")
    .replace(/−/g, "-");
  let value: ParameterValue;
  try {
    value = parseJson(json);
  } catch {
    return { fault: `This must be ${kindOf(old)}.` };
  }
  if (kindOf(value) !== kindOf(old)) return { fault: `This must be ${kindOf(old)}.` };
  const isWhole = typeof old === "number" && Number.isInteger(old) && !isFloat;
  return isWhole && !Number.isInteger(value) ? { fault: "This must be a whole number." } : { value };
}

function kindOf(value: ParameterValue): string {
  if (Array.isArray(value)) return "a list, as [1, 2]";
  if (typeof value === "number") return "a number";
  if (typeof value === "boolean") return "true or false";
  return typeof value === "string" ? "a text" : 'a mapping, as {"a": 1}';
}
