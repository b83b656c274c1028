/** Section Joints of the panel MotionPlanning: the joints of start or goal, within their limits. */

import { signal } from "@preact/signals";
import type { JSX } from "preact";

import { changeProperty } from "../../page/change_property";
import { Controls } from "../../page/view_only";
import { Button } from "../../theme/button";
import { JointRow } from "../joints/joint_row";
import type { JointSlider } from "../joints/joint_sliders";
import { perPage } from "../per_page";
import type { TabProps } from "./parts";

const jointsTab = perPage(() => ({ query: signal<"start" | "goal">("goal") }));

export function JointsTab({ page, display }: TabProps): JSX.Element {
  const { query: chosen } = jointsTab(page);
  const query = display.query(chosen.value);
  const group = display.group.value;
  const { usesRadians } = display.settings;
  const positions = query.positions.value;
  const all = display.model?.complete(positions);
  const sliders = (group?.joints ?? []).map(
    ({ name, isLinear, isContinuous, lower, upper }): JointSlider => ({
      key: name,
      name,
      isLinear,
      lower,
      upper,
      hasLimits: !isContinuous,
      position: all?.get(name) ?? 0,
      set: (position) => query.set(new Map([[name, position]])),
    }),
  );
  return (
    <div class="scroll">
      <div class="toolrow" role="group" aria-label="State whose joints are moved">
        {(["start", "goal"] as const).map((name) => (
          <Button key={name} small on={chosen.value === name} onClick={() => void (chosen.value = name)}>
            {name === "start" ? "Start State" : "Goal State"}
          </Button>
        ))}
        <span class="sp" />
        <Button
          small
          on={!usesRadians.value.value}
          label={`Angles in ${usesRadians.value.value ? "rad" : "°"}`}
          onClick={() => changeProperty(page, usesRadians, !usesRadians.value.peek())}
        >
          {usesRadians.value.value ? "rad" : "°"}
        </Button>
      </div>
      {sliders.length === 0 && <div class="empty">The group has no joints to move.</div>}
      <Controls page={page}>
        <div class="sliders">
          {sliders.map((slider) => (
            <JointRow key={slider.key} slider={slider} isDegrees={!usesRadians.value.value} />
          ))}
        </div>
      </Controls>
    </div>
  );
}
