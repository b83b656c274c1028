/** Parameters as a tree, with undo of changes. */

import { signal } from "@preact/signals";
import type { JSX } from "preact";

import { Controls } from "../page/view_only";
import type { Page } from "../page/page";
import type { ParameterValue } from "../protocol/connection";
import { Checkbox } from "../theme/checkbox";
import { TextField } from "../theme/text_field";
import { Tree, type TreeRow } from "../theme/tree";
import type { Panel, PanelProps } from "./panel";
import { parameterFromText, parameterRows, parameterText, type ParameterRow } from "./parameters/parameter_tree";
import { FilterButton, FilterField } from "./parts";
import { perPage } from "./per_page";

const parametersState = perPage(() => ({
  filter: signal(""),
  isFiltering: signal(false),
  closed: signal<ReadonlySet<string>>(new Set()),
  selected: signal<string | null>(null),
}));

function Parameters({ page }: PanelProps): JSX.Element {
  const state = parametersState(page);
  const parameters = page.connection.parameters.value;
  const rows = parameterRows(parameters, state.closed.value, state.filter.value);
  return (
    <div class="stack">
      {state.isFiltering.value && <FilterField label="Filter parameters" value={state.filter} />}
      <div class="scroll">
        {rows.length === 0 && (
          <div class="empty">
            {parameters.size === 0 ? "There are no parameters." : "No parameter matches the filter."}
          </div>
        )}
        <Controls page={page}>
          <Tree
            label="Parameters"
            rows={rows.map((row) => treeRow(page, row, row.name === state.selected.value))}
            onSelect={(name) => void (state.selected.value = name)}
            onToggle={(name, open) => {
              const closed = new Set(state.closed.value);
              if (open) closed.delete(name);
              else closed.add(name);
              state.closed.value = closed;
            }}
          />
        </Controls>
      </div>
    </div>
  );
}

function treeRow(page: Page, row: ParameterRow, selected: boolean): TreeRow {
  return {
    key: row.name,
    depth: row.depth,
    label: row.label,
    open: row.open,
    selected,
    content: (
      <>
        <span class={row.value === undefined ? "n g" : "n"}>{row.label}</span>
        {row.value !== undefined && (
          <span class="entry r">
            <Value page={page} name={row.name} value={row.value} />
          </span>
        )}
      </>
    ),
  };
}

function Value({
  page,
  name,
  value,
}: {
  readonly page: Page;
  readonly name: string;
  readonly value: ParameterValue;
}): JSX.Element {
  if (typeof value === "boolean")
    return <Checkbox label={name} checked={value} onChange={(on) => change(page, name, value, on)} />;
  const isFloat = page.connection.floatParameters.value.has(name);
  return (
    <TextField
      label={name}
      class="small bare"
      value={parameterText(value, isFloat)}
      check={(text) => {
        const read = parameterFromText(value, text, isFloat);
        return "fault" in read ? read.fault : null;
      }}
      onCommit={(text) => {
        const read = parameterFromText(value, text, isFloat);
        if ("value" in read) change(page, name, value, read.value);
      }}
    />
  );
}

function change(page: Page, name: string, old: ParameterValue, value: ParameterValue): void {
  const { connection, undo } = page;
  undo.run(
    `Change of ${name}`,
    () => connection.setParameter(name, value),
    () => connection.setParameter(name, old),
  );
}

function Actions({ page }: PanelProps): JSX.Element {
  const state = parametersState(page);
  return <FilterButton on={state.isFiltering} text={state.filter} />;
}

export const parametersPanel: Panel = {
  id: "parameters",
  title: "Parameters",
  programs: ["rosparam"],
  component: Parameters,
  actions: Actions,
};
