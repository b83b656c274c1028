/** The world's tree as its panel shows it: models with links, sensors, joints and plugins, and lights. */

import type { JointInfo, LinkInfo, Manifest, ModelInfo } from "../../scene/simulated_world";
import { count, fixed } from "../../theme/format";
import type { IconName } from "../../theme/icons";
import type { Selection } from "../page";

export interface WorldNode {
  readonly key: string;
  readonly label: string;
  /** The one value that matters; a joint's is its index, as it changes. */
  readonly detail: string | { readonly joint: JointInfo };
  readonly icon: IconName | null;
  readonly selection: Selection | null;
  /** Name in `SimulatedWorld.hidden`; null: nothing to hide. */
  readonly hides: string | null;
  readonly children: readonly WorldNode[];
}

/** A model with its name in full: `outer::inner`. */
export interface ScopedModel {
  readonly name: string;
  readonly model: ModelInfo;
}

/** Every model, nested ones too. */
export function allModels(models: readonly ModelInfo[], scope = ""): readonly ScopedModel[] {
  return models.flatMap((model) => {
    const name = scopedName(scope, model.name);
    return [{ name, model }, ...allModels(model.models, name)];
  });
}

export function scopedName(scope: string, name: string): string {
  return scope === "" || name.startsWith(`${scope}::`) ? name : `${scope}::${name}`;
}

/** Bodies of a model's links, nested ones too. */
export function bodiesOf(model: ModelInfo): readonly number[] {
  return [...model.links.map((link) => link.body), ...model.models.flatMap(bodiesOf)];
}

/** The tree of a world; most worlds are called `default`, which says less than the page's title. */
export function worldNode(manifest: Manifest, title = manifest.name): WorldNode {
  const lights = manifest.lights.map(({ name, type }) => leaf(`light/${name}`, name, type, "light", { kind: "light", light: name }));
  const models = manifest.models.map((model) => modelNode(model, ""));
  const name = manifest.name === "default" ? title : manifest.name;
  return {
    ...leaf("world", name, count(manifest.models.length, "model"), "world", { kind: "world" }),
    children: [...models, ...group("lights", "Lights", lights)],
  };
}

function modelNode(model: ModelInfo, scope: string): WorldNode {
  const name = scopedName(scope, model.name);
  const key = `model/${name}`;
  const only = model.links.length === 1 && model.models.length === 0 ? model.links[0] : undefined;
  const detail = model.static ? "static" : only === undefined ? "" : mass(only.mass);
  const joints = model.joints.map((joint) => jointNode(name, joint));
  const plugins = model.plugins.map((plugin) => leaf(`plugin/${name}/${plugin.name}`, plugin.name, plugin.filename, "plugin"));
  return {
    ...leaf(key, model.name, detail, "model", { kind: "model", model: name }, name),
    children: [
      ...model.models.map((nested) => modelNode(nested, name)),
      ...group(`${key}/links`, "Links", model.links.map((link) => linkNode(name, link))),
      ...group(`${key}/joints`, "Joints", joints),
      ...group(`${key}/plugins`, "Plugins", plugins),
    ],
  };
}

function linkNode(model: string, link: LinkInfo): WorldNode {
  const selection: Selection = { kind: "link", model, link: link.name };
  const key = `link/${model}/${link.name}`;
  const sensors = link.sensors.map((sensor) => {
    const icon = /camera|depth/.test(sensor.type) ? "camera" : "sensor";
    return leaf(`${key}/${sensor.name}`, sensor.name, sensor.rate > 0 ? `${fixed(sensor.rate, 0)} Hz` : sensor.type, icon, selection);
  });
  return { ...leaf(key, link.name, mass(link.mass), "link", selection, `${model}::${link.name}`), children: sensors };
}

function jointNode(model: string, joint: JointInfo): WorldNode {
  const selection: Selection = { kind: "joint", model, joint: joint.name };
  return leaf(`joint/${model}/${joint.name}`, joint.name, joint.index === null ? joint.type : { joint }, "joint", selection);
}

function leaf(
  key: string,
  label: string,
  detail: WorldNode["detail"],
  icon: IconName,
  selection: Selection | null = null,
  hides: string | null = null,
): WorldNode {
  return { key, label, detail, icon, selection, hides, children: [] };
}

function group(key: string, label: string, children: readonly WorldNode[]): WorldNode[] {
  if (children.length === 0) return [];
  return [{ key, label, detail: String(children.length), icon: null, selection: null, hides: null, children }];
}

function mass(kilograms: number): string {
  return kilograms > 0 ? `${fixed(kilograms, kilograms < 0.1 ? 3 : 2)} kg` : "";
}

/** A node that is seen, and how deep it is. */
export interface SeenNode {
  readonly node: WorldNode;
  readonly depth: number;
  readonly isOpen: boolean | undefined;
}

/** Nodes that are seen: below open ones, or those that match a search and their parents. */
export function seenNodes(root: WorldNode, isOpen: (node: WorldNode) => boolean, search: string, depth = 0): readonly SeenNode[] {
  const wanted = search.trim().toLowerCase();
  if (wanted !== "" && !matches(root, wanted)) return [];
  const ownMatch = wanted !== "" && root.label.toLowerCase().includes(wanted);
  const open = root.children.length === 0 ? undefined : wanted !== "" && !ownMatch ? true : isOpen(root);
  const below = open === true ? root.children.flatMap((child) => seenNodes(child, isOpen, ownMatch ? "" : search, depth + 1)) : [];
  return [{ node: root, depth, isOpen: open }, ...below];
}

function matches(node: WorldNode, wanted: string): boolean {
  return node.label.toLowerCase().includes(wanted) || node.children.some((child) => matches(child, wanted));
}

/** Key of the node that stands for a selection. */
export function keyOf(selection: Selection | null): string | null {
  if (selection?.kind === "world") return "world";
  if (selection?.kind === "light") return `light/${selection.light}`;
  if (selection?.kind === "model") return `model/${selection.model}`;
  if (selection?.kind === "link") return `link/${selection.model}/${selection.link}`;
  return selection?.kind === "joint" ? `joint/${selection.model}/${selection.joint}` : null;
}
