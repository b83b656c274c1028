/** Plots as an SVG picture on white, for papers and reports. */

import { significant, timeText } from "../messages/format";
import type { Curve } from "./curve";
import { paddedRange, type Plot, type Range } from "./plot";
import { isDashed } from "./style";

const WIDTH = 800;
const HEIGHT = 260;
const LEFT = 64;
const RIGHT = 56;
const TOP = 28;
const BOTTOM = 28;
const TICKS = 5;
const COLORS = ["#007a87", "#a66000", "#7b3fc4", "#3f7f1f"];

export function svgText(plots: readonly Plot[], range: Range): string {
  const height = HEIGHT * plots.length;
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${WIDTH}" height="${height}" viewBox="0 0 ${WIDTH} ${height}" font-family="sans-serif" font-size="11">
<rect width="${WIDTH}" height="${height}" fill="#fff"/>
${plots.map((plot, index) => `<g transform="translate(0 ${index * HEIGHT})">\n${plotText(plot, range)}\n</g>`).join("\n")}
</svg>
`;
}

function plotText({ curves }: Plot, range: Range): string {
  const [from, to] = range;
  const x = (time: number): number => LEFT + ((time - from) / (to - from)) * (WIDTH - LEFT - RIGHT);
  const parts = [
    `<rect x="${LEFT}" y="${TOP}" width="${WIDTH - LEFT - RIGHT}" height="${HEIGHT - TOP - BOTTOM}" fill="none" stroke="#999"/>`,
  ];
  for (const time of ticks(range)) parts.push(label(x(time), HEIGHT - BOTTOM + 16, "middle", timeText(time)));
  for (const side of ["left", "right"] as const) {
    const sideCurves = curves.filter((curve) => curve.axis.peek() === side);
    if (sideCurves.length === 0) continue;
    const values = paddedRange(sideCurves.map((curve) => curve.points.between(from, to)[1]));
    const y = (value: number): number =>
      HEIGHT - BOTTOM - ((value - values[0]) / (values[1] - values[0])) * (HEIGHT - TOP - BOTTOM);
    for (const value of ticks(values)) {
      parts.push(
        side === "left"
          ? label(LEFT - 6, y(value) + 4, "end", significant(value, 5))
          : label(WIDTH - RIGHT + 6, y(value) + 4, "start", significant(value, 5)),
      );
    }
    for (const curve of sideCurves) {
      const index = curves.indexOf(curve);
      const points = drawnPoints(curve, range).map(([time, value]) => `${x(time).toFixed(2)},${y(value).toFixed(2)}`);
      const dash = isDashed(index) ? ' stroke-dasharray="4 3"' : "";
      parts.push(
        `<polyline clip-path="inset(0)" fill="none" stroke="${color(index)}" stroke-width="1.5"${dash} points="${points.join(" ")}"/>`,
      );
    }
  }
  curves.forEach((curve, index) => {
    const unit = curve.unit.peek() === "" ? "" : ` [${curve.unit.peek()}]`;
    const at = LEFT + (index * (WIDTH - LEFT - RIGHT)) / curves.length;
    parts.push(
      `<text x="${at.toFixed(1)}" y="${TOP - 10}" fill="${color(index)}">${escaped(curve.path + unit)}</text>`,
    );
  });
  return parts.join("\n");
}

/** Points of a line; a held value has the next one's time, too, and the last one the range's end. */
function drawnPoints(curve: Curve, [from, to]: Range): readonly (readonly [number, number])[] {
  const [xs, ys] = curve.points.between(from, to);
  return Array.from(xs, (time, at) => {
    const value = ys[at] ?? 0;
    const end = Math.max(time, xs[at + 1] ?? to);
    return curve.isHeld.peek()
      ? ([
          [time, value],
          [end, value],
        ] as const)
      : ([[time, value]] as const);
  }).flat();
}

function color(index: number): string {
  return COLORS[index % COLORS.length] ?? "#000";
}

function ticks([from, to]: Range): readonly number[] {
  return Array.from({ length: TICKS }, (_, index) => from + ((to - from) * index) / (TICKS - 1));
}

function label(x: number, y: number, anchor: string, text: string): string {
  return `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}" fill="#444">${escaped(text)}</text>`;
}

function escaped(text: string): string {
  return text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
}
