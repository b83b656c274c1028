/** Curves of any numeric field over time (rqt_plot). */

import type { JSX } from "preact";

import { Button } from "../theme/button";
import { MenuButton } from "../theme/menu";
import type { MenuItem } from "../theme/menu_list";
import { Select } from "../theme/select";
import type { Panel, PanelProps } from "./panel";
import { timeText } from "./messages/format";
import { CurvePicker } from "./plots/curve_picker";
import { Legend } from "./plots/legend";
import { REFERENCE_MODES } from "./plots/line";
import { parquetFile } from "./plots/parquet";
import { PlotCanvas } from "./plots/plot_canvas";
import { plotsState, WINDOWS, type PlotsState } from "./plots/plots_state";
import { suggestions } from "./plots/suggestions";
import { Split } from "./parts";
import { saveFile } from "./use";

function Plots({ page }: PanelProps): JSX.Element {
  const state = plotsState(page);
  return (
    <Split detail={state.isAdding.value && <CurvePicker page={page} state={state} />}>
      {state.curves.length === 0 ? (
        <div class="empty line">
          Nothing is plotted.
          <Button small tone="line" icon="plus" onClick={() => void (state.isAdding.value = true)}>
            Add curve
          </Button>
          {suggestions(page).map(({ title, curves }) => (
            <Button
              key={title}
              small
              tone="line"
              onClick={() => curves.forEach(([path, name]) => state.add(path, name))}
            >
              {title}
            </Button>
          ))}
        </div>
      ) : (
        <div class="plots" onDblClick={() => void (state.zoom.value = null)}>
          {state.plots.value.map((plot) => (
            <section
              key={plot.id}
              class="plot"
              aria-label={`Plot of ${plot.curves.map((curve) => curve.name).join(", ")}`}
            >
              <Legend state={state} plot={plot} />
              <PlotCanvas state={state} curves={plot.curves} theme={page.theme.value} />
            </section>
          ))}
        </div>
      )}
    </Split>
  );
}

function CursorTime({ state }: { readonly state: PlotsState }): JSX.Element | null {
  const time = state.cursor.value;
  return time === null ? null : <span class="sm t2 cursor">{timeText(time)}</span>;
}

function Actions({ page }: PanelProps): JSX.Element {
  const state = plotsState(page);
  const isPaused = state.isPaused.value;
  return (
    <>
      <CursorTime state={state} />
      {state.zoom.value !== null && (
        <Button small onClick={() => void (state.zoom.value = null)}>
          To now
        </Button>
      )}
      {state.reference.value !== null && (
        <Select
          label="Recording to compare with"
          value={state.mode.value}
          choices={REFERENCE_MODES}
          onChange={(mode) => void (state.mode.value = REFERENCE_MODES.find((one) => one === mode) ?? "With reference")}
        />
      )}
      <Select
        label="Time window"
        value={`${state.window.value} s`}
        choices={WINDOWS.map((seconds) => `${seconds} s`)}
        onChange={(text) => {
          state.window.value = Number.parseInt(text, 10);
          state.zoom.value = null;
        }}
      />
      <Button
        small
        icon="plus"
        on={state.isAdding.value}
        onClick={() => void (state.isAdding.value = !state.isAdding.value)}
      >
        Add curve
      </Button>
      <Button small icon={isPaused ? "play" : "pause"} onClick={() => state.pause(!isPaused)}>
        {isPaused ? "Go on" : "Pause"}
      </Button>
      <MenuButton class="sml" icon="download" items={() => exports(state)}>
        Save
      </MenuButton>
    </>
  );
}

function exports(state: PlotsState): readonly MenuItem[] {
  const item = (title: string, suffix: string, type: string, content: () => BlobPart): MenuItem => ({
    title,
    disabled: state.curves.length === 0,
    run: () => saveFile(`plots.${suffix}`, new Blob([content()], { type })),
  });
  return [
    item("CSV", "csv", "text/csv", () => state.csv()),
    item("Parquet", "parquet", "application/vnd.apache.parquet", () => parquetFile(state.columns())),
    item("SVG", "svg", "image/svg+xml", () => state.svg()),
  ];
}

export const plotsPanel: Panel = {
  id: "plots",
  title: "Plots",
  programs: ["rqt_plot", "rxplot"],
  component: Plots,
  actions: Actions,
};
