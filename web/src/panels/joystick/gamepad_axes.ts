/** Reorders a browser's gamepad as Linux, and so `joy`, orders the axes and buttons of common gamepads. */

/** Axes −1 … 1, left and forward positive; buttons 0 and 1. */
export interface JoyState {
  readonly axes: readonly number[];
  readonly buttons: readonly (0 | 1)[];
}

export const AXIS_NAMES = [
  "Left stick, left",
  "Left stick, up",
  "LT",
  "Right stick, left",
  "Right stick, up",
  "RT",
  "Cross, left",
  "Cross, up",
] as const;
export const BUTTON_NAMES = [
  "A",
  "B",
  "X",
  "Y",
  "LB",
  "RB",
  "Back",
  "Start",
  "Guide",
  "Left stick",
  "Right stick",
] as const;

/** A gamepad that nobody touches: triggers rest at 1. */
export const AT_REST: JoyState = { axes: [0, 0, 1, 0, 0, 1, 0, 0], buttons: BUTTON_NAMES.map(() => 0) };

/** Buttons of the Gamepad API's standard mapping, in the order of `BUTTON_NAMES`. */
const BUTTON_ORDER = [0, 1, 2, 3, 4, 5, 8, 9, 16, 10, 11] as const;
const PRESSED = 0.5;

/** @param sticks left x, left y, right x, right y; right and back are positive.
 *  @param buttons 0 … 1, in the standard mapping: triggers are 6 and 7, the cross 12 to 15 (up, down, left, right). */
export function joyFromGamepad(sticks: readonly number[], buttons: readonly number[]): JoyState {
  const axis = (index: number): number => clean(-(sticks[index] ?? 0));
  const value = (index: number): number => buttons[index] ?? 0;
  const isDown = (index: number): 0 | 1 => (value(index) > PRESSED ? 1 : 0);
  return {
    axes: [
      axis(0),
      axis(1),
      1 - 2 * value(6),
      axis(2),
      axis(3),
      1 - 2 * value(7),
      isDown(14) - isDown(15),
      isDown(12) - isDown(13),
    ],
    buttons: BUTTON_ORDER.map(isDown),
  };
}

function clean(value: number): number {
  return Math.min(1, Math.max(-1, value === 0 ? 0 : value));
}
