/** Names of the simulation's plottable values: of models, links, joints and sensors. */

import type { Manifest, ModelInfo } from "../../protocol/generated/page_messages";

const XYZ = ["x", "y", "z"];
const POSE = [...XYZ, "roll", "pitch", "yaw"].map((axis) => `pose.${axis}`);
const TWIST = ["linear", "angular"].flatMap((part) => XYZ.map((axis) => `twist.${part}.${axis}`));
const CONTACT = [...XYZ.map((axis) => `contact.force.${axis}`), "contact.count"];
export const JOINT_VALUES = ["position", "velocity", "effort"];

/** A model, link, joint or sensor with its values. */
export interface ValueOwner {
  /** `model::link`; the values' names begin with it. */
  readonly name: string;
  readonly kind: "model" | "link" | "joint" | "sensor";
  readonly values: readonly string[];
}

/** All owners, each model followed by its parts and nested models. */
export function valueOwners(manifest: Manifest | null): readonly ValueOwner[] {
  return (manifest?.models ?? []).flatMap((model) => [
    ...(model.links.length > 0 ? [owner(model.name, "model", bodyValues(model))] : []),
    ...partsOf(model, model.name),
  ]);
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
  return { name, kind, values: values.map((value) => `${name}.${value}`) };
}
