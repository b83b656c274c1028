/** Sliders of joints: those of joint_state_publisher_gui, and of the simulation. */

import type { JSX } from "preact";

import { canControl, Controls } from "../page/view_only";
import { Button } from "../theme/button";
import { fixed } from "../theme/format";
import { Name } from "../theme/name";
import { NumberField } from "../theme/number_field";
import { Slider } from "../theme/slider";
import { jointsState, shownUnit, type JointSlider } from "./joints/joint_sliders";
import type { Panel, PanelProps } from "./panel";

function Joints({ page }: PanelProps): JSX.Element {
  const state = jointsState(page);
  const groups = state.groups();
  return (
    <div class="scroll">
      {groups.length === 0 && (
        <div class="empty">
          No joints can be moved here: no joint_state_publisher_gui runs, and nothing is simulated.
        </div>
      )}
      {state.fault.value !== "" && (
        <div class="fault pad" role="alert">
          {state.fault.value}
        </div>
      )}
      <Controls page={page}>
        {groups.map(({ title, sliders }) => (
          <section key={title} aria-label={`Joints of ${title}`}>
            <h2 class="headline">{title}</h2>
            <div class="sliders">
              {sliders.map((slider) => (
                <JointRow key={slider.key} slider={slider} isDegrees={state.isDegrees.value} />
              ))}
            </div>
          </section>
        ))}
      </Controls>
    </div>
  );
}

function JointRow({ slider, isDegrees }: { readonly slider: JointSlider; readonly isDegrees: boolean }): JSX.Element {
  const [factor, unit] = shownUnit(slider.isLinear, isDegrees);
  const decimals = unit === "°" ? 1 : 3;
  const text = (value: number): string => fixed(value * factor, decimals);
  return (
    <div class="joint">
      <div class="w">
        <Name text={slider.name} />
        <span class="sp" />
        <span class="narrow">
          <NumberField
            label={slider.name}
            unit={unit}
            class="small num bare"
            value={slider.position * factor}
            decimals={decimals}
            min={slider.hasLimits ? slider.lower * factor : undefined}
            max={slider.hasLimits ? slider.upper * factor : undefined}
            onCommit={(value) => slider.set(value / factor)}
          />
        </span>
      </div>
      <Slider
        label={slider.name}
        value={slider.position}
        lower={slider.lower}
        upper={slider.upper}
        text={`${text(slider.position)} ${unit}`}
        onInput={slider.set}
      />
      <div class="limits">
        {slider.hasLimits ? (
          <>
            <span>{text(slider.lower)}</span>
            <span>{text(slider.upper)}</span>
          </>
        ) : (
          <span>no limits</span>
        )}
      </div>
    </div>
  );
}

function Actions({ page }: PanelProps): JSX.Element {
  const state = jointsState(page);
  const unit = state.isDegrees.value ? "°" : "rad";
  return (
    <>
      {canControl(page) && (
        <>
          <Button small onClick={() => state.allToZero()}>
            All to zero
          </Button>
          <Button small onClick={() => state.randomize()}>
            Randomize
          </Button>
        </>
      )}
      <Button
        small
        on={state.isDegrees.value}
        label={`Angles in ${unit}`}
        onClick={() => void (state.isDegrees.value = !state.isDegrees.value)}
      >
        {unit}
      </Button>
    </>
  );
}

export const jointsPanel: Panel = {
  id: "joints",
  title: "Joints",
  programs: ["joint_state_publisher_gui", "rqt_joint_trajectory_controller"],
  component: Joints,
  actions: Actions,
};
