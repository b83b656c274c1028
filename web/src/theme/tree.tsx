/** A tree of rows: arrows move, open and close; one row is in the tab order. */

import type { ComponentChildren, JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";

import { Icon } from "./icons";
import { LongPress } from "./long_press";

export interface TreeRow {
  readonly key: string;
  /** Depth; 0: the outermost. */
  readonly depth: number;
  /** Name for screen readers where the row's text is not enough. */
  readonly label?: string;
  /** Undefined: no children. */
  readonly open?: boolean | undefined;
  readonly selected?: boolean;
  readonly class?: string;
  readonly content: ComponentChildren;
}

export interface TreeProps {
  readonly label: string;
  readonly rows: readonly TreeRow[];
  readonly onToggle: (key: string, open: boolean) => void;
  readonly onSelect: (key: string) => void;
  readonly onHover?: (key: string | null) => void;
  readonly onActivate?: (key: string) => void;
  /** Opens a row's menu at a point of the page [px]. */
  readonly onMenu?: (key: string, x: number, y: number) => void;
  /** Keys that are not the tree's own. */
  readonly onKey?: (key: string, event: KeyboardEvent) => void;
}

export function Tree(props: TreeProps): JSX.Element {
  const { label, rows, onToggle, onSelect, onHover } = props;
  const [focused, setFocused] = useState<string | null>(null);
  const list = useRef<HTMLDivElement>(null);
  const latest = useRef(props);
  latest.current = props;
  const drawn = useRef(new WeakMap<TreeRow, { readonly isInOrder: boolean; readonly element: JSX.Element }>());
  const inOrder = rows.find((row) => row.key === focused) ?? rows.find((row) => row.selected) ?? rows[0];
  const elementOf = (key: string): HTMLElement | null =>
    list.current?.querySelector<HTMLElement>(`[data-key="${CSS.escape(key)}"]`) ?? null;
  const focus = (row: TreeRow | undefined): void => {
    if (row === undefined) return;
    setFocused(row.key);
    elementOf(row.key)?.focus();
  };
  const selected = rows.find((row) => row.selected)?.key;
  useEffect(() => {
    if (selected !== undefined) elementOf(selected)?.scrollIntoView({ block: "nearest" });
  }, [selected]);
  const keyDown = (event: KeyboardEvent): void => {
    const index = rows.findIndex((row) => row.key === focused);
    const row = rows[index];
    if (row === undefined || !(event.target instanceof HTMLElement) || event.target.dataset["key"] !== row.key) return;
    if (event.altKey || event.ctrlKey || event.metaKey) return props.onKey?.(row.key, event);
    if (event.key === "ArrowDown") focus(rows[index + 1]);
    else if (event.key === "ArrowUp") focus(rows[index - 1]);
    else if (event.key === "Home") focus(rows[0]);
    else if (event.key === "End") focus(rows.at(-1));
    else if (event.key === "ArrowRight" && row.open === false) onToggle(row.key, true);
    else if (event.key === "ArrowRight") focus(rows[index + 1]);
    else if (event.key === "ArrowLeft" && row.open === true) onToggle(row.key, false);
    else if (event.key === "ArrowLeft") focus(parentOf(rows, index));
    else if (event.key === "Enter") (props.onActivate ?? onSelect)(row.key);
    else return props.onKey?.(row.key, event);
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <div
      ref={list}
      class="tree"
      role="tree"
      aria-label={label}
      onKeyDown={keyDown}
      onPointerLeave={() => onHover?.(null)}
    >
      {rows.map((row) => {
        const isInOrder = row === inOrder;
        const known = drawn.current.get(row);
        if (known?.isInOrder === isInOrder) return known.element; // an unchanged row object is not drawn again
        const element = drawRow(row, isInOrder, setFocused, latest);
        drawn.current.set(row, { isInOrder, element });
        return element;
      })}
    </div>
  );
}

const longPress = new LongPress();

function isTouch(event: MouseEvent): boolean {
  return event instanceof PointerEvent && event.pointerType === "touch";
}

/** Position of a row's menu [px]. */
function below(row: HTMLElement): [number, number] {
  const { left, bottom } = row.getBoundingClientRect();
  return [left + 24, bottom];
}

/** Draw a row, whose handlers are the tree's current ones. */
function drawRow(
  row: TreeRow,
  isInOrder: boolean,
  setFocused: (key: string) => void,
  latest: { readonly current: TreeProps },
): JSX.Element {
  return (
    <div
      key={row.key}
      class={`${row.class ?? "row"}${row.selected === true ? " sel" : ""}`}
      style={{ "--d": row.depth }}
      role="treeitem"
      aria-level={row.depth + 1}
      aria-label={row.label}
      aria-expanded={row.open}
      aria-selected={row.selected ?? false}
      tabIndex={isInOrder ? 0 : -1}
      data-key={row.key}
      onFocus={() => setFocused(row.key)}
      onClick={() => latest.current.onSelect(row.key)}
      onDblClick={() => latest.current.onActivate?.(row.key)}
      onPointerEnter={() => latest.current.onHover?.(row.key)}
      onContextMenu={(event) => {
        const { onMenu } = latest.current;
        if (onMenu === undefined) return;
        event.preventDefault();
        if (event.button === 2) onMenu(row.key, event.clientX, event.clientY);
        else if (!isTouch(event)) onMenu(row.key, ...below(event.currentTarget)); // by the keyboard
      }}
      onPointerDown={(event) => {
        const { currentTarget } = event;
        longPress.begin(event, () => latest.current.onMenu?.(row.key, ...below(currentTarget)));
      }}
      onPointerMove={(event) => longPress.move(event)}
      onPointerUp={() => longPress.end()}
      onPointerCancel={() => longPress.end()}
    >
      {row.class === undefined && <Twist row={row} onToggle={(key, open) => latest.current.onToggle(key, open)} />}
      {row.content}
    </div>
  );
}

function Twist({ row, onToggle }: { readonly row: TreeRow; readonly onToggle: TreeProps["onToggle"] }): JSX.Element {
  return (
    <span
      class="twist"
      onClick={(event) => {
        if (row.open === undefined) return;
        event.stopPropagation();
        onToggle(row.key, !row.open);
      }}
    >
      <Icon name="right" class={row.open === undefined ? "tw n" : row.open ? "tw o" : "tw"} />
    </span>
  );
}

/** The nearest row above that is less deep. */
function parentOf(rows: readonly TreeRow[], index: number): TreeRow | undefined {
  const depth = rows[index]?.depth ?? 0;
  return rows.slice(0, index).findLast((row) => row.depth < depth);
}
