/** A line of text that is applied by Enter or by leaving it; Esc leaves it as it was. */

import type { ComponentChildren, JSX, TargetedKeyboardEvent } from "preact";
import { useRef, useState } from "preact/hooks";

export interface TextFieldProps {
  readonly label: string;
  readonly value: string;
  /** A sentence if the text cannot be taken, else null. */
  readonly check?: (text: string) => string | null;
  readonly onCommit: (text: string) => void;
  readonly class?: string;
  readonly placeholder?: string;
  readonly disabled?: boolean;
  readonly before?: ComponentChildren;
  readonly after?: ComponentChildren;
  /** Keys that are not the field's own; arrows of a number field. */
  readonly onKey?: (event: KeyboardEvent, text: string) => string | null;
}

export function TextField(props: TextFieldProps): JSX.Element {
  const { label, value, check = () => null, onCommit, placeholder, disabled, before, after, onKey } = props;
  const [draft, setDraft] = useState<string | null>(null);
  const input = useRef<HTMLInputElement>(null);
  const fault = draft === null ? null : check(draft);
  const commit = (): void => {
    if (draft !== null && fault === null && draft !== value) onCommit(draft);
    setDraft(null);
  };
  const keyDown = (event: TargetedKeyboardEvent<HTMLInputElement>): void => {
    const changed = onKey?.(event, event.currentTarget.value) ?? null;
    if (changed !== null) {
      event.preventDefault();
      setDraft(null);
      onCommit(changed);
    } else if (event.key === "Enter") {
      if (fault === null) commit();
      input.current?.select();
    } else if (event.key === "Escape") {
      setDraft(null);
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
          value={draft ?? value}
          placeholder={placeholder}
          disabled={disabled}
          spellcheck={false}
          autocomplete="off"
          onFocus={(event) => event.currentTarget.select()}
          onInput={(event) => setDraft(event.currentTarget.value)}
          onBlur={commit}
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
