/** Model of the robot from the parameters robot_description and robot_description_semantic. */

import { computed, type ReadonlySignal } from "@preact/signals";

import type { ParameterValue } from "../../protocol/connection";
import { readUrdf, UrdfError } from "../robot/urdf";
import { ArmModel } from "./arm_model";
import { readSrdf, SrdfError, type Srdf } from "./srdf";

export interface Description {
  readonly model: ArmModel | null;
  /** Why there is no model, or none with groups; "": it is complete. */
  readonly fault: string;
}

/** Largest description that is read; longer texts are refused. */
const MAX_LENGTH = 16_000_000;
const NO_SRDF: Srdf = { groups: [], states: [], endEffectors: [], virtualJoints: [], passiveJoints: new Set() };

/** The model as the parameters change; `parameter` reads one by name, so that signals are followed. */
export function describedModel(
  name: () => string,
  parameter: (name: string) => ParameterValue | undefined,
): ReadonlySignal<Description> {
  const texts = computed(() => {
    const [urdf, srdf] = [parameter(name()), parameter(`${name()}_semantic`)];
    return [typeof urdf === "string" ? urdf : null, typeof srdf === "string" ? srdf : null, name()].join("\0");
  });
  return computed(() => {
    texts.value; // eslint-disable-line @typescript-eslint/no-unused-expressions -- read again only when a text changes
    const [urdf, srdf] = [parameter(name()), parameter(`${name()}_semantic`)];
    return describe(name(), urdf, srdf);
  });
}

function describe(name: string, urdf: ParameterValue | undefined, srdf: ParameterValue | undefined): Description {
  if (typeof urdf !== "string") return { model: null, fault: `Parameter [${name}] does not exist` };
  if (urdf.length > MAX_LENGTH) return { model: null, fault: `Parameter [${name}] is longer than 16 MB` };
  try {
    const robot = readUrdf(urdf);
    if (typeof srdf !== "string") {
      const fault = `Parameter [${name}_semantic] does not exist: there are no planning groups`;
      return { model: new ArmModel(robot, NO_SRDF), fault };
    }
    return { model: new ArmModel(robot, readSrdf(srdf)), fault: "" };
  } catch (error) {
    if (error instanceof UrdfError || error instanceof SrdfError) return { model: null, fault: error.message };
    throw error;
  }
}
