/** Merges values into a YAML document and keeps all else: unknown keys, order, comments. */

import { isMap, isScalar, isSeq, Scalar, type Document, type Node, type YAMLMap, type YAMLSeq } from "yaml";

import { isMapping, type Yaml, type YamlMapping } from "./properties";

/** Node of a value: the old one changed in place if it fits, otherwise a new one. */
export function merge(document: Document, old: unknown, value: Yaml): Node {
  if (isMapping(value) && isMap(old)) return mergeMapping(document, old, value);
  if (Array.isArray(value) && isSeq(old)) return mergeSequence(document, old, value as readonly Yaml[]);
  if (isMap(old) && old.has("Value") && !isMapping(value) && !Array.isArray(value)) {
    return mergeMapping(document, old, { Value: value }); // a topic of ROS 2: only its name is ours
  }
  if (isScalar(old) && isSame(old, value)) return old;
  if (isScalar(old) && !isMapping(value) && !Array.isArray(value)) return replaceScalar(old, value);
  return document.createNode(value);
}

function mergeMapping(document: Document, old: YAMLMap, value: YamlMapping): YAMLMap {
  for (const [key, entry] of Object.entries(value)) {
    const node: unknown = old.get(key, true);
    if (isScalar(node) && shortName(node.value) === shortName(entry)) continue;
    const merged = merge(document, node, entry);
    if (merged !== node) old.set(key, merged);
  }
  return old;
}

function mergeSequence(document: Document, old: YAMLSeq, value: readonly Yaml[]): YAMLSeq {
  const left = [...old.items];
  const take = (index: number): unknown => (index < 0 ? undefined : left.splice(index, 1)[0]);
  old.items = value.map((entry) => merge(document, take(findEntry(left, entry)), entry));
  if (old.items.length > 0) old.flow = false;
  return old;
}

/** Index of the old entry of the same class and name, else of the first entry of the same class. */
function findEntry(old: readonly unknown[], entry: Yaml): number {
  if (!isMapping(entry)) return old.findIndex((node) => isScalar(node) && isSame(node, entry));
  const matches = (node: unknown, keys: readonly string[]): boolean =>
    isMap(node) && keys.every((key) => shortName(node.get(key)) === shortName(entry[key]));
  const exact = old.findIndex((node) => matches(node, ["Class", "Name"]));
  return exact >= 0 ? exact : old.findIndex((node) => matches(node, ["Class"]));
}

/** Class name without its package: `rviz/Grid` and `rviz_default_plugins/Grid` are one class. */
function shortName(name: unknown): unknown {
  if (typeof name !== "string") return name;
  return name
    .replace(/^(rviz|rviz_default_plugins|rviz_common)\//, "")
    .replace(/ \((rviz|rviz_default_plugins)\)$/, "");
}

/** True if a scalar has the value in any spelling: `0.030` is 0.03, and `~` an empty text. */
function isSame(node: Scalar, value: Yaml): boolean {
  if (node.value === value) return true;
  if (node.value === null && value === "") return true;
  return typeof node.value === "number" && typeof value === "string" && node.source === value;
}

function replaceScalar(old: Scalar, value: Yaml): Scalar {
  const fresh = new Scalar(value);
  fresh.comment = old.comment ?? null;
  fresh.commentBefore = old.commentBefore ?? null;
  return fresh;
}
