/** A message as an expandable tree. */

import type { JSX } from "preact";
import { useState } from "preact/hooks";

import type { RosMessage } from "../../protocol/ros_types";
import { Tree, type TreeRow } from "../../theme/tree";
import { messageRows, type MessageRow } from "./message_rows";

export interface MessageTreeProps {
  readonly label: string;
  /** Datatype, for units; empty: unknown. */
  readonly type: string;
  readonly message: RosMessage;
}

const OPEN_DEPTH = 2;

/** Tree that opens its first levels; rows that a person opened or closed stay that way while messages come. */
export function MessageTree({ label, type, message }: MessageTreeProps): JSX.Element {
  const [toggled, setToggled] = useState<ReadonlyMap<string, boolean>>(new Map());
  const [selected, setSelected] = useState<string | null>(null);
  const isOpen = (key: string, depth: number): boolean =>
    toggled.get(key) ?? (depth < OPEN_DEPTH && !key.endsWith("]") && key !== ".header");
  const rows = messageRows(type, message, isOpen).map((row) => treeRow(row, row.key === selected));
  return (
    <Tree
      label={label}
      rows={rows}
      onSelect={setSelected}
      onToggle={(key, open) => setToggled(new Map(toggled).set(key, open))}
      onActivate={(key) => setToggled(new Map(toggled).set(key, rows.find((row) => row.key === key)?.open === false))}
    />
  );
}

function treeRow(row: MessageRow, selected: boolean): TreeRow {
  return {
    key: row.key,
    depth: row.depth,
    label: `${row.name} ${row.text} ${row.unit}`.trim(),
    open: row.open,
    selected,
    content: (
      <>
        <span class="t2">{row.name}</span>
        <span class="value">
          {row.text}
          {row.unit !== "" && <span class="unit">{row.unit}</span>}
        </span>
      </>
    ),
  };
}
