/** A checkbox with a name. */

import type { JSX } from "preact";

export interface CheckboxProps {
  readonly label: string;
  readonly checked: boolean;
  readonly disabled?: boolean;
  readonly tabIndex?: number;
  readonly onChange: (checked: boolean) => void;
}

export function Checkbox({ label, checked, disabled, tabIndex, onChange }: CheckboxProps): JSX.Element {
  return (
    <input
      type="checkbox"
      class="cb"
      aria-label={label}
      checked={checked}
      disabled={disabled}
      tabIndex={tabIndex}
      onClick={(event) => onChange(event.currentTarget.checked)} // not `change`: by then a row's click has redrawn the old state
    />
  );
}
