/** A stick: drag it, or hold the arrow keys; it returns to the middle. */

import type { JSX } from "preact";

interface StickProps {
  readonly label: string;
  /** Right and up positive, −1 … 1. */
  readonly x: number;
  readonly y: number;
  readonly onMove: (x: number, y: number) => void;
}

const REACH = 38; // of the drawing's 100
const KEYS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

export function Stick({ label, x, y, onMove }: StickProps): JSX.Element {
  const drag = (event: PointerEvent & { readonly currentTarget: SVGSVGElement }): void => {
    if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
    const box = event.currentTarget.getBoundingClientRect();
    const reach = (box.width * REACH) / 100;
    const [dx, dy] = [event.clientX - box.left - box.width / 2, box.top + box.height / 2 - event.clientY];
    const scale = 1 / Math.max(reach, Math.hypot(dx, dy));
    onMove(dx * scale, dy * scale);
  };
  return (
    <svg
      class="stick"
      viewBox="0 0 100 100"
      role="slider"
      aria-label={label}
      aria-valuemin={-1}
      aria-valuemax={1}
      aria-valuenow={y}
      aria-valuetext={`${x.toFixed(2)} right, ${y.toFixed(2)} up`}
      tabindex={0}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        drag(event);
      }}
      onPointerMove={drag}
      onPointerUp={() => onMove(0, 0)}
      onPointerCancel={() => onMove(0, 0)}
      onBlur={() => onMove(0, 0)}
      onKeyDown={(event) => {
        const direction = KEYS[event.key];
        if (direction === undefined) return;
        event.preventDefault();
        onMove(...direction);
      }}
      onKeyUp={(event) => KEYS[event.key] !== undefined && onMove(0, 0)}
    >
      <circle class="ring" cx="50" cy="50" r="48" />
      <path class="cross" d="M50 8V92M8 50H92" />
      <circle class="knob" cx={50 + x * REACH} cy={50 - y * REACH} r="13" />
    </svg>
  );
}
