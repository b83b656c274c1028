/** Sliders of joints: those of joint_state_publisher_gui, and of the simulation. */

import type { JSX } from "preact";

import { canControl, Controls } from "../page/view_only";
import { Button } from "../theme/button";
import { JointRow } from "./joints/joint_row";
import { jointsState } from "./joints/joint_sliders";
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
