/** Section Context of the panel MotionPlanning: planning library and planner, and the workspace. */

import type { JSX } from "preact";

import { changeProperty } from "../../page/change_property";
import { Controls } from "../../page/view_only";
import type { VectorProperty } from "../../rviz/properties";
import { NumberField } from "../../theme/number_field";
import { Select } from "../../theme/select";
import { FormRow, type TabProps } from "./parts";

const DEFAULT = "<default>";

export function ContextTab({ page, state, display }: TabProps): JSX.Element {
  const { planners, pipeline, planner } = state;
  const pipelines = planners.value.map(({ pipeline_id, name }) => pipeline_id || name);
  const library = planners.value.find(({ pipeline_id, name }) => (pipeline_id || name) === pipeline.value);
  const group = display.group.value?.name ?? "";
  const { workspaceCenter, workspaceSize } = display.settings;
  return (
    <div class="scroll armcolumns">
      <Controls page={page}>
        <section aria-label="Planning library">
          <h2 class="headline">Planning library</h2>
          <FormRow label="Library">
            <Select
              label="Planning library"
              value={pipeline.value || DEFAULT}
              choices={[DEFAULT, ...pipelines]}
              onChange={(name) => {
                pipeline.value = name === DEFAULT ? "" : name;
                planner.value = "";
              }}
            />
          </FormRow>
          <FormRow label="Planner">
            <Select
              label="Planner"
              value={planner.value || DEFAULT}
              choices={[DEFAULT, ...plannersOf((library ?? planners.value[0])?.planner_ids ?? [], group)]}
              onChange={(name) => void (planner.value = name === DEFAULT ? "" : name)}
            />
          </FormRow>
          {planners.value.length === 0 && <p class="sm t2 pad">move_group has not named its planners yet.</p>}
        </section>
        <section aria-label="Workspace">
          <h2 class="headline">Workspace of a robot that drives</h2>
          <VectorRow page={page} label="Center" property={workspaceCenter} />
          <VectorRow page={page} label="Size" property={workspaceSize} />
        </section>
      </Controls>
      <p class="sm t2 pad">States and scenes are not kept in a database (warehouse): export the scene as a file.</p>
    </div>
  );
}

interface VectorRowProps extends Pick<TabProps, "page"> {
  readonly label: string;
  readonly property: VectorProperty;
}

function VectorRow({ page, label, property }: VectorRowProps): JSX.Element {
  const value = property.value.value;
  return (
    <FormRow label={label}>
      {(["X", "Y", "Z"] as const).map((axis, index) => (
        <NumberField
          key={axis}
          label={`${label} ${axis}`}
          unit="m"
          class="small num"
          value={value[index] ?? 0}
          onCommit={(number) => {
            const [X, Y, Z] = value.map((old, at) => (at === index ? number : old));
            changeProperty(page, property, { X: X ?? 0, Y: Y ?? 0, Z: Z ?? 0 });
          }}
        />
      ))}
    </FormRow>
  );
}

/** Planners of a group: named "group[planner]" where they belong to one. */
function plannersOf(ids: readonly string[], group: string): readonly string[] {
  const own = ids.filter((id) => id.startsWith(`${group}[`) && id.endsWith("]"));
  const free = ids.filter((id) => !id.includes("["));
  return [...new Set([...own.map((id) => id.slice(group.length + 1, -1)), ...free])].sort();
}
