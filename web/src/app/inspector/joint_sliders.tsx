/** Joints with sliders: positions where there are limits, velocities where there are none. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import type { JointInfo, ModelInfo } from "../../protocol/generated/page_messages";
import type { JointState } from "../../scene/simulated_world";
import { Button } from "../../theme/button";
import { fixed } from "../../theme/format";
import { Name } from "../../theme/name";
import { Slider } from "../../theme/slider";
import { SteadyNumber } from "../../theme/steady_number";
import { jointValue, MAX_VELOCITY, turnsFreely } from "./joint_values";
import { JOINT_VALUES } from "../../panels/plots/simulated_values";
import { PlotMenu } from "./plot_menu";
import type { Shell } from "../shell";
import { NumbersRow } from "./value_rows";
import { canEdit, editWorld } from "../world/edits";
import type { Fields } from "../../protocol/connection";

export function ModelJoints({
  shell,
  name,
  model,
}: {
  readonly shell: Shell;
  readonly name: string;
  readonly model: ModelInfo;
}): JSX.Element | null {
  const joints = model.joints.filter((joint) => joint.index !== null);
  if (joints.length === 0) return null;
  const zero = (): void =>
    joints.forEach((joint) => setJoint(shell, name, joint, Math.min(joint.upper ?? 0, Math.max(joint.lower ?? 0, 0))));
  return (
    <section class="sec">
      <h3>
        Joints of {model.name}
        <span class="sp" />
        <Button small disabled={!canEdit(shell)} onClick={zero}>
          All to zero
        </Button>
      </h3>
      {joints.map((joint) => (
        <JointSlider key={joint.name} shell={shell} model={name} joint={joint} />
      ))}
    </section>
  );
}

export function JointSection({
  shell,
  model,
  joint,
}: {
  readonly shell: Shell;
  readonly model: string;
  readonly joint: JointInfo;
}): JSX.Element {
  const state = joint.index === null ? undefined : shell.page.world.joints.value.at(joint.index);
  const rows: readonly (readonly [string, string])[] = [
    ["Type", joint.type],
    ["Parent", joint.parent],
    ["Child", joint.child],
    ...(state === undefined
      ? []
      : [["Effort", `${fixed(state.effort, 2)} ${joint.type === "prismatic" ? "N" : "N m"}`] as const]),
  ];
  return (
    <section class="sec">
      <h3>
        Joint
        {joint.index !== null && <span class="sp" />}
        {joint.index !== null && <PlotMenu shell={shell} owner={`${model}::${joint.name}`} values={JOINT_VALUES} />}
      </h3>
      {rows.map(([name, value]) => (
        <div key={name} class="kv">
          <span>{name}</span>
          <span>{value}</span>
        </div>
      ))}
      {joint.index !== null && <JointSlider shell={shell} model={model} joint={joint} />}
      {state !== undefined && canEdit(shell) && (
        <JointTargets shell={shell} model={model} joint={joint} state={state} />
      )}
    </section>
  );
}

function setJoint(shell: Shell, model: string, joint: JointInfo, value: number): void {
  const fields = turnsFreely(joint) ? { velocity: value } : { position: value };
  shell.request(joint.name, "joint", { model, joint: joint.name, ...fields });
}

interface TargetProps {
  readonly shell: Shell;
  readonly model: string;
  readonly joint: JointInfo;
  readonly state: JointState;
}

/** Commands of the joint's motor as numbers; the last one is in effect. */
function JointTargets({ shell, model, joint, state }: TargetProps): JSX.Element {
  const [metre, newton] = joint.type === "prismatic" ? ["m", "N"] : ["rad", "N m"];
  const targets: readonly (readonly [TargetName, number, string])[] = [
    ["position", state.position, metre],
    ["velocity", state.velocity, `${metre}/s`],
    ["effort", Number.isFinite(state.effort) ? state.effort : 0, newton],
  ];
  return (
    <>
      {targets.map(([name, now, unit]) => (
        <NumbersRow
          key={name}
          name={`Target ${name}`}
          labels={[`target ${name}`]}
          values={[now]}
          decimals={3}
          unit={unit}
          min={-1e6}
          max={1e6}
          onCommit={(_, value) =>
            driveJoint(shell, model, joint.name, { [name]: value }, { [name]: name === "position" ? now : 0 })
          }
        />
      ))}
    </>
  );
}

type TargetName = "position" | "velocity" | "effort";
type Target = Readonly<Partial<Record<TargetName, number>>>;

/** Command a joint; `before` are the values that undo restores. */
function driveJoint(shell: Shell, model: string, joint: string, after: Target, before: Target): void {
  const fields = (target: Target): Fields<"joint"> => ({ model, joint, ...target });
  void editWorld(shell, `Joint ${joint}`, "joint", fields(after), fields(before));
}

function JointSlider({
  shell,
  model,
  joint,
}: {
  readonly shell: Shell;
  readonly model: string;
  readonly joint: JointInfo;
}): JSX.Element | null {
  const dragged = useSignal<number | null>(null);
  const start = useSignal(0);
  const state = joint.index === null ? undefined : shell.page.world.joints.value.at(joint.index);
  if (state === undefined) return null;
  const { isVelocity, value, unit, decimals, text, length } = jointValue(joint, state);
  const [lower, upper] = isVelocity ? [-MAX_VELOCITY, MAX_VELOCITY] : [joint.lower ?? 0, joint.upper ?? 0];
  const shown = dragged.value ?? value;
  return (
    <div class="jt">
      <div class="h">
        <Name text={joint.name} />
        <span>
          <SteadyNumber text={text} length={length} />
          <span class="unit">{unit}</span>
        </span>
      </div>
      <Slider
        label={joint.name}
        value={shown}
        lower={lower}
        upper={upper}
        text={`${fixed(shown, decimals)} ${unit}`}
        disabled={!canEdit(shell)}
        onInput={(to) => {
          if (dragged.value === null) start.value = isVelocity ? 0 : value;
          dragged.value = to;
          setJoint(shell, model, joint, to);
        }}
        onRelease={() => {
          const name = isVelocity ? "velocity" : "position";
          if (dragged.value !== null)
            driveJoint(shell, model, joint.name, { [name]: dragged.value }, { [name]: start.value });
          dragged.value = null;
        }}
      />
      <div class="lim">
        <span>{isVelocity ? "no limits" : fixed(lower, 2)}</span>
        <span>{isVelocity ? "" : fixed(upper, 2)}</span>
      </div>
    </div>
  );
}
