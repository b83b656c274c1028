/** One plot, drawn by uPlot: each curve with times of its own, a left and a right axis. */

import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";

import { significant, timeText } from "../messages/format";
import type { Curve } from "./curve";
import type { Line } from "./line";
import { paddedRange, type Range } from "./plot";
import type { PlotsState } from "./plots_state";
import { COLORS, isDashed, REFERENCE_DASH } from "./style";

interface PlotCanvasProps {
  readonly state: PlotsState;
  readonly curves: readonly Curve[];
  readonly theme: string;
}

const PERIOD = 40; // ms between drawings
const DASH = [4, 3];
const AXIS_WIDTH = 48; // px, at least
const DIGIT = 6.5; // px
const GAP = 6; // px
/* eslint-disable @typescript-eslint/no-unsafe-enum-assignment -- uPlot declares const enums, which are not there at run time */
const FACETED: uPlot.Mode = 2;
const LEFT: uPlot.Axis.Side = 3;
const RIGHT: uPlot.Axis.Side = 1;
/* eslint-enable */
const EMPTY = new Float64Array(0);

export function PlotCanvas({ state, curves, theme }: PlotCanvasProps): JSX.Element {
  const box = useRef<HTMLDivElement>(null);
  const axes = curves.map((curve) => curve.axis.value).join();
  const units = curves.map((curve) => curve.unit.value).join();
  const held = curves.map((curve) => curve.isHeld.value).join();
  const lines = state.lines(curves);
  const names = lines.map(({ name }) => name).join(", ");
  useEffect(() => {
    const element = box.current;
    if (element === null) return;
    const plot = new uPlot(options(element, state, lines), emptyData(lines), element);
    const fit = new ResizeObserver(() => plot.setSize({ width: element.clientWidth, height: element.clientHeight }));
    fit.observe(element);
    const stop = keepDrawing(plot, state, lines);
    return () => {
      stop();
      fit.disconnect();
      plot.destroy();
    };
  }, [state, curves, theme, axes, units, held, names, state.mode.value, state.reference.value]);
  return <div ref={box} class="canvas" role="img" aria-label={`Plot of ${names}`} />;
}

/** Draw when points came or the range changed; returns a function that stops. */
function keepDrawing(plot: uPlot, state: PlotsState, lines: readonly Line[]): () => void {
  let drawn = "";
  const draw = (): void => {
    const range = state.range();
    const key = [
      ...range,
      state.isPaused.peek() ? "" : lines.map(({ curve }) => curve.revision).join(),
      plot.width,
      plot.height,
      state.cursor.peek(),
      state.shownTime(),
    ].join(" ");
    if (key === drawn) return;
    drawn = key;
    show(plot, lines, range);
  };
  let frame = 0;
  let last = 0;
  const loop = (time: number): void => {
    frame = requestAnimationFrame(loop);
    if (time - last < PERIOD) return;
    last = time;
    draw();
  };
  frame = requestAnimationFrame(loop);
  return () => cancelAnimationFrame(frame);
}

function show(plot: uPlot, lines: readonly Line[], [from, to]: Range): void {
  const parts = lines.map(({ between }) => between(from, to));
  plot.batch(() => {
    plot.setData([EMPTY, ...parts] as unknown as uPlot.AlignedData, false);
    plot.setScale("x", { min: from, max: to });
    for (const axis of ["left", "right"] as const) {
      const values = parts.filter((_, index) => lines[index]?.curve.axis.peek() === axis).map(([, ys]) => ys);
      const [min, max] = paddedRange(values);
      plot.setScale(axis, { min, max });
    }
  });
}

function emptyData(lines: readonly Line[]): uPlot.AlignedData {
  return [EMPTY, ...lines.map(() => [EMPTY, EMPTY])] as unknown as uPlot.AlignedData;
}

function options(element: HTMLElement, state: PlotsState, lines: readonly Line[]): uPlot.Options {
  const style = getComputedStyle(element);
  const color = (name: string): string => style.getPropertyValue(name).trim();
  const axis = {
    stroke: color("--text-3"),
    font: `11px ${style.fontFamily}`,
    grid: { stroke: color("--line-soft"), width: 1 },
    ticks: { show: false },
    gap: GAP,
  };
  const hasRight = lines.some(({ curve }) => curve.axis.peek() === "right");
  const value = (side: uPlot.Axis.Side, scale: "left" | "right"): uPlot.Axis => ({
    ...axis,
    side,
    scale,
    size: (_plot, texts) => axisWidth(texts),
    grid: scale === "left" ? axis.grid : { show: false },
    show: scale === "left" || hasRight,
    values: (_plot, splits) => splits.map((split) => significant(split, 5)),
  });
  return {
    mode: FACETED,
    width: element.clientWidth,
    height: element.clientHeight,
    padding: [8, hasRight ? 0 : 12, 0, 0],
    legend: { show: false },
    scales: { x: { time: false, auto: false }, left: { auto: false }, right: { auto: false } },
    axes: [
      {
        ...axis,
        scale: "x",
        size: 22,
        values: (_plot, splits, _axis, _space, step) => splits.map((split) => timeText(split, decimals(step))),
      },
      value(LEFT, "left"),
      value(RIGHT, "right"),
    ],
    series: [{}, ...lines.map((line) => series(line, color))],
    cursor: {
      y: false,
      points: { show: false },
      dataIdx: () => null,
      drag: { x: true, y: false, setScale: false },
    },
    hooks: {
      draw: [
        (plot) => {
          drawTime(plot, state.cursor.peek(), color("--text-3"));
          drawTime(plot, state.shownTime(), color("--accent"));
        },
      ],
      setCursor: [
        (plot) => {
          const { left = -1 } = plot.cursor;
          state.cursor.value = left < 0 ? null : plot.posToVal(left, "x");
        },
      ],
      setSelect: [
        (plot) => {
          const { left, width } = plot.select;
          if (width < 4) return;
          state.zoom.value = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")];
          plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        },
      ],
    },
  };
}

/** A line at a time, across the plot. */
function drawTime({ ctx, bbox, ...plot }: uPlot, time: number | null, color: string): void {
  const { min, max } = plot.scales["x"] ?? {};
  if (time === null || min == null || max == null || time < min || time > max) return;
  const x = Math.round(bbox.left + ((time - min) / (max - min)) * bbox.width);
  ctx.save();
  ctx.fillStyle = color;
  ctx.fillRect(x, bbox.top, Math.max(1, Math.round(window.devicePixelRatio)), bbox.height);
  ctx.restore();
}

/** Room for the longest text [px]; uPlot asks before there are texts, too. */
function axisWidth(texts: readonly string[] | null): number {
  return Math.max(AXIS_WIDTH, ...(texts ?? []).map((text) => Math.ceil(DIGIT * text.length + GAP)));
}

function series({ curve, index, isReference }: Line, color: (name: string) => string): uPlot.Series {
  const drawn: uPlot.Series = {
    stroke: color(COLORS[index % COLORS.length] ?? ""),
    width: 1.5,
    points: { show: false },
    facets: [
      { scale: "x", auto: false },
      { scale: curve.axis.peek(), auto: false },
    ],
  };
  const { linear, stepped } = uPlot.paths;
  const paths = curve.isHeld.peek() ? stepped?.({ align: 1, extend: true }) : linear?.();
  if (paths !== undefined) drawn.paths = paths;
  if (isReference) drawn.dash = REFERENCE_DASH;
  else if (isDashed(index)) drawn.dash = DASH;
  return drawn;
}

/** Decimals that tell ticks apart. */
function decimals(step: number): number {
  return step >= 1 ? 0 : Math.min(6, Math.ceil(-Math.log10(step)));
}
