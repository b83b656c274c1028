/** Displays as rows of the tree: name, status, rate and color; below each, the reason of a fault and the properties. */

import type { JSX } from "preact";

import type { Display, Status } from "../../displays/display";
import { Group } from "../../displays/group";
import { ColorProperty } from "../../rviz/properties";
import { Checkbox } from "../../theme/checkbox";
import { fixed } from "../../theme/format";
import { Icon } from "../../theme/icons";
import { Name } from "../../theme/name";
import { StatusShape } from "../../theme/status_shape";
import { SteadyNumber } from "../../theme/steady_number";
import { TextField } from "../../theme/text_field";
import type { TreeRow } from "../../theme/tree";
import { isSilence } from "../notices/notices";
import type { Page } from "../../page/page";
import { changeProperty } from "../../page/change_property";
import { hex } from "./property_editor";
import { propertyRows, type RowsOf } from "./property_rows";

export interface DisplayRowsOf extends RowsOf {
  readonly selected: Display | null;
  readonly renaming: Display | null;
  readonly onRenamed: () => void;
}

let count = 0;
const keys = new WeakMap<Display, string>();

/** Unique key of a display. */
export function displayKey(display: Display): string {
  const known = keys.get(display) ?? `display/${(count += 1)}`;
  keys.set(display, known);
  return known;
}

export function displayRows(display: Display, depth: number, rows: DisplayRowsOf): TreeRow[] {
  const key = displayKey(display);
  const open = rows.isOpen(key);
  const faults = faultsOf(display).filter(([, status]) => open || !isSilence(status) || status.advice !== undefined);
  const below = open ? propertyRows(display.properties, key, depth + 1, rows) : [];
  const members =
    open && display instanceof Group ? display.displays.flatMap((member) => displayRows(member, depth + 1, rows)) : [];
  return [
    {
      key,
      depth,
      open,
      selected: rows.selected === display,
      content: <DisplayRow display={display} rows={rows} />,
    },
    ...faults.map(([name, status]) => faultRow(`${key}/${name}`, depth + 1, status)),
    ...below,
    ...members,
  ];
}

/** Statuses of a display that is on, other than OK. */
function faultsOf(display: Display): readonly (readonly [string, Status])[] {
  return display.enabled.value.value ? [...display.statuses.value].filter(([, status]) => status.level !== "ok") : [];
}

function isSilent(display: Display): boolean {
  const faults = faultsOf(display);
  return faults.length > 0 && faults.every(([, status]) => isSilence(status));
}

/** Row with the reason of a fault and the advice; "No transform" is emphasized. */
export function faultRow(key: string, depth: number, status: Status): TreeRow {
  const [head, rest] = splitFault(status.text);
  return {
    key,
    depth,
    class: "why",
    content: (
      <>
        <b class={status.level}>{head}</b>
        {rest}
        {status.advice !== undefined && <span class="advice">{status.advice}</span>}
      </>
    ),
  };
}

/** Emphasized words of a fault, and the rest: "No transform" and " from [amcl] to [map]". */
function splitFault(text: string): readonly [string, string] {
  const at = text.search(/ (from|for|of|\[)|:/);
  return at < 0 ? [text, ""] : [text.slice(0, at), text.slice(at)];
}

function DisplayRow({ display, rows }: { readonly display: Display; readonly rows: DisplayRowsOf }): JSX.Element {
  const { page } = rows;
  const color = display.properties.find(
    (property) => property instanceof ColorProperty && property.options.visible?.value !== false,
  );
  const isGroup = display instanceof Group;
  const rename = (name: string): void => {
    const before = display.name.peek();
    page.displays.edit(
      "Rename",
      () => (display.name.value = name),
      () => (display.name.value = before),
    );
    rows.onRenamed();
  };
  return (
    <>
      <Checkbox
        label={`Show ${display.name.value}`}
        checked={display.enabled.value.value}
        tabIndex={-1}
        onChange={(on) => changeProperty(page, display.enabled, on)}
      />
      {isGroup ? <Icon name="group" /> : <StatusShape level={isSilent(display) ? "none" : display.level} />}
      {rows.renaming === display ? (
        <Rename name={display.name.value} onCommit={rename} onLeave={rows.onRenamed} />
      ) : (
        <Name text={display.name.value} />
      )}
      <span class="r">
        <Rate page={page} display={display} />
      </span>
      {color !== undefined && <span class="sw" style={{ background: hex(color.value.value as readonly number[]) }} />}
    </>
  );
}

/** Length of a rate of up to 100 Hz. */
const RATE_LENGTH = 5;

function Rate({ page, display }: { readonly page: Page; readonly display: Display }): JSX.Element | null {
  if (!display.enabled.value.value) return null;
  if (display.className === "rviz/TF") return <>{page.frames.frames.value.length} frames</>;
  if (isSilent(display)) return <>no data</>;
  const { topic } = display;
  const rate = topic === null || topic === "" ? null : page.connection.statistics(topic).rate;
  if (rate === null || rate < 0.05) return null;
  return (
    <>
      <SteadyNumber text={fixed(rate, 1)} length={RATE_LENGTH} /> Hz
    </>
  );
}

interface RenameProps {
  readonly name: string;
  readonly onCommit: (name: string) => void;
  readonly onLeave: () => void;
}

function Rename({ name, onCommit, onLeave }: RenameProps): JSX.Element {
  return (
    <span class="renaming" ref={(element) => element?.querySelector("input")?.focus()} onFocusOut={onLeave}>
      <TextField
        label="Name"
        value={name}
        class="small"
        check={(text) => (text.trim() === "" ? "Enter a name." : null)}
        onCommit={(text) => onCommit(text.trim())}
      />
    </span>
  );
}
