/** The palette: every command by name. */

import { useComputed, useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";

import { Icon } from "../../theme/icons";
import { Dialog } from "./dialog";
import type { Command } from "../../page/page";
import type { Shell } from "../shell";

export function Palette({ shell }: { readonly shell: Shell }): JSX.Element {
  const text = useSignal("");
  const at = useSignal(0);
  const list = useRef<HTMLDivElement>(null);
  const matches = useComputed(() => search(shell.commands.all.value, text.value)); // computed, since Enter may come before the list is drawn
  const close = (): void => {
    shell.dialog.value = null;
  };
  const run = (command: Command | undefined): void => {
    if (command === undefined) return;
    close();
    command.run();
  };
  useEffect(
    () => list.current?.querySelector('[aria-selected="true"]')?.scrollIntoView({ block: "nearest" }),
    [at.value, text.value],
  );
  const keyDown = (event: KeyboardEvent): void => {
    const step = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    if (event.key === "Enter") run(matches.value[at.value]);
    else if (step !== 0) at.value = Math.max(0, Math.min(matches.value.length - 1, at.value + step));
    else return;
    event.preventDefault();
  };
  return (
    <Dialog title="Search commands" class="palette" onClose={close}>
      <label class="field find">
        <Icon name="find" />
        <input
          role="combobox"
          aria-label="Search commands"
          aria-expanded="true"
          aria-controls="palette-list"
          aria-activedescendant={matches.value.length > 0 ? `palette-${at.value}` : undefined}
          placeholder="Search commands"
          autoFocus
          onInput={(event) => {
            text.value = event.currentTarget.value;
            at.value = 0;
          }}
          onKeyDown={keyDown}
        />
      </label>
      <div ref={list} id="palette-list" class="scroll" role="listbox" aria-label="Commands">
        {matches.value.map((command, index) => (
          <div
            key={command.id}
            id={`palette-${index}`}
            role="option"
            class="command"
            aria-selected={index === at.value}
            onClick={() => run(command)}
          >
            <span>{command.title}</span>
            <span class="r">{command.group}</span>
            {command.keys !== undefined && <kbd>{command.keys.replace("Escape", "Esc")}</kbd>}
          </div>
        ))}
      </div>
      {matches.value.length === 0 && <p class="empty">No matching command.</p>}
    </Dialog>
  );
}

/** Commands that can run and whose title has all the words; those that begin with the text first. */
export function search(commands: readonly Command[], text: string): readonly Command[] {
  const words = text
    .toLowerCase()
    .split(/\s+/)
    .filter((word) => word !== "");
  const titles = new Set<string>();
  return commands
    .filter(
      (command) =>
        (command.enabled?.() ?? true) &&
        words.every((word) => `${command.title} ${command.group}`.toLowerCase().includes(word)),
    )
    .filter(({ title }) => !titles.has(title) && titles.add(title))
    .sort(
      (a, b) =>
        Number(!a.title.toLowerCase().startsWith(text.toLowerCase())) -
        Number(!b.title.toLowerCase().startsWith(text.toLowerCase())),
    );
}
