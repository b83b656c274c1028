/** Log entries of nodes, with filters (rqt_console); the server's notices too. */

import type { JSX } from "preact";

import type { StatusLevel } from "../rviz/status_level";
import { Button } from "../theme/button";
import { StatusShape } from "../theme/status_shape";
import { LEVELS, type Level, type LogEntry } from "./log/log_entries";
import { logState, type LogState } from "./log/log_state";
import { timeText } from "./messages/format";
import type { Panel, PanelProps } from "./panel";
import { FilterField } from "./parts";
import { VirtualRows } from "./virtual_rows";

/** Heights of a row [px]: --row, and --touch on a phone. */
const ROW = { desktop: 24, phone: 44 };
const PHONE = "(max-width: 640px)";
const SHAPES: Readonly<Partial<Record<Level, StatusLevel>>> = { Warn: "warn", Error: "error", Fatal: "error" };

function Log({ page }: PanelProps): JSX.Element {
  const state = logState(page);
  const shown = state.shown.value;
  const selected = shown.find((entry) => entry.id === state.selected.value);
  const move = (step: number): void => {
    const at = shown.findIndex((entry) => entry.id === state.selected.value);
    const next = shown[at < 0 ? shown.length - 1 : Math.max(0, Math.min(shown.length - 1, at + step))];
    if (next !== undefined) state.selected.value = next.id;
  };
  return (
    <div class="stack">
      {state.isFiltering.value && (
        <div class="toolrow">
          <FilterField label="Filter by text, or /expression/" value={state.text} />
          <FilterField label="Filter by node" value={state.node} />
        </div>
      )}
      <div class="loghead" aria-hidden="true">
        <span>Time</span>
        <span>Level</span>
        <span>Node</span>
        <span>Message</span>
      </div>
      {shown.length === 0 && <div class="empty">{emptyText(state)}</div>}
      <VirtualRows
        label="Log"
        items={shown}
        height={matchMedia(PHONE).matches ? ROW.phone : ROW.desktop}
        follow={state.frozen.value === null && selected === undefined}
        row={(entry) => <Row key={entry.id} entry={entry} state={state} />}
        onKey={(event) => {
          if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
          event.preventDefault();
          move(event.key === "ArrowDown" ? 1 : -1);
        }}
      />
      {selected !== undefined && <Detail entry={selected} onClose={() => void (state.selected.value = null)} />}
    </div>
  );
}

function emptyText(state: LogState): string {
  return state.entries.value.length === 0 ? "Nothing was logged yet." : "No entry passes the filters.";
}

function Row({ entry, state }: { readonly entry: LogEntry; readonly state: LogState }): JSX.Element {
  const isSelected = state.selected.value === entry.id;
  return (
    <div
      class={isSelected ? "logrow sel" : "logrow"}
      onClick={() => void (state.selected.value = isSelected ? null : entry.id)}
    >
      <span class="dim">{entry.time === null ? "" : timeText(entry.time)}</span>
      <LevelMark level={entry.level} />
      <span class="t2 n">{entry.node}</span>
      <span class="n">{entry.text}</span>
    </div>
  );
}

function LevelMark({ level }: { readonly level: Level }): JSX.Element {
  const shape = SHAPES[level];
  return (
    <span class="w">
      {shape === undefined ? <span class="st" /> : <StatusShape level={shape} label={level} />}
      {level}
    </span>
  );
}

function Detail({ entry, onClose }: { readonly entry: LogEntry; readonly onClose: () => void }): JSX.Element {
  return (
    <div class="logdetail" role="region" aria-label="Log entry">
      <div class="w">
        <LevelMark level={entry.level} />
        <span class="t2">{entry.node}</span>
        {entry.file !== "" && <span class="source">{`${entry.file}:${entry.line}`}</span>}
        {entry.function !== "" && <span class="dim">{entry.function}</span>}
        <span class="sp" />
        <Button small icon="close" label="Close" onClick={onClose} />
      </div>
      <pre>{entry.text}</pre>
    </div>
  );
}

function Actions({ page }: PanelProps): JSX.Element {
  const state = logState(page);
  const counts = state.counts();
  return (
    <>
      {LEVELS.map((level) => {
        const isOn = state.levels.value.has(level);
        const shape = SHAPES[level];
        const count = counts.get(level) ?? 0;
        return (
          <button
            key={level}
            type="button"
            class={isOn ? "chip on" : "chip"}
            aria-pressed={isOn}
            onClick={() => state.toggle(level)}
          >
            {shape !== undefined && <StatusShape level={shape} label="" />}
            {shape !== undefined && count > 0 ? `${level} ${count}` : level}
          </button>
        );
      })}
      <Button
        small
        icon="filter"
        on={state.isFiltering.value}
        onClick={() => {
          state.isFiltering.value = !state.isFiltering.value;
          if (!state.isFiltering.value) state.text.value = state.node.value = "";
        }}
      >
        Filter
      </Button>
      <Button
        small
        icon={state.frozen.value === null ? "pause" : "play"}
        onClick={() => state.pause(state.frozen.value === null)}
      >
        {state.frozen.value === null ? "Pause" : "Follow"}
      </Button>
      <Button small onClick={() => state.clear()}>
        Clear
      </Button>
    </>
  );
}

export const logPanel: Panel = { id: "log", title: "Log", programs: ["rqt_console"], component: Log, actions: Actions };
