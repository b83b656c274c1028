/** Section Planning of the panel MotionPlanning: group, start and goal, options, and the planned path. */

import type { JSX } from "preact";

import { changeProperty } from "../../page/change_property";
import { canControl, Controls } from "../../page/view_only";
import type { BoolProperty, NumberProperty } from "../../rviz/properties";
import { Button } from "../../theme/button";
import { Checkbox } from "../../theme/checkbox";
import { fixed } from "../../theme/format";
import { NumberField } from "../../theme/number_field";
import { Select } from "../../theme/select";
import { Slider } from "../../theme/slider";
import type { Query } from "../../displays/moveit/query";
import { FormRow, type TabProps } from "./parts";
import { choicesOf, choose } from "./query_choices";

export function PlanningTab(props: TabProps): JSX.Element {
  const { page, state, display } = props;
  const { request, settings } = display;
  const groups = display.described.value.model?.groups.map(({ name }) => name) ?? [];
  return (
    <div class="scroll armcolumns">
      <Controls page={page}>
        <section aria-label="Query">
          <h2 class="headline">Query</h2>
          <FormRow label="Planning Group">
            <Select
              label="Planning Group"
              value={display.group.value?.name ?? ""}
              choices={groups}
              onChange={(name) => changeProperty(page, request.group, name)}
            />
          </FormRow>
          <QueryRow {...props} title="Start State" query={display.startQuery} shown={request.queryStart} />
          <QueryRow {...props} title="Goal State" query={display.goalQuery} shown={request.queryGoal} />
        </section>
        <section aria-label="Speed and time">
          <h2 class="headline">Speed and time</h2>
          <NumberRow {...props} label="Velocity Scaling" property={settings.velocityScaling} />
          <NumberRow {...props} label="Accel. Scaling" property={settings.accelerationScaling} />
          <NumberRow {...props} label="Planning Time" property={settings.planningTime} unit="s" />
          <NumberRow {...props} label="Planning Attempts" property={settings.attempts} />
        </section>
        <section aria-label="Options">
          <h2 class="headline">Options</h2>
          <BoolRow {...props} label="Use Cartesian Path" property={settings.cartesian} />
          <BoolRow {...props} label="Collision-aware IK" property={settings.collisionAwareIk} />
          <BoolRow {...props} label="Approx IK Solutions" property={settings.approximateIk} />
          <BoolRow {...props} label="Replanning" property={settings.replanning} />
          <div class="formrow">
            <Button small icon="reset" onClick={() => void state.call("clear_octomap")}>
              Clear octomap
            </Button>
          </div>
        </section>
      </Controls>
      <PathSection {...props} />
    </div>
  );
}

interface QueryRowProps extends TabProps {
  readonly title: string;
  readonly query: Query;
  readonly shown: BoolProperty;
}

function QueryRow({ page, state, display, title, query, shown }: QueryRowProps): JSX.Element {
  const apply = (choice: string): void => {
    choose(state, display, query, choice).then(
      (fault) => void (query.fault.value = fault),
      (error: unknown) => void (query.fault.value = error instanceof Error ? error.message : String(error)),
    );
  };
  return (
    <FormRow label={title}>
      <Checkbox
        label={`Show the ${title}`}
        checked={shown.value.value}
        onChange={(checked) => changeProperty(page, shown, checked)}
      />
      <Select
        label={title}
        value={query.choice.value || "by hand"}
        choices={choicesOf(query, display.group.value)}
        onChange={apply}
      />
    </FormRow>
  );
}

interface PropertyRowProps<P> extends TabProps {
  readonly label: string;
  readonly property: P;
}

function NumberRow({
  page,
  label,
  property,
  unit,
}: PropertyRowProps<NumberProperty> & { readonly unit?: string }): JSX.Element {
  const { min, max } = property.options;
  return (
    <FormRow label={label}>
      <span class="narrow">
        <NumberField
          label={label}
          unit={unit}
          class="small num"
          min={min}
          max={max}
          integer={property.kind === "integer"}
          value={property.value.value}
          onCommit={(value) => changeProperty(page, property, value)}
        />
      </span>
    </FormRow>
  );
}

function BoolRow({ page, label, property }: PropertyRowProps<BoolProperty>): JSX.Element {
  return (
    <label class="formrow check">
      <Checkbox
        label={label}
        checked={property.value.value}
        onChange={(checked) => changeProperty(page, property, checked)}
      />
      {label}
    </label>
  );
}

/** The planned path's animation: rviz's panel "MotionPlanning - Trajectory Slider". */
function PathSection({ page, display }: TabProps): JSX.Element {
  const playback = display.pathView.value?.playback;
  const path = playback?.path.value ?? [];
  const index = playback?.index.value ?? -1;
  const time = path[Math.max(0, index)]?.time ?? 0;
  const isPlaying = playback?.isPlaying.value === true;
  return (
    <section aria-label="Planned path">
      <h2 class="headline">Planned path</h2>
      <div class="formrow">
        <Button
          small
          icon={isPlaying ? "pause" : "play"}
          label={isPlaying ? "Pause the planned path" : "Play the planned path"}
          disabled={path.length === 0}
          onClick={() => playback?.play(!isPlaying)}
        />
        <span class="entry">
          <Slider
            label="Waypoint of the planned path"
            value={Math.max(0, index)}
            lower={0}
            upper={Math.max(1, path.length - 1)}
            text={`Waypoint ${Math.max(0, index) + 1} of ${path.length}, ${fixed(time, 2)} s`}
            disabled={path.length === 0}
            onInput={(at) => playback?.seek(at)}
          />
        </span>
      </div>
      <div class="formrow t2">
        {path.length === 0
          ? "No path is planned."
          : `Waypoint ${Math.max(0, index) + 1} of ${path.length}, ${fixed(time, 2)} s`}
      </div>
      <label class="formrow check">
        <Checkbox
          label="Loop Animation"
          checked={display.path.loop.value.value}
          disabled={!canControl(page)}
          onChange={(checked) => changeProperty(page, display.path.loop, checked)}
        />
        Loop Animation
      </label>
      <label class="formrow check">
        <Checkbox
          label="Show Trail"
          checked={display.path.trail.value.value}
          disabled={!canControl(page)}
          onChange={(checked) => changeProperty(page, display.path.trail, checked)}
        />
        Show Trail
      </label>
    </section>
  );
}
