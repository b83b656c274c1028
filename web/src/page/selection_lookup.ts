/** Lookup of a selection's object in the world. */

import type { JointInfo, LinkInfo, ModelInfo, PluginInfo, SensorInfo } from "../protocol/generated/page_messages";
import { bodiesOfPart } from "../scene/draft";
import type { Page, PluginOwner, Selection } from "./page";
import { allModels, bodiesOf } from "./world_nodes";

export function findModel(page: Pick<Page, "world">, name: string): ModelInfo | null {
  return allModels(page.world.manifest.value?.models ?? []).find((entry) => entry.name === name)?.model ?? null;
}

export function findLink(page: Pick<Page, "world">, model: string, link: string): LinkInfo | null {
  const scoped = `${model}::${link}`; // a joint's child may be in a nested model, `inner::link`
  const at = scoped.lastIndexOf("::");
  return findModel(page, scoped.slice(0, at))?.links.find((entry) => entry.name === scoped.slice(at + 2)) ?? null;
}

export function findJoint(page: Pick<Page, "world">, model: string, joint: string): JointInfo | null {
  return findModel(page, model)?.joints.find((entry) => entry.name === joint) ?? null;
}

export function findSensor(page: Pick<Page, "world">, model: string, link: string, sensor: string): SensorInfo | null {
  return findLink(page, model, link)?.sensors.find((entry) => entry.name === sensor) ?? null;
}

export function findPlugin(page: Pick<Page, "world">, owner: PluginOwner, plugin: string): PluginInfo | null {
  const of = (): { readonly plugins: readonly PluginInfo[] } | null => {
    if (owner.kind === "world") return page.world.manifest.value;
    return owner.kind === "model"
      ? findModel(page, owner.model)
      : findSensor(page, owner.model, owner.link, owner.sensor);
  };
  return of()?.plugins.find(({ name }) => name === plugin) ?? null;
}

/** Selection with a pose in the world: a sensor's link, a plugin's owner. */
export function placed(selection: Selection | null): Exclude<Selection, { readonly kind: "sensor" | "plugin" }> | null {
  if (selection?.kind === "plugin") return placed(selection.of);
  return selection?.kind === "sensor" ? { kind: "link", model: selection.model, link: selection.link } : selection;
}

/** Bodies of a selection; empty if it is not simulated. */
export function selectedBodies(page: Page, selected: Selection | null): readonly number[] {
  const selection = placed(selected);
  if (selection === null) return [];
  if (selection.kind === "model") {
    const model = findModel(page, selection.model);
    return model === null ? [] : bodiesOf(model);
  }
  if (selection.kind === "link") {
    const link = findLink(page, selection.model, selection.link);
    return link === null ? [] : [link.body];
  }
  if (selection.kind === "part") return bodiesOfPart(page.world.manifest.value?.draft ?? null, selection.part);
  if (selection.kind !== "joint") return [];
  const child = findJoint(page, selection.model, selection.joint)?.child ?? "";
  const link = findLink(page, selection.model, child);
  return link === null ? [] : [link.body];
}
