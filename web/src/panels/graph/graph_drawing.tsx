/** A graph of boxes and arrows: hovering lights up, the wheel scales, dragging moves. */

import type { JSX } from "preact";
import { useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";

import { layered } from "./layered_layout";
import type { PanZoom } from "./pan_zoom";
import { textWidth } from "./text_width";

export interface DrawnBox {
  readonly id: string;
  readonly name: string;
  /** A second line, smaller. */
  readonly caption?: string;
  /** Classes of the box: topic, warn, error. */
  readonly kind: string;
  /** Full description, for screen readers and the tooltip. */
  readonly title: string;
}

export interface DrawnArrow {
  readonly from: string;
  readonly to: string;
  readonly title: string;
}

interface GraphDrawingProps {
  readonly label: string;
  readonly boxes: readonly DrawnBox[];
  readonly arrows: readonly DrawnArrow[];
  /** Layout direction: left to right, top to bottom, or whichever fits the element. */
  readonly direction: "LR" | "TB" | "fit";
  readonly panZoom: PanZoom;
  readonly onSelect?: (id: string) => void;
}

const NAME_SIZE = 12;
const CAPTION_SIZE = 11;
const CAPTION_ROOM = 132; // px: captions change, boxes do not
const LINE = 26;
const WIDE = 2; // times as wide as high

export function GraphDrawing({
  label,
  boxes,
  arrows,
  direction: option,
  panZoom,
  onSelect,
}: GraphDrawingProps): JSX.Element {
  const svg = useRef<SVGSVGElement>(null);
  const [room, setRoom] = useState<readonly [number, number]>([1, 1]);
  const [lit, setLit] = useState<string | null>(null);
  useLayoutEffect(() => {
    const element = svg.current;
    if (element === null) return;
    const observer = new ResizeObserver(() =>
      setRoom([Math.max(1, element.clientWidth), Math.max(1, element.clientHeight)]),
    );
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  const direction = option === "fit" ? (room[0] > WIDE * room[1] ? "LR" : "TB") : option;
  const shape = JSON.stringify([
    direction,
    boxes.map((box) => [box.id, box.name, box.caption !== undefined]),
    arrows.map((arrow) => [arrow.from, arrow.to]),
  ]);
  const placed = useMemo(() => layered(boxes.map(sized), arrows, direction), [shape]);
  const view = panZoom.current([placed.width, placed.height], room);
  const box = (): DOMRect => svg.current?.getBoundingClientRect() ?? new DOMRect(0, 0, 1, 1);
  useLayoutEffect(() => {
    const element = svg.current;
    const wheel = (event: WheelEvent): void => panZoom.wheel(event, view, box());
    element?.addEventListener("wheel", wheel, { passive: false });
    return () => element?.removeEventListener("wheel", wheel);
  });
  const isLit = (id: string): boolean =>
    lit === null ||
    id === lit ||
    arrows.some(({ from, to }) => (from === lit && to === id) || (to === lit && from === id));
  return (
    <svg
      ref={svg}
      class="graph"
      role="group"
      aria-label={label}
      tabindex={0}
      viewBox={`${view.x} ${view.y} ${view.width} ${view.height}`}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        panZoom.down(event);
      }}
      onPointerMove={(event) => panZoom.move(event, view, box())}
      onPointerUp={(event) => panZoom.up(event)}
      onPointerCancel={(event) => panZoom.up(event)}
      onDblClick={() => panZoom.fit()}
      onKeyDown={(event) => panZoom.key(event.key, view, room[0]) && event.preventDefault()}
    >
      <defs>
        <marker
          id={`tip-${direction}`}
          viewBox="0 0 8 8"
          refX="7"
          refY="4"
          markerWidth="7"
          markerHeight="7"
          orient="auto-start-reverse"
        >
          <path class="tip-shape" d="M0 0.5L8 4L0 7.5z" />
        </marker>
      </defs>
      {arrows.map((arrow, index) => (
        <path
          key={`${arrow.from} ${arrow.to}`}
          class={
            lit === null || arrow.from === lit || arrow.to === lit
              ? lit === null
                ? "arrow"
                : "arrow lit"
              : "arrow faint"
          }
          d={placed.paths[index]}
          marker-end={`url(#tip-${direction})`}
        >
          <title>{arrow.title}</title>
        </path>
      ))}
      {boxes.map((drawn) => (
        <BoxShape
          key={drawn.id}
          drawn={drawn}
          centre={placed.boxes.get(drawn.id) ?? [0, 0]}
          faint={!isLit(drawn.id)}
          onHover={setLit}
          onSelect={onSelect}
        />
      ))}
    </svg>
  );
}

function sized(box: DrawnBox): { readonly id: string; readonly width: number; readonly height: number } {
  const name = textWidth(box.name, NAME_SIZE) + 20;
  return {
    id: box.id,
    width: box.caption === undefined ? name : Math.max(name, CAPTION_ROOM),
    height: box.caption === undefined ? LINE : LINE + 14,
  };
}

interface BoxShapeProps {
  readonly drawn: DrawnBox;
  readonly centre: readonly [number, number];
  readonly faint: boolean;
  readonly onHover: (id: string | null) => void;
  readonly onSelect: ((id: string) => void) | undefined;
}

function BoxShape({ drawn, centre: [x, y], faint, onHover, onSelect }: BoxShapeProps): JSX.Element {
  const { width, height } = sized(drawn);
  return (
    <g
      class={faint ? `box ${drawn.kind} faint` : `box ${drawn.kind}`}
      role="img"
      aria-label={drawn.title}
      transform={`translate(${x.toFixed(1)} ${y.toFixed(1)})`}
      onPointerEnter={() => onHover(drawn.id)}
      onPointerLeave={() => onHover(null)}
      onClick={() => onSelect?.(drawn.id)}
    >
      <title>{drawn.title}</title>
      <rect
        x={-width / 2}
        y={-height / 2}
        width={width}
        height={height}
        rx={drawn.kind.includes("topic") ? height / 2 : 4}
      />
      <text class="name" y={drawn.caption === undefined ? 4 : -3} font-size={NAME_SIZE}>
        {drawn.name}
      </text>
      {drawn.caption !== undefined && (
        <text class="caption" y={12} font-size={CAPTION_SIZE}>
          {drawn.caption}
        </text>
      )}
    </g>
  );
}
