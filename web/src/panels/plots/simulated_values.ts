/** Names of plottable values of a simulation or a played log: of models, links, joints and sensors. */

import type { Manifest, ModelInfo, PageSession } from "../../protocol/generated/page_messages";

const XYZ = ["x", "y", "z"];
const POSE = [...XYZ, "roll", "pitch", "yaw"].map((axis) => `pose.${axis}`);
const TWIST = ["linear", "angular"].flatMap((part) => XYZ.map((axis) => `twist.${part}.${axis}`));
const CONTACT = [...XYZ.map((axis) => `contact.force.${axis}`), "contact.count"];
export const JOINT_VALUES = ["position", "velocity", "effort"];
/** What a log has. */
const RECORDED: ReadonlySet<string> = new Set([...POSE, ...TWIST, "position", "velocity"]);

type PageKind = PageSession["kind"];

/** A model, link, joint or sensor with its values. */
export interface ValueOwner {
  /** `model::link` */
  readonly name: string;
  readonly kind: "model" | "link" | "joint" | "sensor";
  readonly values: readonly string[];
}

/** All owners with their values' full names, each model followed by its parts and nested models. */
export function valueOwners(manifest: Manifest | null, pageKind: PageKind): readonly ValueOwner[] {
  const owners = (manifest?.models ?? []).flatMap((model) => [
    ...(model.links.length > 0 ? [owner(model.name, "model", bodyValues(model))] : []),
    ...partsOf(model, model.name),
  ]);
  return owners
    .map(({ name, kind, values }) => ({
      name,
      kind,
      values: plottedValues(values, pageKind).map((value) => `${name}.${value}`),
    }))
    .filter(({ values }) => values.length > 0);
}

/** Values that a page of a kind can plot: a log has no contacts, efforts and readings, a graph and a bag none. */
export function plottedValues(values: readonly string[], pageKind: PageKind): readonly string[] {
  if (pageKind === "simulation") return values;
  return pageKind === "log" ? values.filter((value) => RECORDED.has(value)) : [];
}

/** Values of a link's or model's body; a static one has only contacts. */
export function bodyValues({ static: isStatic }: Pick<ModelInfo, "static">): readonly string[] {
  return isStatic ? CONTACT : [...POSE, ...TWIST, ...CONTACT];
}

function partsOf(model: ModelInfo, scope: string): readonly ValueOwner[] {
  const links = model.links.flatMap((link) => [
    owner(`${scope}::${link.name}`, "link", bodyValues(model)),
    ...link.sensors
      .filter(({ series }) => series.length > 0)
      .map((sensor) => owner(`${scope}::${link.name}::${sensor.name}`, "sensor", sensor.series)),
  ]);
  const joints = model.joints
    .filter(({ index }) => index !== null)
    .map(({ name }) => owner(`${scope}::${name}`, "joint", JOINT_VALUES));
  return [...links, ...joints, ...model.models.flatMap((nested) => partsOf(nested, `${scope}::${nested.name}`))];
}

function owner(name: string, kind: ValueOwner["kind"], values: readonly string[]): ValueOwner {
  return { name, kind, values };
}
