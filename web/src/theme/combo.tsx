/** Text field with a list of known values: topics, frames. Other values are accepted, too. */

import type { JSX, TargetedKeyboardEvent } from "preact";
import { useId, useRef, useState } from "preact/hooks";

import { placeBelow } from "./menu_list";

export interface Choice {
  readonly value: string;
  readonly detail?: string;
}

export interface ComboProps {
  readonly label: string;
  readonly value: string;
  readonly choices: () => readonly Choice[];
  readonly onCommit: (value: string) => void;
}

export function Combo({ label, value, choices, onCommit }: ComboProps): JSX.Element {
  const [draft, setDraft] = useState<string | null>(null);
  const [at, setAt] = useState(-1);
  const id = useId();
  const anchor = useRef<HTMLSpanElement>(null);
  const matches = draft === null ? [] : matching(choices(), draft === value ? "" : draft);
  const leave = (): void => {
    setDraft(null);
    setAt(-1);
  };
  const commit = (text: string): void => {
    leave();
    if (text !== value) onCommit(text);
  };
  const keyDown = (event: TargetedKeyboardEvent<HTMLInputElement>): void => {
    const step = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    if (step !== 0 && !event.altKey) {
      setDraft(draft ?? value);
      setAt(Math.max(-1, Math.min(matches.length - 1, at + step)));
    } else if (event.key === "Enter") commit(matches[at]?.value ?? draft ?? value);
    else if (event.key === "Escape") {
      leave();
      event.currentTarget.blur();
    } else return;
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <span ref={anchor} class="complete">
      <span class="field small bare">
        <input
          role="combobox"
          aria-label={label}
          aria-expanded={matches.length > 0}
          aria-controls={id}
          aria-autocomplete="list"
          aria-activedescendant={at >= 0 ? `${id}-${at}` : undefined}
          value={draft ?? value}
          spellcheck={false}
          autocomplete="off"
          onFocus={(event) => {
            event.currentTarget.select();
            setDraft(value);
          }}
          onInput={(event) => {
            setDraft(event.currentTarget.value);
            setAt(-1);
          }}
          onBlur={() => commit(draft ?? value)}
          onKeyDown={keyDown}
        />
      </span>
      <span
        id={id}
        role="listbox"
        aria-label={label}
        class={matches.length > 0 ? "menu" : "sr"}
        ref={(list) => put(list, anchor.current)}
      >
        {matches.map((choice, index) => (
          <span
            key={choice.value}
            id={`${id}-${index}`}
            role="option"
            aria-selected={index === at}
            onPointerDown={(event) => {
              event.preventDefault();
              commit(choice.value);
            }}
          >
            {choice.value}
            {choice.detail !== undefined && <span class="r">{choice.detail}</span>}
          </span>
        ))}
      </span>
    </span>
  );
}

function put(list: HTMLElement | null, anchor: HTMLElement | null): void {
  if (list !== null && anchor !== null && list.classList.contains("menu")) placeBelow(list, anchor);
}

/** Choices that contain a text; those that begin with it first. */
function matching(choices: readonly Choice[], text: string): readonly Choice[] {
  const query = text.toLowerCase();
  const rank = (choice: Choice): number => choice.value.toLowerCase().indexOf(query);
  return choices.filter((choice) => rank(choice) >= 0).sort((a, b) => Number(rank(a) > 0) - Number(rank(b) > 0));
}
