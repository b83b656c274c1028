/** The Displays page: rviz's tree, the drawer of new displays, and the file. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";

import type { Display } from "../../displays/display";
import { withMembers } from "../../displays/group";
import { Button } from "../../theme/button";
import { StatusShape } from "../../theme/status_shape";
import { Tree, type TreeRow } from "../../theme/tree";
import { AddDrawer } from "./add_drawer";
import { displayKey, displayRows, faultRow, type DisplayRowsOf } from "./display_rows";
import { globalRows } from "./global_rows";
import { changeProperty } from "../../page/change_property";
import { RvizFoot } from "./rviz_foot";
import type { Shell } from "../shell";

const REFRESH = 1000; // ms between updates of the rates

export function DisplaysPage({ shell }: { readonly shell: Shell }): JSX.Element {
  const { page } = shell;
  const { displays } = page;
  const adding = useSignal<boolean | null>(null); // null: open if no file sets displays and there is room
  const isOffering = page.session.rviz === null && page.session.kind !== "simulation" && !shell.layout.isPhone.value;
  const isAdding = adding.value ?? (isOffering && displays.offers.value.length > 0);
  const renaming = useSignal<Display | null>(null);
  useRates();
  const selected = shell.display.value;
  const isOpen = (key: string): boolean => shell.openDisplays.value.get(key) ?? !key.includes("/");
  const toggle = (key: string, open: boolean): void => {
    shell.openDisplays.value = new Map(shell.openDisplays.peek()).set(key, open);
  };
  const rows: DisplayRowsOf = {
    page,
    isOpen,
    onToggle: toggle,
    selected,
    renaming: renaming.value,
    onRenamed: () => (renaming.value = null),
  };
  const byKey = new Map(withMembers(displays.displays.value).map((display) => [displayKey(display), display]));
  const unsupported = displays.unsupported.value.flatMap(({ name, className, reason }, index) =>
    unsupportedRows(index, name || className, reason),
  );
  const keyDown = (key: string, event: KeyboardEvent): void => {
    const display = byKey.get(key);
    if (display === undefined) focusEditor(key, event);
    else keysOfDisplay(shell, display, event, () => (renaming.value = display));
  };
  return (
    <>
      <div class="scroll displays">
        <Tree
          label="Displays"
          rows={[
            ...globalRows(rows),
            ...displays.displays.value.flatMap((display) => displayRows(display, 0, rows)),
            ...unsupported,
          ]}
          onToggle={toggle}
          onSelect={(key) => (shell.display.value = byKey.get(key) ?? shell.display.peek())}
          onActivate={(key) => {
            if (byKey.has(key)) toggle(key, !isOpen(key));
            else focusInside(key);
          }}
          onKey={keyDown}
        />
      </div>
      {isAdding && <AddDrawer shell={shell} onClose={() => (adding.value = false)} />}
      <RvizFoot shell={shell} />
      <div class="foot edits">
        <Button icon="plus" tone="primary" class="add" onClick={() => (adding.value = !isAdding)}>
          Add
        </Button>
        <span class="sp" />
        <Button
          small
          disabled={selected === null}
          onClick={() => selected !== null && (shell.display.value = displays.duplicate(selected))}
        >
          Duplicate
        </Button>
        <Button small disabled={selected === null} onClick={() => (renaming.value = selected)}>
          Rename
        </Button>
        <Button small disabled={selected === null} onClick={() => selected !== null && remove(shell, selected)}>
          Remove
        </Button>
      </div>
    </>
  );
}

function useRates(): void {
  const [, refresh] = useState(0);
  useEffect(() => {
    const timer = setInterval(() => refresh((count) => count + 1), REFRESH);
    return () => clearInterval(timer);
  }, []);
}

function unsupportedRows(index: number, name: string, reason: string): TreeRow[] {
  const key = `unsupported/${index}`;
  const content = (
    <>
      <span class="cb none" />
      <StatusShape level="warn" label="Not supported" />
      <span class="n g">{name}</span>
      <span class="r">not supported</span>
    </>
  );
  return [{ key, depth: 0, content }, faultRow(`${key}/why`, 1, { level: "warn", text: reason })];
}

function remove(shell: Shell, display: Display): void {
  const list = shell.page.displays.displays.peek();
  const next = list[list.indexOf(display) + 1] ?? list[list.indexOf(display) - 1] ?? null;
  shell.page.displays.remove(display);
  shell.display.value = next;
}

/** Space shows or hides, Delete removes, F2 renames, Alt with arrows moves. */
function keysOfDisplay(shell: Shell, display: Display, event: KeyboardEvent, rename: () => void): void {
  const { displays } = shell.page;
  const at = displays.displays.peek().indexOf(display);
  if (event.altKey && (event.key === "ArrowUp" || event.key === "ArrowDown")) {
    const to = at + (event.key === "ArrowUp" ? -1 : 1);
    if (at >= 0 && to >= 0 && to < displays.displays.peek().length) displays.move(display, to);
  } else if (event.key === " ") changeProperty(shell.page, display.enabled, !display.enabled.value.peek());
  else if (event.key === "Delete") remove(shell, display);
  else if (event.key === "F2") rename();
  else return;
  event.preventDefault();
}

/** Space in a property's row presses its checkbox. */
function focusEditor(key: string, event: KeyboardEvent): void {
  if (event.key !== " ") return;
  event.preventDefault();
  const box = document.querySelector<HTMLInputElement>(`[data-key="${CSS.escape(key)}"] input[type="checkbox"]`);
  if (box === null) focusInside(key);
  else box.click();
}

function focusInside(key: string): void {
  document
    .querySelector<HTMLElement>(`[data-key="${CSS.escape(key)}"] :is(input:not([type="color"]), select)`)
    ?.focus();
}
