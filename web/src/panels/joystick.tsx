/** A joystick for the node `joy`: a gamepad that is plugged in, or sticks and buttons on the page. */

import type { JSX } from "preact";
import { useEffect } from "preact/hooks";

import { canControl, VIEW_ONLY } from "../page/view_only";
import { fixed } from "../theme/format";
import { SteadyNumber } from "../theme/steady_number";
import { AXIS_NAMES, BUTTON_NAMES } from "./joystick/gamepad_axes";
import { joystickState, type JoystickState } from "./joystick/joystick_state";
import { Stick } from "./joystick/stick";
import type { Panel, PanelProps } from "./panel";

const LEFT = [0, 1] as const;
const RIGHT = [3, 4] as const;

function Joystick({ page }: PanelProps): JSX.Element {
  const state = joystickState(page);
  const isOffered = page.session.joystick && canControl(page);
  useEffect(() => {
    if (!isOffered) return;
    state.start();
    const rest = (): void => state.rest();
    addEventListener("blur", rest);
    return () => {
      removeEventListener("blur", rest);
      state.stop();
    };
  }, [state, isOffered]);
  if (!canControl(page)) return <div class="empty">{VIEW_ONLY}</div>;
  if (!isOffered) return <div class="empty">No node reads a joystick: start joy's joy_node.</div>;
  return (
    <div class="scroll">
      {state.fault.value !== "" && (
        <div class="fault pad" role="alert">
          {state.fault.value}
        </div>
      )}
      <div class="pad sm t2">{padText(state)}</div>
      <div class="joystick">
        <Stick
          label="Left stick"
          x={-axis(state, LEFT[0])}
          y={axis(state, LEFT[1])}
          onMove={(x, y) => move(state, LEFT, x, y)}
        />
        <div class="buttons" role="group" aria-label="Buttons">
          {BUTTON_NAMES.map((name, index) => (
            <HoldButton
              key={name}
              name={name}
              isDown={state.joy.value.buttons[index] === 1}
              onHold={(on) => state.setButton(index, on ? 1 : 0)}
            />
          ))}
        </div>
        <Stick
          label="Right stick"
          x={-axis(state, RIGHT[0])}
          y={axis(state, RIGHT[1])}
          onMove={(x, y) => move(state, RIGHT, x, y)}
        />
        <dl class="axes">
          {AXIS_NAMES.map((name, index) => (
            <div key={name}>
              <dt>{name}</dt>
              <dd>
                <SteadyNumber text={fixed(axis(state, index), 2)} length={5} />
              </dd>
            </div>
          ))}
        </dl>
      </div>
    </div>
  );
}

function padText(state: JoystickState): string {
  const name = state.gamepad.value;
  if (name !== null) return `${name} moves it.`;
  return isSecureContext
    ? "No gamepad is plugged in, or none of its buttons was pressed yet: drag the sticks."
    : "Browsers show gamepads only to pages that come by https or from localhost: drag the sticks.";
}

function axis(state: JoystickState, index: number): number {
  return state.joy.value.axes[index] ?? 0;
}

/** On the page's sticks, right and up are positive; in joy, left and forward are. */
function move(state: JoystickState, [across, along]: readonly [number, number], x: number, y: number): void {
  state.setAxis(across, x === 0 ? 0 : -x);
  state.setAxis(along, y);
}

interface HoldButtonProps {
  readonly name: string;
  readonly isDown: boolean;
  readonly onHold: (on: boolean) => void;
}

/** Button that is pressed while it is held down. */
function HoldButton({ name, isDown, onHold }: HoldButtonProps): JSX.Element {
  const isKey = (event: KeyboardEvent): boolean => event.key === " " || event.key === "Enter";
  return (
    <button
      type="button"
      class={isDown ? "b sml line on" : "b sml line"}
      aria-pressed={isDown}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        onHold(true);
      }}
      onPointerUp={() => onHold(false)}
      onPointerCancel={() => onHold(false)}
      onKeyDown={(event) => {
        if (!isKey(event)) return;
        event.preventDefault();
        onHold(true);
      }}
      onKeyUp={(event) => isKey(event) && onHold(false)}
      onBlur={() => onHold(false)}
    >
      {name}
    </button>
  );
}

export const joystickPanel: Panel = {
  id: "joystick",
  title: "Joystick",
  programs: ["joy", "joy_node"],
  component: Joystick,
};
