/** Mouse, touch and keyboard input of the scene, with rviz's bindings. */

import { LongPress } from "../theme/long_press";
import type { ThreeScene } from "./three_scene";
import type { ViewList } from "./views/view_list";

/** Zoom per pixel of a drag and of a wheel. */
const DRAG_ZOOM = 0.01;
const WHEEL_ZOOM = 0.0012;
const LINE = 16;
/** Shorter drags of the pointer are clicks [px]. */
const CLICK = 4;
/** Drag that an arrow key stands for [px]. */
const KEY_TURN = 20;
const KEY_PAN = 40;
const KEY_ZOOM = 0.85;
const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [1, 0],
  ArrowRight: [-1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** Event of mouse, pen or finger for a tool. */
export interface PointerInput {
  readonly x: number;
  readonly y: number;
  readonly button: number;
  readonly shift: boolean;
  readonly control: boolean;
  readonly kind: "down" | "move" | "up" | "cancel";
}

interface Point {
  readonly x: number;
  readonly y: number;
}

interface Finger {
  x: number;
  y: number;
}

export class SceneInput {
  private readonly fingers = new Map<number, Finger>();
  private button = 0;
  private toolHasDrag = false;
  private distance = 0;
  /** Middle of two fingers and their distance at the last frame [px]. */
  private hand: { readonly x: number; readonly y: number; readonly spread: number } | null = null;
  private readonly longPress = new LongPress();
  private readonly stop: () => void;
  private readonly aborts = new AbortController();

  /**
   * `tool`: offers an event to the current tool; true: it was the tool's. `menu`: opens the menu of what is under a
   * point of the scene [px], or of the selection.
   */
  constructor(
    private readonly scene: ThreeScene,
    private readonly views: ViewList,
    private readonly tool: (input: PointerInput) => boolean,
    private readonly menu: (at: Point | null) => void = () => undefined,
  ) {
    const { element } = scene;
    this.stop = scene.onTick(() => this.pinch());
    const options = { signal: this.aborts.signal };
    element.addEventListener("pointerdown", (event) => this.down(event), options);
    element.addEventListener("pointermove", (event) => this.move(event), options);
    element.addEventListener("pointerup", (event) => this.up(event, "up"), options);
    element.addEventListener("pointercancel", (event) => this.up(event, "cancel"), options);
    element.addEventListener("mousedown", (event) => event.preventDefault(), options); // a menu that opened keeps the focus
    element.addEventListener("contextmenu", (event) => this.contextMenu(event), options);
    element.addEventListener("wheel", (event) => this.wheel(event), { ...options, passive: false });
    element.addEventListener("keydown", (event) => this.key(event), options);
  }

  dispose(): void {
    this.aborts.abort();
    this.stop();
  }

  private offer(event: PointerEvent | MouseEvent, kind: PointerInput["kind"], button: number): boolean {
    return this.tool({
      x: event.offsetX,
      y: event.offsetY,
      button,
      shift: event.shiftKey,
      control: event.ctrlKey,
      kind,
    });
  }

  private down(event: PointerEvent): void {
    this.scene.element.focus({ preventScroll: true });
    this.scene.element.setPointerCapture(event.pointerId);
    const isFirst = this.fingers.size === 0;
    this.longPress.end();
    this.fingers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    this.pinch(); // here, since the next frame may be late
    if (isFirst) this.scene.panes.press(event.offsetX, event.offsetY);
    this.views.active.peek().interrupt(); // before the tool: the tool may move the camera
    if (isFirst) {
      this.button = event.button;
      this.distance = 0;
      this.toolHasDrag = this.offer(event, "down", event.button);
      const at = { x: event.offsetX, y: event.offsetY };
      if (!this.toolHasDrag) this.longPress.begin(event, () => this.rest(at));
    } else if (this.toolHasDrag) {
      this.offer(event, "cancel", this.button);
      this.toolHasDrag = false;
    }
  }

  private move(event: PointerEvent): void {
    const finger = this.fingers.get(event.pointerId);
    if (finger === undefined) {
      this.offer(event, "move", -1);
      return;
    }
    const [dx, dy] = [event.offsetX - finger.x, event.offsetY - finger.y];
    this.distance += Math.hypot(dx, dy);
    this.longPress.move(event);
    if (this.fingers.size === 1 && this.toolHasDrag) this.offer(event, "move", this.button);
    else if (this.fingers.size === 1) this.drag(dx, dy, event.shiftKey);
    finger.x = event.offsetX;
    finger.y = event.offsetY;
  }

  private up(event: PointerEvent, kind: "up" | "cancel"): void {
    this.longPress.end();
    this.pinch();
    if (!this.fingers.delete(event.pointerId) || this.fingers.size > 0) return;
    this.leave(event, kind);
    this.scene.panes.release();
  }

  /** Handle the last finger's release. */
  private leave(event: PointerEvent, kind: "up" | "cancel"): void {
    // the tool also gets clicks whose press it left to the camera
    const isClick = kind === "up" && this.distance < CLICK;
    if (this.toolHasDrag || isClick) this.offer(event, kind, this.button);
    if (isClick && this.button === 2 && !this.toolHasDrag) this.menu({ x: event.offsetX, y: event.offsetY });
    this.toolHasDrag = false;
  }

  /** Handle a long press, which is no click. */
  private rest(at: Point): void {
    this.distance = CLICK;
    this.menu(at);
  }

  /** Open the menu by the keyboard's menu key; buttons and fingers open it on release or long press. */
  private contextMenu(event: MouseEvent): void {
    event.preventDefault();
    if (event.button !== 2 && this.fingers.size === 0) this.menu(null);
  }

  private drag(dx: number, dy: number, shift: boolean): void {
    const { picture, current } = this.views.active.peek();
    const view = current.peek();
    if (this.button === 1 || (this.button === 0 && shift)) view.pan(dx, dy, picture);
    else if (this.button === 0) view.rotate(dx, dy);
    else if (shift) view.raise(dy);
    else view.zoom(Math.exp(DRAG_ZOOM * dy));
  }

  /** Pan by the middle of two fingers, zoom by their distance; once a frame, as each has its own events. */
  private pinch(): void {
    const [a, b] = [...this.fingers.values()];
    const { hand } = this;
    this.hand = null;
    if (a === undefined || b === undefined || this.fingers.size > 2) return;
    this.hand = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, spread: Math.max(1, Math.hypot(a.x - b.x, a.y - b.y)) };
    if (hand === null || (hand.x === this.hand.x && hand.y === this.hand.y && hand.spread === this.hand.spread)) return;
    const { picture, current } = this.views.active.peek();
    const view = current.peek();
    view.pan(this.hand.x - hand.x, this.hand.y - hand.y, picture);
    view.zoom(hand.spread / this.hand.spread);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const { pointed } = this.views;
    pointed.interrupt();
    const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE : 1);
    pointed.view.peek().zoom(Math.exp(WHEEL_ZOOM * Math.max(-300, Math.min(300, pixels))));
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const active = this.views.active.peek();
    const view = active.view.peek();
    const arrow = ARROWS[event.key];
    if (arrow !== undefined) {
      const [x, y] = arrow;
      if (event.shiftKey) view.pan(x * KEY_PAN, y * KEY_PAN, active.picture);
      else view.rotate(x * KEY_TURN, y * KEY_TURN);
    } else if (event.key === "+" || event.key === "=") view.zoom(KEY_ZOOM);
    else if (event.key === "-") view.zoom(1 / KEY_ZOOM);
    else return;
    active.interrupt();
    event.preventDefault();
  }
}
