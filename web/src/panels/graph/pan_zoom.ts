/** A drawing that is moved with one pointer and scaled with two, the wheel or the keyboard. */

import { signal } from "@preact/signals";

export interface ViewBox {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

const STEP = 1.2;
const LARGEST = 4; // largest scale: px of the screen per px of the drawing
const LARGEST_FIT = 1;

export class PanZoom {
  /** Visible part of the drawing; null: all of it, fitted. */
  readonly view = signal<ViewBox | null>(null);
  private readonly pointers = new Map<number, readonly [number, number]>();

  /** Visible part in an element of a size. */
  current(content: readonly [number, number], room: readonly [number, number]): ViewBox {
    const view = this.view.value;
    if (view !== null) return view;
    const scale = Math.min(LARGEST_FIT, room[0] / content[0], room[1] / content[1]);
    const [width, height] = [room[0] / scale, room[1] / scale];
    return { x: (content[0] - width) / 2, y: (content[1] - height) / 2, width, height };
  }

  fit(): void {
    this.view.value = null;
  }

  /** Scale by a factor about a point, given as shares of the element. */
  zoom(from: ViewBox, factor: number, across: number, down: number, room: number): void {
    const width = Math.max(room / LARGEST, from.width / factor);
    const height = (from.height * width) / from.width;
    this.view.value = {
      x: from.x + (from.width - width) * across,
      y: from.y + (from.height - height) * down,
      width,
      height,
    };
  }

  wheel(event: WheelEvent, from: ViewBox, box: DOMRect): void {
    event.preventDefault();
    const factor = Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015));
    this.zoom(from, factor, (event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height, box.width);
  }

  down(event: PointerEvent): void {
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  /** Pan with one pointer; scale with two by the change of their distance. */
  move(event: PointerEvent, from: ViewBox, box: DOMRect): void {
    const last = this.pointers.get(event.pointerId);
    if (last === undefined) return;
    const now = [event.clientX, event.clientY] as const;
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    this.pointers.set(event.pointerId, now);
    if (other !== undefined) {
      const factor = distance(now, other) / Math.max(1, distance(last, other));
      this.zoom(from, factor, (other[0] - box.left) / box.width, (other[1] - box.top) / box.height, box.width);
      return;
    }
    const scale = from.width / box.width;
    this.view.value = { ...from, x: from.x - (now[0] - last[0]) * scale, y: from.y - (now[1] - last[1]) * scale };
  }

  up(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
  }

  /** Arrows move, + and − scale, 0 fits; true: the key was one of these. */
  key(key: string, from: ViewBox, room: number): boolean {
    const moves: Readonly<Record<string, readonly [number, number]>> = {
      ArrowLeft: [-0.1, 0],
      ArrowRight: [0.1, 0],
      ArrowUp: [0, -0.1],
      ArrowDown: [0, 0.1],
    };
    const move = moves[key];
    if (move !== undefined)
      this.view.value = { ...from, x: from.x + move[0] * from.width, y: from.y + move[1] * from.height };
    else if (key === "+" || key === "=") this.zoom(from, STEP, 0.5, 0.5, room);
    else if (key === "-") this.zoom(from, 1 / STEP, 0.5, 0.5, room);
    else if (key === "0") this.fit();
    else return false;
    return true;
  }
}

function distance(one: readonly [number, number], other: readonly [number, number]): number {
  return Math.hypot(one[0] - other[0], one[1] - other[1]);
}
