/**
 * Paths to numbers: `/odom/twist/twist/linear/x` as rqt_plot writes it, `/odom.twist.twist.linear.x`,
 * `/scan/ranges[0]`, and `/joint_states/position[left_wheel]`, which finds the element by the message's `name`.
 * A joint of the simulated world is `model::joint.position`.
 */

import { seconds, type RosMessage, type RosTime, type RosValue } from "../../protocol/ros_types";

export type Step = string | { readonly index: number } | { readonly name: string };

/** A step into a field is a string, one into an array an index or a name. */
export function parseSteps(text: string): readonly Step[] | null {
  const steps: Step[] = [];
  const pattern = /[./]?([A-Za-z_]\w*)|\[(\d+)\]|\[([^\]]+)\]/y;
  while (pattern.lastIndex < text.length) {
    const match = pattern.exec(text);
    if (match === null) return null;
    const [, field, index, name] = match;
    if (field !== undefined) steps.push(field);
    else if (index !== undefined) steps.push({ index: Number(index) });
    else if (name !== undefined) steps.push({ name });
  }
  return steps;
}

export interface TopicPath {
  readonly topic: string;
  readonly steps: readonly Step[];
}

/** Split a path at the longest topic that is known; where none is, at its first `.` or `[`, or last `/`. */
export function parsePath(text: string, topics: Iterable<string>): TopicPath | null {
  const known = [...topics]
    .filter((topic) => text.startsWith(topic) && /^([./[]|$)/.test(text.slice(topic.length)))
    .sort((one, other) => other.length - one.length)[0];
  const topic = known ?? guessTopic(text);
  if (topic === null) return null;
  const steps = parseSteps(text.slice(topic.length));
  return steps === null ? null : { topic, steps };
}

function guessTopic(text: string): string | null {
  return /^(\/[\w/]+?)(?:[.[]|\/\w+$)/.exec(text)?.[1] ?? null;
}

/** The path's own spelling: dots between fields. */
export function pathText({ topic, steps }: TopicPath): string {
  return topic + stepsText(steps);
}

export function stepsText(steps: readonly Step[]): string {
  return steps
    .map((step) => (typeof step === "string" ? `.${step}` : `[${"index" in step ? step.index : step.name}]`))
    .join("");
}

export function isTime(value: RosValue): value is RosTime & RosMessage {
  return isMessage(value) && "nsec" in value && "sec" in value;
}

export function isMessage(value: RosValue): value is RosMessage {
  return typeof value === "object" && !ArrayBuffer.isView(value) && !Array.isArray(value);
}

export function isList(value: RosValue): value is readonly RosValue[] {
  return Array.isArray(value) || ArrayBuffer.isView(value);
}

/** Value at the end of a path; undefined where there is none. */
export function valueAt(message: RosMessage, steps: readonly Step[]): RosValue | undefined {
  let value: RosValue | undefined = message;
  let owner: RosMessage = message;
  for (const step of steps) {
    if (value === undefined) return undefined;
    if (typeof step === "string") {
      if (!isMessage(value)) return undefined;
      owner = value;
      value = value[step];
    } else {
      if (!isList(value)) return undefined;
      value = value["index" in step ? step.index : indexOfName(owner, step.name)];
    }
  }
  return value;
}

function indexOfName(owner: RosMessage, name: string): number {
  const names = owner["name"];
  return names !== undefined && isList(names) ? names.indexOf(name) : -1;
}

/** Number at the end of a path; times are seconds, truth is 1. Null where there is no number. */
export function numberAt(message: RosMessage, steps: readonly Step[]): number | null {
  const value = valueAt(message, steps);
  if (value === undefined) return null;
  if (typeof value === "number") return value;
  if (typeof value === "bigint" || typeof value === "boolean") return Number(value);
  return isTime(value) ? seconds(value) : null;
}

/** Names of the elements of an array, where the message names them. */
export function elementNames(owner: RosMessage, array: readonly RosValue[]): readonly string[] | null {
  const names = owner["name"];
  if (names === undefined || !isList(names) || names.length !== array.length) return null;
  return names.every((name) => typeof name === "string") ? names : null;
}
