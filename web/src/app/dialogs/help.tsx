/** Help: every key of the page. */

import type { JSX } from "preact";

import { Dialog } from "./dialog";
import type { Command } from "../../page/page";
import type { Shell } from "../shell";

/** Keys and gestures that are no commands. */
const FIXED: readonly (readonly [string, readonly (readonly [string, string])[]])[] = [
  [
    "Camera",
    [
      ["Left drag", "Turn"],
      ["Middle drag, Shift left drag", "Move sideways"],
      ["Wheel, right drag", "Zoom"],
      ["Right click, long press, Shift F10", "Menu of a model, in a simulation"],
      ["Ctrl drag on a part", "Pull it by a spring, in a simulation"],
      ["Arrows, + −", "Turn and zoom, when the scene has the focus"],
    ],
  ],
  [
    "Drive",
    [
      ["W A S D", "Drive while held"],
      ["U I O J L M , .", "Drive while held, when the disc has the focus"],
      ["Gamepad", "The left stick"],
    ],
  ],
  [
    "Trees",
    [
      ["↑ ↓", "Move"],
      ["← →", "Close and open"],
      ["Enter", "Frame it, or edit its value"],
      ["Space", "Show or hide"],
      ["F2, Delete, Alt ↑ ↓", "Rename, remove, move a display"],
      ["Delete", "Close the focused panel"],
    ],
  ],
];

export function Help({ shell }: { readonly shell: Shell }): JSX.Element {
  const { commands, page } = shell;
  const groups = new Map<string, Command[]>();
  for (const command of commands.all.value) {
    if (command.keys === undefined || command.enabled?.() === false) continue;
    groups.set(command.group, [...(groups.get(command.group) ?? []), command]);
  }
  return (
    <Dialog title="Keys" class="help" onClose={() => (shell.dialog.value = null)}>
      <div class="scroll columns" tabIndex={0}>
        {[...groups].map(([group, list]) => (
          <Group key={group} title={group} entries={list.map(({ keys = "", title }) => [keys, title])} />
        ))}
        {FIXED.map(([title, entries]) => (
          <Group key={title} title={title} entries={entries} />
        ))}
      </div>
      <div class="foot">
        <span class="sm t2">
          Trundle {page.session.version}. Foxglove and Lichtblick connect to{" "}
          <span class="src">{page.session.foxglove}</span>
        </span>
      </div>
    </Dialog>
  );
}

function Group({
  title,
  entries,
}: {
  readonly title: string;
  readonly entries: readonly (readonly [string, string])[];
}): JSX.Element {
  return (
    <section>
      <h3>{title}</h3>
      <dl>
        {entries.map(([keys, description]) => (
          <div key={keys + description}>
            <dt>{description}</dt>
            <dd>
              <kbd>{keys.replace("Escape", "Esc")}</kbd>
            </dd>
          </div>
        ))}
      </dl>
    </section>
  );
}
