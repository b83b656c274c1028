/** Sliders for a robot's speed, which return to zero when let go (rqt_robot_steering). */

import type { JSX } from "preact";
import { useEffect } from "preact/hooks";

import type { Drive, DriveInput } from "../page/drive";
import { canControl, VIEW_ONLY } from "../page/view_only";
import { Combo } from "../theme/combo";
import { fixed } from "../theme/format";
import { NumberField } from "../theme/number_field";
import { Slider } from "../theme/slider";
import type { Panel, PanelProps } from "./panel";

function Steering({ page: { drive, session } }: PanelProps): JSX.Element {
  const topic = drive.topic.value;
  const isDriving = drive.command.value !== null;
  const delay = drive.delay.value;
  return (
    <div class="scroll">
      <div class="steering">
        <div class="formrow">
          <span class="label">Topic</span>
          <Combo
            label="Topic of the velocity"
            value={topic ?? ""}
            choices={() => drive.topics.peek().map((value) => ({ value }))}
            onCommit={(name) => drive.choose(name)}
          />
        </div>
        <Axis drive={drive} component="linear" name="Forward, v" unit="m/s" />
        <Axis drive={drive} component="angular" name="Turning, w" unit="rad/s" />
        <div class={isDriving ? "sm held" : "sm t2"} role="status">
          {isDriving && `Driving ${topic ?? ""}${delay > 0 ? `, ${fixed(delay, 1)} s late` : ""}. Let go to stop.`}
          {!isDriving &&
            (!canControl({ session })
              ? VIEW_ONLY
              : topic === null
                ? `Nothing listens to ${session.drive_topic ?? "velocities"} yet.`
                : "Hold a slider to drive; let go to stop.")}
        </div>
      </div>
    </div>
  );
}

interface AxisProps {
  readonly drive: Drive;
  readonly component: keyof DriveInput;
  readonly name: string;
  readonly unit: string;
}

function Axis({ drive, component, name, unit }: AxisProps): JSX.Element {
  const source = `slider ${component}`;
  const value = drive.command.value?.[component] ?? 0;
  const limit = component === "linear" ? drive.linearLimit : drive.angularLimit;
  const hold = (velocity: number): void => {
    const share = velocity / limit.peek();
    drive.hold(source, component === "linear" ? share : 0, component === "angular" ? share : 0);
  };
  useEffect(() => () => drive.release(source), [drive, source]);
  return (
    <div class="joint">
      <div class="w">
        <span class="n">{name}</span>
        <span class="sp" />
        <b>{fixed(value, 2)}</b>
        <span class="unit">{unit} of</span>
        <span class="narrow">
          <NumberField
            label={`Limit of ${name}`}
            unit={unit}
            class="small num"
            value={limit.value}
            min={0.01}
            onCommit={(size) => void (limit.value = size)}
          />
        </span>
      </div>
      <Slider
        label={name}
        value={value}
        lower={-limit.value}
        upper={limit.value}
        text={`${fixed(value, 2)} ${unit}`}
        onInput={hold}
        onRelease={() => drive.release(source)}
      />
    </div>
  );
}

export const steeringPanel: Panel = {
  id: "steering",
  title: "Steering",
  programs: ["rqt_robot_steering"],
  component: Steering,
};
