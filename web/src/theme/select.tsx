/** A choice of words: the browser's own list, in the page's look. */

import type { JSX } from "preact";

import { Icon } from "./icons";

export interface SelectProps {
  readonly label: string;
  readonly value: string;
  readonly choices: readonly string[];
  readonly disabled?: boolean;
  readonly onChange: (value: string) => void;
}

export function Select({ label, value, choices, disabled, onChange }: SelectProps): JSX.Element {
  const all = choices.includes(value) ? choices : [value, ...choices];
  return (
    <span class="choice">
      <select
        aria-label={label}
        value={value}
        disabled={disabled}
        onChange={(event) => onChange(event.currentTarget.value)}
      >
        {all.map((choice) => (
          <option key={choice} value={choice}>
            {choice}
          </option>
        ))}
      </select>
      <Icon name="down" />
    </span>
  );
}
