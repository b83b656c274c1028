/** Curves of a plot with their values: at the cursor, at the end of a paused plot, or the newest. */

import type { JSX } from "preact";

import { MenuButton } from "../../theme/menu";
import type { MenuItem } from "../../theme/menu_list";
import { fixed } from "../../theme/format";
import { Name } from "../../theme/name";
import { SteadyNumber } from "../../theme/steady_number";
import { significant } from "../messages/format";
import { useTick } from "../use";
import type { Curve } from "./curve";
import { valueAt, type Line } from "./line";
import type { Plot } from "./plot";
import type { PlotsState } from "./plots_state";
import { COLORS, isDashed } from "./style";

const PERIOD = 200; // ms
/** Ratio of a curve's largest value below which a value is written as 0. */
const UNSEEN = 1e-4;
/** Length of "−0.123". */
const VALUE_LENGTH = 6;

export function Legend({ state, plot }: { readonly state: PlotsState; readonly plot: Plot }): JSX.Element {
  useTick(PERIOD);
  const time = state.cursor.value ?? state.shownTime() ?? state.pausedAt;
  const lines = state.lines(plot.curves);
  return (
    <ul class="legend" aria-label="Curves">
      {lines
        .filter(({ isReference }) => !isReference)
        .map((line) => (
          <LegendRow
            key={line.curve.path}
            state={state}
            plot={plot}
            line={line}
            names={lines.map(({ curve }) => curve.name)}
            reference={lines.find(({ curve, isReference }) => isReference && curve === line.curve)}
            time={time ?? line.curve.points.lastX}
          />
        ))}
    </ul>
  );
}

interface LegendRowProps {
  readonly state: PlotsState;
  readonly plot: Plot;
  readonly line: Line;
  /** Names of all curves. */
  readonly names: readonly string[];
  /** Line of the recording that the world is compared with. */
  readonly reference: Line | undefined;
  /** Time of the values [s]; null: there is none yet. */
  readonly time: number | null;
}

function LegendRow({ state, plot, line, names, reference, time }: LegendRowProps): JSX.Element {
  const { curve, index } = line;
  const textOf = (of: Line): string => {
    const value = time === null ? null : valueAt(of, time);
    return value === null ? "—" : legendText(value, largest(of, state));
  };
  const color = { "--c": `var(${COLORS[index % COLORS.length] ?? ""})` };
  return (
    <li class={isDashed(index) ? "dash" : ""} style={color}>
      <span class="n" title={line.name}>
        <Name text={curve.name} beside={names} />
      </span>
      <span class="num">
        <b>
          <SteadyNumber text={textOf(line)} length={VALUE_LENGTH} />
        </b>{" "}
        {curve.unit.value !== "" && <span class="unit">{curve.unit.value}</span>}
      </span>
      <MenuButton label={`Curve ${curve.path}`} icon="dots" class="sml" items={() => items(state, plot, curve)} />
      <span class="t">
        {curve.fault.value === "" ? curve.caption : <span class="warned">{curve.fault.value}</span>}
      </span>
      {line.name !== curve.path && <span class="t">difference from the reference</span>}
      {reference !== undefined && (
        <span class="t referenced">
          reference{" "}
          <span class="num">
            <SteadyNumber text={textOf(reference)} length={VALUE_LENGTH} />
          </span>
        </span>
      )}
    </li>
  );
}

/** Largest absolute value that is shown. */
function largest({ between }: Line, state: PlotsState): number {
  return between(...state.range())[1].reduce((max, y) => Math.max(max, Math.abs(y)), 0);
}

/** Value whose number of decimals depends on the largest value, so that it keeps its width; 0 if negligible. */
export function legendText(value: number, largest: number): string {
  const size = Math.abs(value) < UNSEEN * largest ? 0 : Math.abs(value);
  if (size !== 0 && size < 0.001) return significant(value, 2);
  if (size >= 100_000) return significant(value);
  return fixed(Math.sign(value) * size, size < 10 ? 3 : size < 1000 ? 2 : 0);
}

function items(state: PlotsState, plot: Plot, curve: Curve): readonly MenuItem[] {
  const others = state.plots.value.filter((other) => other.id !== plot.id);
  return [
    { title: "Left axis", checked: curve.axis.value === "left", run: () => void (curve.axis.value = "left") },
    { title: "Right axis", checked: curve.axis.value === "right", run: () => void (curve.axis.value = "right") },
    { title: "Move to a new plot", disabled: plot.curves.length < 2, run: () => state.separate(curve) },
    ...others.map((other) => ({
      title: `Move to the plot of ${other.curves[0]?.name ?? "none"}`,
      run: () => state.move(curve, other.id),
    })),
    { title: "Remove", icon: "close", run: () => state.remove(curve) },
  ];
}
