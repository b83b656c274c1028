/** Joints of the simulated world. */

import type { JointInfo, Manifest, ModelInfo } from "../../protocol/generated/page_messages";

export interface NamedJoint {
  /** `model::joint`, with the models that the model is nested in. */
  readonly name: string;
  readonly model: string;
  readonly joint: JointInfo;
  /** Place in the `trundle/joints` channel. */
  readonly index: number;
}

/** All joints with a single axis, in the order of their models. */
export function movingJoints(manifest: Manifest | null): readonly NamedJoint[] {
  const joints: NamedJoint[] = [];
  const add = (models: readonly ModelInfo[], prefix: string): void => {
    for (const model of models) {
      const name = prefix + model.name;
      for (const joint of model.joints) {
        if (joint.index !== null)
          joints.push({ name: `${name}::${joint.name}`, model: name, joint, index: joint.index });
      }
      add(model.models, `${name}::`);
    }
  };
  add(manifest?.models ?? [], "");
  return joints;
}
