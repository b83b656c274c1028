/** A number with its unit; arrows change it by a step, Shift by ten. */

import type { ComponentChildren, JSX } from "preact";

import { fixed, parseNumber, plain } from "./format";
import { TextField } from "./text_field";

export interface NumberFieldProps {
  readonly label: string;
  readonly value: number;
  /** Fixed decimals; absent: as many as the number needs. */
  readonly decimals?: number;
  readonly unit?: string | undefined;
  readonly min?: number | undefined;
  readonly max?: number | undefined;
  readonly integer?: boolean;
  readonly class?: string;
  readonly disabled?: boolean;
  readonly before?: ComponentChildren;
  readonly onCommit: (value: number) => void;
  /** Called when Enter is pressed in a valid number, after it is committed. */
  readonly onEnter?: (() => void) | undefined;
}

/** Error sentence if a text is not a number within the limits; null: valid. */
export function numberFault(text: string, limits: Pick<NumberFieldProps, "min" | "max" | "integer">): string | null {
  const value = parseNumber(text);
  if (value === null) return `"${text}" is not a number.`;
  if (limits.integer === true && !Number.isInteger(value)) return "Enter a whole number.";
  if (limits.min !== undefined && value < limits.min) return `At least ${plain(limits.min)}.`;
  if (limits.max !== undefined && value > limits.max) return `At most ${plain(limits.max)}.`;
  return null;
}

export function NumberField(props: NumberFieldProps): JSX.Element {
  const { label, value, decimals, unit, min = -Infinity, max = Infinity, integer = false, onCommit } = props;
  const step = (event: KeyboardEvent, text: string): string | null => {
    const direction = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
    if (direction === 0 || event.altKey) return null;
    const size = (integer ? 1 : 10 ** -(decimals ?? (Math.abs(value) < 1 ? 2 : 1))) * (event.shiftKey ? 10 : 1);
    return String(
      Math.min(max, Math.max(min, Number(((parseNumber(text) ?? value) + direction * size).toPrecision(12)))),
    );
  };
  return (
    <TextField
      label={unit === undefined ? label : `${label} [${unit}]`}
      value={decimals === undefined ? plain(value) : fixed(value, decimals)}
      check={(text) => numberFault(text, props)}
      onCommit={(text) => {
        const number = parseNumber(text);
        if (number !== null && number !== value) onCommit(number);
      }}
      onEnter={props.onEnter}
      onKey={step}
      class={props.class ?? ""}
      disabled={props.disabled ?? false}
      before={props.before}
      after={unit === undefined ? null : <span class="unit">{unit}</span>}
    />
  );
}
