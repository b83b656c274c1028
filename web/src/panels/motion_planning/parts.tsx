/** Parts that the sections of the panel MotionPlanning share. */

import type { ComponentChildren, JSX } from "preact";

import type { MotionPlanningDisplay } from "../../displays/motion_planning";
import type { Page } from "../../page/page";
import type { MotionPlanningState } from "./motion_planning_state";

export interface TabProps {
  readonly page: Page;
  readonly state: MotionPlanningState;
  readonly display: MotionPlanningDisplay;
}

export function FormRow({
  label,
  children,
}: {
  readonly label: string;
  readonly children: ComponentChildren;
}): JSX.Element {
  return (
    <div class="formrow">
      <span class="label" title={label}>
        {label}
      </span>
      <span class="w entry">{children}</span>
    </div>
  );
}
