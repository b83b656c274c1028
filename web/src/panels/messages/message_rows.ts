/** Rows of a message as an expandable tree. */

import { nanoseconds, type RosMessage, type RosValue } from "../../protocol/ros_types";
import { elementNames, isList, isMessage, isTime } from "./field_path";
import { exact, significant, timeText } from "./format";
import { unitOf } from "./units";

export interface MessageRow {
  /** Path below the message: `.pose.position.x`, `.ranges[3]`. */
  readonly key: string;
  readonly depth: number;
  readonly name: string;
  readonly text: string;
  readonly unit: string;
  /** Undefined: no children. */
  readonly open: boolean | undefined;
}

const CHUNK = 100;
const SHOWN = 4;
const LONGEST_TEXT = 2000;

/** Rows of a message of a type, with the parts of those that `isOpen` accepts. */
export function messageRows(
  type: string,
  message: RosMessage,
  isOpen: (key: string, depth: number) => boolean,
): readonly MessageRow[] {
  const rows: MessageRow[] = [];
  const add = (key: string, name: string, value: RosValue, fields: readonly string[], depth: number): void => {
    const parts = partsOf(value);
    const open = parts ? isOpen(key, depth) : undefined;
    rows.push({
      key,
      depth,
      name,
      open,
      text: valueText(value),
      unit: parts ? "" : unitIn(type, message, fields, value),
    });
    if (parts && open === true) addParts(key, value, fields, depth + 1);
  };
  const addParts = (key: string, value: RosValue, fields: readonly string[], depth: number): void => {
    if (isList(value)) addList(key, value, fields, depth);
    else if (isMessage(value)) {
      for (const [name, part] of Object.entries(value)) {
        const names = isList(part) ? elementNames(value, part) : null;
        if (names === null || name === "name") add(`${key}.${name}`, name, part, [...fields, name], depth);
        else addNamed(`${key}.${name}`, name, part, names, [...fields, name], depth);
      }
    }
  };
  const addNamed = (
    key: string,
    name: string,
    list: RosValue,
    names: readonly string[],
    fields: readonly string[],
    depth: number,
  ): void => {
    const open = isOpen(key, depth);
    rows.push({ key, depth, name, open, text: valueText(list), unit: "" });
    if (!open || !isList(list)) return;
    list.forEach((element: RosValue, index: number) =>
      add(`${key}[${index}]`, names[index] ?? `[${index}]`, element, fields, depth + 1),
    );
  };
  const addList = (key: string, list: readonly RosValue[], fields: readonly string[], depth: number): void => {
    if (list.length <= CHUNK) {
      list.forEach((element, index) => add(`${key}[${index}]`, `[${index}]`, element, fields, depth));
      return;
    }
    for (let first = 0; first < list.length; first += CHUNK) {
      const last = Math.min(list.length, first + CHUNK) - 1;
      const chunk = `${key}[${first}…${last}]`;
      const open = isOpen(chunk, depth);
      rows.push({ key: chunk, depth, name: `[${first} … ${last}]`, open, text: "", unit: "" });
      if (!open) continue;
      for (let index = first; index <= last; index += 1) {
        const element = list[index];
        if (element !== undefined) add(`${key}[${index}]`, `[${index}]`, element, fields, depth + 1);
      }
    }
  };
  addParts("", message, [], 0);
  return rows;
}

function partsOf(value: RosValue): boolean {
  if (isList(value)) return value.length > 0;
  return isMessage(value) && !isTime(value) && Object.keys(value).length > 0;
}

/** Value on one line: times in seconds, a long array by its length and first elements. */
export function valueText(value: RosValue): string {
  if (typeof value === "string") return value.length > LONGEST_TEXT ? `${value.slice(0, LONGEST_TEXT)}…` : value;
  if (typeof value === "number" || typeof value === "bigint") return exact(value);
  if (typeof value === "boolean") return String(value);
  if (value instanceof Uint8Array && value.length > CHUNK) return `${value.length} bytes`;
  if (isList(value)) return listText(value);
  if (isTime(value)) return rosTimeText(value);
  return isHeader(value) ? headerText(value) : "";
}

/** True for a std_msgs/Header, which stays closed: its own row shows stamp and frame. */
function isHeader(value: RosValue): value is RosMessage {
  return isMessage(value) && "seq" in value && "stamp" in value && "frame_id" in value;
}

function headerText({ stamp, frame_id: frame }: RosMessage): string {
  const time = stamp !== undefined && isTime(stamp) ? timeText(Number(nanoseconds(stamp)) / 1e9) : "";
  return typeof frame === "string" && frame !== "" ? `${time} in ${frame}` : time;
}

function listText(list: readonly RosValue[]): string {
  if (list.length === 0) return "[]";
  const first = [...list.slice(0, SHOWN)];
  if (first.some((element) => typeof element === "object")) return `${list.length} elements`;
  const texts = first
    .map((element) => (typeof element === "number" ? significant(element, 6) : valueText(element)))
    .join(", ");
  return list.length > SHOWN ? `[${texts}, …] ${list.length} elements` : `[${texts}]`;
}

function rosTimeText(time: { readonly sec: number; readonly nsec: number }): string {
  if (time.sec === 0 && time.nsec === 0) return "0";
  const exactly = `${time.sec}.${String(time.nsec).padStart(9, "0")} s`;
  const readable = timeText(Number(nanoseconds(time)) / 1e9);
  return time.sec < 60 ? exactly : `${exactly}  (${readable})`;
}

function unitIn(type: string, message: RosMessage, fields: readonly string[], value: RosValue): string {
  if (typeof value !== "number") return "";
  const isJoint = type === "sensor_msgs/JointState" && message["name"] !== undefined;
  return isJoint ? "" : unitOf(type, fields);
}
