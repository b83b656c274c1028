/** The world's tree as its panel shows it: models with links, sensors, joints and plugins, and lights. */

import type { JointInfo, LinkInfo, Manifest, ModelInfo, PluginInfo } from "../protocol/generated/page_messages";
import { count, fixed } from "../theme/format";
import type { IconName } from "../theme/icons";
import type { PluginOwner, Selection } from "./page";

export interface WorldNode {
  readonly key: string;
  readonly label: string;
  /** Main value; for a joint, whose value changes, the joint itself. */
  readonly detail: string | { readonly joint: JointInfo };
  readonly icon: IconName | null;
  readonly selection: Selection | null;
  /** Name in `SimulatedWorld.hidden`; null: nothing to hide. */
  readonly hides: string | null;
  readonly children: readonly WorldNode[];
}

/** Model with its full name: `outer::inner`. */
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

const NO_BODY = -1;

/** The model that the manifest names as the robot. */
export function robotOf(manifest: Manifest | null): ScopedModel | undefined {
  return allModels(manifest?.models ?? []).find(({ model }) => bodiesOf(model).includes(manifest?.robot ?? NO_BODY));
}

function scopedName(scope: string, name: string): string {
  return scope === "" || name.startsWith(`${scope}::`) ? name : `${scope}::${name}`;
}

/** Bodies of a model's links, nested ones too. */
export function bodiesOf(model: ModelInfo): readonly number[] {
  return [...model.links.map((link) => link.body), ...model.models.flatMap(bodiesOf)];
}

/** Tree of a world, under the page's title, since most worlds are called `default`. */
export function worldNode(manifest: Manifest, title = manifest.name): WorldNode {
  const lights = manifest.lights.map(({ name, type }) => leaf({ kind: "light", light: name }, name, type, "light"));
  const models = robotFirst(manifest).map((model) => modelNode(model, ""));
  const name = manifest.name === "default" ? title : manifest.name;
  const world = { kind: "world" } as const;
  return {
    ...leaf(world, name, count(manifest.models.length, "model"), "world"),
    children: [
      ...models,
      ...group("lights", "Lights", lights),
      ...group("world/plugins", "Plugins", pluginNodes(world, manifest.plugins)),
    ],
  };
}

function robotFirst(manifest: Manifest): readonly ModelInfo[] {
  const { models } = manifest;
  const isRobot = (model: ModelInfo): boolean => bodiesOf(model).includes(manifest.robot ?? NO_BODY);
  return [...models.filter(isRobot), ...models.filter((model) => !isRobot(model))];
}

function modelNode(model: ModelInfo, scope: string): WorldNode {
  const name = scopedName(scope, model.name);
  const only = model.links.length === 1 && model.models.length === 0 ? model.links[0] : undefined;
  const detail = model.static ? "static" : only === undefined ? "" : mass(only.mass);
  const selection = { kind: "model", model: name } as const;
  const key = keyOf(selection);
  return {
    ...leaf(selection, model.name, detail, "model", name),
    children: [
      ...model.models.map((nested) => modelNode(nested, name)),
      ...group(
        `${key}/links`,
        "Links",
        model.links.map((link) => linkNode(name, link)),
      ),
      ...group(
        `${key}/joints`,
        "Joints",
        model.joints.map((joint) => jointNode(name, joint)),
      ),
      ...group(`${key}/plugins`, "Plugins", pluginNodes(selection, model.plugins)),
    ],
  };
}

function linkNode(model: string, link: LinkInfo): WorldNode {
  const selection = { model, link: link.name };
  const sensors = link.sensors.map(({ name, type, rate, plugins }) => {
    const sensor = { kind: "sensor", ...selection, sensor: name } as const;
    return {
      ...leaf(sensor, name, rate > 0 ? `${fixed(rate, 0)} Hz` : type, sensorIcon(type)),
      children: pluginNodes(sensor, plugins),
    };
  });
  return {
    ...leaf({ kind: "link", ...selection }, link.name, mass(link.mass), "link", `${model}::${link.name}`),
    children: sensors,
  };
}

export function sensorIcon(type: string): IconName {
  return /camera|depth/.test(type) ? "camera" : "sensor";
}

function jointNode(model: string, joint: JointInfo): WorldNode {
  return leaf(
    { kind: "joint", model, joint: joint.name },
    joint.name,
    joint.index === null ? joint.type : { joint },
    "joint",
  );
}

function pluginNodes(of: PluginOwner, plugins: readonly PluginInfo[]): readonly WorldNode[] {
  return plugins.map(({ name, filename }) => leaf({ kind: "plugin", of, plugin: name }, name, filename, "plugin"));
}

function leaf(
  selection: Selection,
  label: string,
  detail: WorldNode["detail"],
  icon: IconName,
  hides: string | null = null,
): WorldNode {
  return { key: keyOf(selection), label, detail, icon, selection, hides, children: [] };
}

function group(key: string, label: string, children: readonly WorldNode[]): WorldNode[] {
  if (children.length === 0) return [];
  return [{ key, label, detail: String(children.length), icon: null, selection: null, hides: null, children }];
}

function mass(kilograms: number): string {
  return kilograms > 0 ? `${fixed(kilograms, kilograms < 0.1 ? 3 : 2)} kg` : "";
}

/** Visible node and its depth. */
export interface VisibleNode {
  readonly node: WorldNode;
  readonly depth: number;
  readonly isOpen: boolean | undefined;
}

/** Visible nodes: children of open ones, or those that match a search and their ancestors. */
export function visibleNodes(
  root: WorldNode,
  isOpen: (node: WorldNode) => boolean,
  search: string,
  depth = 0,
): readonly VisibleNode[] {
  const query = search.trim().toLowerCase();
  if (query !== "" && !matches(root, query)) return [];
  const isMatch = query !== "" && root.label.toLowerCase().includes(query);
  const open = root.children.length === 0 ? undefined : query !== "" && !isMatch ? true : isOpen(root);
  const below =
    open === true
      ? root.children.flatMap((child) => visibleNodes(child, isOpen, isMatch ? "" : search, depth + 1))
      : [];
  return [{ node: root, depth, isOpen: open }, ...below];
}

function matches(node: WorldNode, query: string): boolean {
  return node.label.toLowerCase().includes(query) || node.children.some((child) => matches(child, query));
}

/** Nodes from the root to the one with a key; empty: there is none. */
export function pathTo(root: WorldNode, key: string): readonly WorldNode[] {
  if (root.key === key) return [root];
  for (const child of root.children) {
    const path = pathTo(child, key);
    if (path.length > 0) return [root, ...path];
  }
  return [];
}

/** Key of a selection's node; "": none. */
export function keyOf(selection: Selection | null): string {
  switch (selection?.kind) {
    case "world":
      return "world";
    case "light":
      return `light/${selection.light}`;
    case "model":
      return `model/${selection.model}`;
    case "link":
      return `link/${selection.model}/${selection.link}`;
    case "joint":
      return `joint/${selection.model}/${selection.joint}`;
    case "sensor":
      return `link/${selection.model}/${selection.link}/${selection.sensor}`;
    case "plugin":
      return `${keyOf(selection.of)}/plugin/${selection.plugin}`;
    default:
      return "";
  }
}
