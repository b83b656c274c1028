/** A slider from a lower to an upper value, filled from zero where zero lies between. */

import type { JSX } from "preact";

export interface SliderProps {
  readonly label: string;
  readonly value: number;
  readonly lower: number;
  readonly upper: number;
  /** The value as a screen reader says it. */
  readonly text: string;
  readonly disabled?: boolean;
  readonly onInput: (value: number) => void;
  /** The pointer or the key is let go. */
  readonly onRelease?: () => void;
}

export function Slider({ label, value, lower, upper, text, disabled, onInput, onRelease }: SliderProps): JSX.Element {
  const share = (at: number): number =>
    (upper > lower ? Math.min(1, Math.max(0, (at - lower) / (upper - lower))) : 0) * 100;
  const zero = share(0);
  const at = share(value);
  return (
    <div class={disabled === true ? "sl off" : "sl"}>
      {lower < 0 && upper > 0 && <span class="zero" style={{ left: `${zero}%` }} />}
      <span class="fill" style={{ left: `${Math.min(zero, at)}%`, width: `${Math.abs(at - zero)}%` }} />
      <span class="knob" style={{ left: `${at}%` }} />
      <input
        type="range"
        aria-label={label}
        aria-valuetext={text}
        min={lower}
        max={upper}
        step={(upper - lower) / 200}
        value={value}
        disabled={disabled}
        onInput={(event) => onInput(Number(event.currentTarget.value))}
        onPointerUp={onRelease}
        onKeyUp={onRelease}
        onBlur={onRelease}
      />
    </div>
  );
}
