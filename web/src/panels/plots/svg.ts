/** Plots as an SVG picture on white, for papers and reports. */

import { significant, timeText } from "../messages/format";
import type { Line } from "./line";
import { paddedRange, type Range } from "./plot";
import { isDashed, REFERENCE_DASH } from "./style";

const WIDTH = 800;
const HEIGHT = 260;
const LEFT = 64;
const RIGHT = 56;
const TOP = 28;
const BOTTOM = 28;
const TICKS = 5;
const COLORS = ["#007a87", "#a66000", "#7b3fc4", "#3f7f1f"];

/** `plots`: lines of each plot. */
export function svgText(plots: readonly (readonly Line[])[], range: Range): string {
  const height = HEIGHT * plots.length;
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${WIDTH}" height="${height}" viewBox="0 0 ${WIDTH} ${height}" font-family="sans-serif" font-size="11">
<rect width="${WIDTH}" height="${height}" fill="#fff"/>
${plots.map((plot, index) => `<g transform="translate(0 ${index * HEIGHT})">\n${plotText(plot, range)}\n</g>`).join("\n")}
</svg>
`;
}

function plotText(lines: readonly Line[], range: Range): string {
  const [from, to] = range;
  const x = (time: number): number => LEFT + ((time - from) / (to - from)) * (WIDTH - LEFT - RIGHT);
  const parts = [
    `<rect x="${LEFT}" y="${TOP}" width="${WIDTH - LEFT - RIGHT}" height="${HEIGHT - TOP - BOTTOM}" fill="none" stroke="#999"/>`,
  ];
  for (const time of ticks(range)) parts.push(label(x(time), HEIGHT - BOTTOM + 16, "middle", timeText(time)));
  for (const side of ["left", "right"] as const) {
    const sideLines = lines.filter(({ curve }) => curve.axis.peek() === side);
    if (sideLines.length === 0) continue;
    const values = paddedRange(sideLines.map(({ between }) => between(from, to)[1]));
    const y = (value: number): number =>
      HEIGHT - BOTTOM - ((value - values[0]) / (values[1] - values[0])) * (HEIGHT - TOP - BOTTOM);
    for (const value of ticks(values)) {
      parts.push(
        side === "left"
          ? label(LEFT - 6, y(value) + 4, "end", significant(value, 5))
          : label(WIDTH - RIGHT + 6, y(value) + 4, "start", significant(value, 5)),
      );
    }
    for (const line of sideLines) {
      const { index, isReference } = line;
      const points = drawnPoints(line, range).map(([time, value]) => `${x(time).toFixed(2)},${y(value).toFixed(2)}`);
      const dashes = isReference ? REFERENCE_DASH.join(" ") : isDashed(index) ? "4 3" : "";
      const dash = dashes === "" ? "" : ` stroke-dasharray="${dashes}"`;
      parts.push(
        `<polyline clip-path="inset(0)" fill="none" stroke="${color(index)}" stroke-width="1.5"${dash} points="${points.join(" ")}"/>`,
      );
    }
  }
  const named = lines.filter(({ isReference }) => !isReference);
  named.forEach(({ curve, index, name }) => {
    const unit = curve.unit.peek() === "" ? "" : ` [${curve.unit.peek()}]`;
    const at = LEFT + (index * (WIDTH - LEFT - RIGHT)) / named.length;
    parts.push(`<text x="${at.toFixed(1)}" y="${TOP - 10}" fill="${color(index)}">${escaped(name + unit)}</text>`);
  });
  if (named.length < lines.length) parts.push(label(WIDTH - RIGHT, TOP - 10, "end", "dotted: reference"));
  return parts.join("\n");
}

/** Points of a line; a held value has a second point at the next value's time, the last one at the range's end. */
function drawnPoints({ curve, between }: Line, [from, to]: Range): readonly (readonly [number, number])[] {
  const [xs, ys] = between(from, to);
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
