/** The list of commands, and the keys that run them. */

import { computed, signal, type ReadonlySignal } from "@preact/signals";

import type { Command, Commands } from "../page/page";

export class CommandList implements Commands {
  private readonly added = signal<readonly (readonly Command[])[]>([]);
  readonly all: ReadonlySignal<readonly Command[]> = computed(() => this.added.value.flat());

  add(...commands: readonly Command[]): () => void {
    this.added.value = [...this.added.peek(), commands];
    return () => {
      this.added.value = this.added.peek().filter((other) => other !== commands);
    };
  }

  /** Run the command of these keys; false: no command with these keys can run now. */
  press(keys: string): boolean {
    const command = this.all.peek().find((command) => command.keys === keys && (command.enabled?.() ?? true));
    command?.run();
    return command !== undefined;
  }
}

/** Keys of an event as commands name them: `Space`, `Shift R`, `Ctrl K`, `?`. */
export function keysOf(
  event: Pick<KeyboardEvent, "key" | "code" | "ctrlKey" | "metaKey" | "shiftKey" | "altKey">,
): string {
  const { key } = event;
  const isLetter = /^[a-z]$/i.test(key);
  const name = key === " " ? "Space" : isLetter ? key.toUpperCase() : key;
  const shift = event.shiftKey && (isLetter || key.length > 1) ? "Shift " : "";
  return `${event.ctrlKey || event.metaKey ? "Ctrl " : ""}${event.altKey ? "Alt " : ""}${shift}${name}`;
}

const MOVES_A_SLIDER = /^(Arrow|Page|Home|End)/;

/** True if the focused element takes the key: a field, a list, a menu, a control. */
export function takesKeys(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target.isContentEditable || target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement)
    return true;
  if (target instanceof HTMLInputElement && target.type === "range") return MOVES_A_SLIDER.test(key);
  if (target instanceof HTMLInputElement) return target.type !== "checkbox" || key === " ";
  if (target.closest('[role="menu"], [role="dialog"]') !== null) return true;
  return (key === " " || key === "Enter") && target.closest("button, a, [role=treeitem], [role=tab]") !== null;
}

/** Run commands by keys until the returned function is called; Space presses a button only if the keyboard focused it. */
export function listenForKeys(commands: CommandList): () => void {
  const events = new AbortController();
  const options = { signal: events.signal };
  let pressed: HTMLButtonElement | null = null;
  let isPressing = false;
  const click = ({ detail }: MouseEvent): void => {
    const focused = document.activeElement;
    pressed = detail > 0 && focused instanceof HTMLButtonElement ? focused : null;
  };
  const keyDown = (event: KeyboardEvent): void => {
    if (event.key === "Tab") pressed = null;
    const keys = keysOf(event);
    const isPressedButton = event.key === " " && pressed !== null && event.target === pressed;
    const isTyping = keys !== "Ctrl K" && !isPressedButton && takesKeys(event.target, event.key);
    const isDialogOpen = document.querySelector("dialog[open]") !== null; // the focus may be outside: a button that is disabled loses it
    if (event.defaultPrevented || isDialogOpen || isTyping || !commands.press(keys)) return;
    event.preventDefault();
    isPressing = isPressedButton;
  };
  const keyUp = (event: KeyboardEvent): void => {
    if (isPressing && event.key === " ") event.preventDefault(); // Firefox would press the button again
    isPressing = false;
  };
  addEventListener("click", click, options);
  addEventListener("keydown", keyDown, options);
  addEventListener("keyup", keyUp, options);
  return () => events.abort();
}
