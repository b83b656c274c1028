/** State of the joystick, from a gamepad or from the page, and its publishing. */

import { signal } from "@preact/signals";

import type { Connection } from "../../protocol/connection";
import { perPage } from "../per_page";
import { sentence } from "../use";
import { AT_REST, joyFromGamepad, type JoyState } from "./gamepad_axes";

const PERIOD = 50; // ms, joy's 20 Hz
/**
 * Period at which an unchanged state is sent again [ms]: after a second without a message, the server's joystick
 * returns to rest.
 */
const RENEWAL = 250;

const REST = JSON.stringify([AT_REST.axes, AT_REST.buttons]);

export class JoystickState {
  readonly joy = signal<JoyState>(AT_REST);
  /** Name of the gamepad in use; null: the page's sticks are used. */
  readonly gamepad = signal<string | null>(null);
  readonly fault = signal("");
  private sent = REST;
  private sentAt = 0;
  private timer: ReturnType<typeof setInterval> | undefined;

  constructor(private readonly connection: Connection) {}

  /** Read gamepads, send what changed and renew what is held, until `stop`. */
  start(): void {
    this.timer ??= setInterval(() => this.poll(), PERIOD);
  }

  /** Let go of everything and stop. */
  stop(): void {
    clearInterval(this.timer);
    this.timer = undefined;
    this.rest();
  }

  rest(): void {
    this.joy.value = AT_REST;
    this.send();
  }

  setAxis(index: number, value: number): void {
    const { axes, buttons } = this.joy.peek();
    this.joy.value = { axes: axes.map((old, at) => (at === index ? value : old)), buttons };
  }

  setButton(index: number, value: 0 | 1): void {
    const { axes, buttons } = this.joy.peek();
    this.joy.value = { axes, buttons: buttons.map((old, at) => (at === index ? value : old)) };
  }

  private poll(): void {
    const pad = navigator.getGamepads().find((one) => one?.connected === true && one.mapping === "standard");
    const name = pad?.id ?? null;
    if (pad)
      this.joy.value = joyFromGamepad(
        pad.axes,
        pad.buttons.map((button) => button.value),
      );
    else if (this.gamepad.peek() !== null) this.joy.value = AT_REST;
    this.gamepad.value = name;
    this.send();
  }

  private send(): void {
    const { axes, buttons } = this.joy.peek();
    const text = JSON.stringify([axes, buttons]);
    const now = performance.now();
    const isDue = text !== REST && now - this.sentAt >= RENEWAL;
    if (text === this.sent && !isDue) return;
    this.sent = text;
    this.sentAt = now;
    this.connection.request("joystick", { axes, buttons }).then(
      () => void (this.fault.value = ""),
      (error: unknown) => void (this.fault.value = sentence(error)),
    );
  }
}

export const joystickState = perPage((page) => new JoystickState(page.connection));
