/** Keys and gamepads that drive. */

import { takesKeys } from "../commands";
import type { Drive, DriveInput } from "../../page/drive";

/** W A S D anywhere on the page, unless a field has the focus. */
export const WASD: Readonly<Record<string, DriveInput>> = {
  w: { linear: 1, angular: 0 },
  a: { linear: 0, angular: 1 },
  s: { linear: -1, angular: 0 },
  d: { linear: 0, angular: -1 },
};

/** Keys of teleop_twist_keyboard and arrows, while the disc has the focus. */
const TELEOP: Readonly<Record<string, DriveInput>> = {
  u: { linear: 1, angular: 1 },
  i: { linear: 1, angular: 0 },
  o: { linear: 1, angular: -1 },
  j: { linear: 0, angular: 1 },
  l: { linear: 0, angular: -1 },
  m: { linear: -1, angular: -1 },
  ",": { linear: -1, angular: 0 },
  ".": { linear: -1, angular: 1 },
  arrowup: { linear: 1, angular: 0 },
  arrowdown: { linear: -1, angular: 0 },
  arrowleft: { linear: 0, angular: 1 },
  arrowright: { linear: 0, angular: -1 },
};

const DEAD_ZONE = 0.15;

/** Listen until the returned function is called; without `pads`, gamepads are ignored, since a node reads them. */
export function listenToDriveKeys(drive: Drive, { pads = true } = {}): () => void {
  const keyDown = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey) {
      drive.releaseAll(); // some systems send no keyup while these are held
      return;
    }
    const input = driveKey(event);
    if (input === undefined || drive.topic.peek() === null) return;
    event.preventDefault();
    event.stopPropagation();
    if (!event.repeat) drive.hold(`key ${event.code}`, input.linear, input.angular);
  };
  const keyUp = (event: KeyboardEvent): void => drive.release(`key ${event.code}`);
  const all = (): void => drive.releaseAll();
  const hidden = (): void => {
    if (document.visibilityState === "hidden") drive.releaseAll();
  };
  const focus = (event: FocusEvent): void => {
    if (takesKeys(event.target, "w")) drive.releaseAll();
  };
  addEventListener("keydown", keyDown, true);
  addEventListener("keyup", keyUp, true);
  addEventListener("focusin", focus);
  addEventListener("blur", all);
  addEventListener("pagehide", all);
  document.addEventListener("visibilitychange", hidden);
  const stopPads = pads ? listenToGamepads(drive) : () => undefined;
  return () => {
    drive.releaseAll();
    removeEventListener("keydown", keyDown, true);
    removeEventListener("keyup", keyUp, true);
    removeEventListener("focusin", focus);
    removeEventListener("blur", all);
    removeEventListener("pagehide", all);
    document.removeEventListener("visibilitychange", hidden);
    stopPads();
  };
}

function driveKey(event: KeyboardEvent): DriveInput | undefined {
  const onDisc = event.target instanceof Element && event.target.closest(".disc") !== null;
  if (!onDisc && takesKeys(event.target, event.key)) return undefined;
  const key = event.key.toLowerCase();
  const physical = event.code.replace("Key", "").toLowerCase(); // for keyboards without Latin letters
  const latin = /^[a-z]$/.test(key) || key.length > 1 || !/^[a-z]$/.test(physical) ? key : physical;
  return event.shiftKey ? undefined : (WASD[latin] ?? (onDisc ? TELEOP[latin] : undefined));
}

const PAD_PERIOD = 50; // ms

/**
 * Drive by the left stick of any gamepad. A timer reads it, since slow pictures would delay its release; a stick drives
 * only after it was once at rest, so that a stuck stick does not drive.
 */
function listenToGamepads(drive: Drive): () => void {
  let timer: ReturnType<typeof setInterval> | undefined;
  const rested = new Set<number>();
  const poll = (): void => {
    const pads = navigator.getGamepads().filter((pad) => pad !== null);
    for (const pad of pads) {
      const [x = 0, y = 0] = pad.axes;
      const moved = Math.hypot(x, y) > DEAD_ZONE;
      if (!moved) rested.add(pad.index);
      if (moved && rested.has(pad.index) && document.hasFocus()) drive.hold(`pad ${pad.index}`, -y, -x);
      else drive.release(`pad ${pad.index}`);
    }
    if (pads.length === 0) stop();
  };
  const stop = (): void => {
    clearInterval(timer);
    timer = undefined;
  };
  const connected = (): void => {
    timer ??= setInterval(poll, PAD_PERIOD);
  };
  const onDisconnected = (event: GamepadEvent): void => {
    rested.delete(event.gamepad.index);
    drive.release(`pad ${event.gamepad.index}`);
  };
  addEventListener("gamepadconnected", connected);
  addEventListener("gamepaddisconnected", onDisconnected);
  return () => {
    stop();
    removeEventListener("gamepadconnected", connected);
    removeEventListener("gamepaddisconnected", onDisconnected);
  };
}
