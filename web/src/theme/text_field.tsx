/** Text field that commits on Enter or blur; Esc reverts. */

import type { ComponentChildren, JSX, TargetedKeyboardEvent } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";

export interface TextFieldProps {
  readonly label: string;
  readonly value: string;
  /** Returns an error sentence if the text is invalid, otherwise null. */
  readonly check?: (text: string) => string | null;
  readonly onCommit: (text: string) => void;
  /** Called when Enter is pressed in a valid text, after it is committed. */
  readonly onEnter?: (() => void) | undefined;
  readonly class?: string;
  readonly placeholder?: string;
  readonly disabled?: boolean;
  readonly before?: ComponentChildren;
  readonly after?: ComponentChildren;
  /** Handles further keys, as the arrows of a number field. */
  readonly onKey?: (event: KeyboardEvent, text: string) => string | null;
}

export function TextField(props: TextFieldProps): JSX.Element {
  const { label, value, check = () => null, onCommit, placeholder, disabled, before, after, onKey } = props;
  const [draft, setDraft] = useState<string | null>(null);
  /** Value at focus or click, which stays shown: a changing number would clear the selection before a person types. */
  const [committed, setCommitted] = useState<string | null>(null);
  const input = useRef<HTMLInputElement>(null);
  const fault = draft === null ? null : check(draft);
  const shown = draft ?? committed ?? value;
  const showValue = (): void => {
    setDraft(null);
    setCommitted(null);
  };
  /** Commit the browser's text, since a key may come before the last typed letter is drawn. */
  const commit = (text: string): void => {
    if (text !== (committed ?? value) && check(text) === null) onCommit(text);
    showValue();
  };
  useLayoutEffect(() => {
    if (draft === null && document.activeElement === input.current) input.current?.select();
  }, [shown]);
  const keyDown = (event: TargetedKeyboardEvent<HTMLInputElement>): void => {
    const changed = onKey?.(event, event.currentTarget.value) ?? null;
    if (changed !== null) {
      event.preventDefault();
      showValue();
      onCommit(changed);
    } else if (event.key === "Enter") {
      const isValid = check(event.currentTarget.value) === null;
      if (isValid) commit(event.currentTarget.value);
      if (isValid) props.onEnter?.();
      input.current?.select();
    } else if (event.key === "Escape") {
      event.currentTarget.value = committed ?? value;
      event.currentTarget.blur();
    } else return;
    event.stopPropagation();
  };
  return (
    <>
      <span class={`field ${props.class ?? ""}${fault === null ? "" : " wrong"}`}>
        {before}
        <input
          ref={input}
          aria-label={label}
          aria-invalid={fault !== null}
          value={shown}
          placeholder={placeholder}
          disabled={disabled}
          spellcheck={false}
          autocomplete="off"
          onFocus={(event) => {
            setCommitted(value);
            event.currentTarget.select();
          }}
          onClick={() => setCommitted(committed ?? value)}
          onInput={(event) => setDraft(event.currentTarget.value)}
          onBlur={(event) => commit(event.currentTarget.value)}
          onKeyDown={keyDown}
        />
        {after}
      </span>
      {fault !== null && (
        <span class="fault" role="alert">
          {fault}
        </span>
      )}
    </>
  );
}
