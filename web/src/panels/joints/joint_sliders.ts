/** Sliders of joint_state_publisher_gui and of the simulated joints. */

import { signal, type ReadonlySignal } from "@preact/signals";

import type { Page } from "../../page/page";
import type { Fields } from "../../protocol/connection";
import type { JointStates } from "../../scene/simulated_world";
import { perPage } from "../per_page";
import { movingJoints } from "../plots/simulated_joints";

export interface JointSlider {
  readonly key: string;
  readonly name: string;
  readonly isLinear: boolean;
  /** [rad, m] */
  readonly lower: number;
  readonly upper: number;
  /** True if the joint has limits of its own. */
  readonly hasLimits: boolean;
  readonly position: number;
  readonly set: (position: number) => void;
}

export interface SliderGroup {
  readonly title: string;
  readonly sliders: readonly JointSlider[];
}

const WITHOUT_LIMITS = Math.PI; // rad, as joint_state_publisher
const WITHOUT_LIMITS_LINEAR = 1; // m

export class JointsState {
  readonly isDegrees = signal(false);
  readonly fault = signal("");
  private readonly positions = signal<ReadonlyMap<string, number>>(new Map());

  constructor(private readonly page: Page) {}

  /** All sliders in groups; a component that reads them follows the joints. */
  groups(): readonly SliderGroup[] {
    const groups: SliderGroup[] = [];
    const published = this.published();
    if (published.length > 0) groups.push({ title: "joint_state_publisher_gui", sliders: published });
    const joints = movingJoints(this.page.world.manifest.value);
    for (const model of new Set(joints.map((joint) => joint.model))) {
      groups.push({ title: model, sliders: this.simulated(model, this.page.world.joints) });
    }
    return groups;
  }

  allToZero(): void {
    for (const slider of this.all()) slider.set(Math.min(slider.upper, Math.max(slider.lower, 0)));
  }

  randomize(): void {
    for (const slider of this.all()) slider.set(slider.lower + Math.random() * (slider.upper - slider.lower));
  }

  private all(): readonly JointSlider[] {
    return this.groups().flatMap((group) => group.sliders);
  }

  private published(): readonly JointSlider[] {
    const types = new Map(movingJoints(this.page.world.manifest.value).map(({ joint }) => [joint.name, joint.type]));
    return this.page.session.sliders.map(({ name, lower, upper, position }) => ({
      key: `slider ${name}`,
      name,
      isLinear: types.get(name) === "prismatic",
      lower,
      upper,
      hasLimits: true,
      position: this.positions.value.get(name) ?? position,
      set: (value) => {
        this.positions.value = new Map(this.positions.peek()).set(name, value);
        this.send("slider", { joint: name, position: value });
      },
    }));
  }

  private simulated(model: string, states: ReadonlySignal<JointStates>): readonly JointSlider[] {
    return movingJoints(this.page.world.manifest.value)
      .filter((joint) => joint.model === model)
      .map(({ joint, index }) => {
        const isLinear = joint.type === "prismatic";
        const free = isLinear ? WITHOUT_LIMITS_LINEAR : WITHOUT_LIMITS;
        return {
          key: `${model}::${joint.name}`,
          name: joint.name,
          isLinear,
          lower: joint.lower ?? -free,
          upper: joint.upper ?? free,
          hasLimits: joint.lower !== null && joint.upper !== null,
          position: states.value.at(index)?.position ?? 0,
          set: (value: number) => this.send("joint", { model, joint: joint.name, position: value }),
        };
      });
  }

  private send<N extends "slider" | "joint">(request: N, fields: Fields<N>): void {
    this.page.connection.request(request, fields).then(
      () => void (this.fault.value = ""),
      (error: unknown) => void (this.fault.value = error instanceof Error ? error.message : String(error)),
    );
  }
}

export const jointsState = perPage((page) => new JointsState(page));

/** Factor and unit in which a slider is read. */
export function shownUnit(isLinear: boolean, isDegrees: boolean): readonly [number, string] {
  if (isLinear) return [1, "m"];
  return isDegrees ? [180 / Math.PI, "°"] : [1, "rad"];
}
