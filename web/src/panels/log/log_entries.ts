/** Log entries of nodes and of the page's server, and the filters on them. */

import { seconds, type RosMessage, type RosTime } from "../../protocol/ros_types";

export const LEVELS = ["Debug", "Info", "Warn", "Error", "Fatal"] as const;
export type Level = (typeof LEVELS)[number];

export interface LogEntry {
  readonly id: number;
  /** ROS time [s]; null for a notice of the server. */
  readonly time: number | null;
  readonly level: Level;
  readonly node: string;
  readonly text: string;
  readonly file: string;
  readonly line: number;
  readonly function: string;
}

export interface LogFilter {
  readonly levels: ReadonlySet<Level>;
  /** Part of a node's name. */
  readonly node: string;
  /** Part of the text, or a regular expression between slashes. */
  readonly text: string;
}

/** Entry of a `rosgraph_msgs/Log`. */
export function entryOf(id: number, message: RosMessage): LogEntry {
  const header = message["header"] as { readonly stamp?: RosTime } | undefined;
  const text = (field: string): string => (typeof message[field] === "string" ? message[field] : "");
  return {
    id,
    time: header?.stamp === undefined ? 0 : seconds(header.stamp),
    level: levelOf(Number(message["level"])),
    node: text("name"),
    text: text("msg"),
    file: text("file"),
    line: Number(message["line"]),
    function: text("function"),
  };
}

/** rosgraph_msgs/Log: 1, 2, 4, 8, 16. */
function levelOf(bits: number): Level {
  return LEVELS[Math.min(4, Math.max(0, Math.round(Math.log2(bits))))] ?? "Info";
}

/** Entries that pass a filter, in order. */
export function filtered(entries: readonly LogEntry[], filter: LogFilter): readonly LogEntry[] {
  const node = filter.node.trim().toLowerCase();
  const matches = textMatcher(filter.text);
  return entries.filter(
    (entry) => filter.levels.has(entry.level) && entry.node.toLowerCase().includes(node) && matches(entry.text),
  );
}

/** A test for a part of a text in any case, or for `/expression/`. */
function textMatcher(query: string): (text: string) => boolean {
  const expression = /^\/(.+)\/$/.exec(query.trim())?.[1];
  if (expression !== undefined) {
    try {
      const compiled = new RegExp(expression, "i");
      return (text) => compiled.test(text);
    } catch {
      return () => false; // an unfinished expression matches nothing
    }
  }
  const part = query.trim().toLowerCase();
  return (text) => text.toLowerCase().includes(part);
}
