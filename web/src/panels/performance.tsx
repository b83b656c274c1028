/** Time spent per simulated second: physics, sensors and plugins by name, ROS, the page, waiting. */

import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";

import type { Profile } from "../protocol/generated/page_messages";
import { count, fixed } from "../theme/format";
import { SteadyNumber } from "../theme/steady_number";
import type { Panel, PanelProps } from "./panel";
import { barOf, GROUP_NAMES, performanceState, rowsOf, sparkline, type Row } from "./performance/performance_state";
import { useShown } from "./use";

function Performance({ page }: PanelProps): JSX.Element {
  const state = performanceState(page);
  const root = useRef<HTMLDivElement>(null);
  const isShown = useShown(root);
  useEffect(() => {
    if (!isShown) return;
    const subscription = state.follow();
    return () => subscription.close();
  }, [state, isShown]);
  const profile = state.profile.value;
  const rows = profile === null ? [] : rowsOf(profile);
  return (
    <div class="stack" ref={root}>
      {profile === null || rows.length === 0 ? (
        <div class="empty">{emptyText(page.session.kind, page.world.state.value?.paused === true)}</div>
      ) : (
        <>
          <Head profile={profile} factors={state.factors.value} isPaused={page.world.state.value?.paused === true} />
          <Bar rows={rows} />
          <div class="scroll">
            <Table rows={rows} />
          </div>
        </>
      )}
    </div>
  );
}

function emptyText(kind: string, isPaused: boolean): string {
  if (kind !== "simulation") return "Nothing is simulated here.";
  return isPaused ? "The simulation is paused: play it to measure its time." : "Measuring the first second …";
}

interface HeadProps {
  readonly profile: Profile;
  readonly factors: readonly number[];
  readonly isPaused: boolean;
}

function Head({ profile, factors, isPaused }: HeadProps): JSX.Element {
  const factor = fixed(factors.at(-1), 2);
  const label = `Real-time factor over the last ${count(factors.length, "second")}: now ${factor}, minimum ${fixed(Math.min(...factors), 2)}`;
  return (
    <dl class="figures">
      <Figure name="Real-time factor" value={factor}>
        <svg class="sparkline" viewBox="0 0 100 20" preserveAspectRatio="none" role="img" aria-label={label}>
          <polyline points={sparkline(factors)} />
        </svg>
      </Figure>
      <Figure name="Steps" value={fixed(profile.steps / profile.wall_s, 0)} unit="1/s" />
      <Figure name="Contacts" value={String(profile.contacts)} />
      <Figure name="Bodies" value={String(profile.bodies)} />
      <Figure name="Asleep" value={String(profile.asleep)} />
      {profile.graph_s !== null && (
        <Figure name="ROS thread" value={fixed((100 * profile.graph_s) / profile.wall_s, 0)} unit="% of a core" />
      )}
      {isPaused && <span class="dim">paused</span>}
    </dl>
  );
}

/** Length of a usual figure: "12345". */
const FIGURE_LENGTH = 5;

function Figure({
  name,
  value,
  unit,
  children,
}: {
  readonly name: string;
  readonly value: string;
  readonly unit?: string;
  readonly children?: JSX.Element;
}): JSX.Element {
  return (
    <div>
      <dt>{name}</dt>
      <dd>
        <SteadyNumber text={value} length={FIGURE_LENGTH} />
        {unit !== undefined && <i class="unit">{unit}</i>}
      </dd>
      {children}
    </div>
  );
}

/** One simulated second, as wide as the wall time it took. */
function Bar({ rows }: { readonly rows: readonly Row[] }): JSX.Element {
  const total = rows.reduce((sum, row) => sum + row.perSecond, 0);
  const words = barOf(rows)
    .filter(({ share }) => share >= 0.005)
    .map((row) => `${row.name} ${fixed(100 * row.share, 0)} %`);
  return (
    <div class="secondrow">
      <div
        class="second"
        role="img"
        aria-label={`One simulated second takes ${fixed(total, 0)} ms: ${words.join(", ")}`}
      >
        {barOf(rows).map((row) => (
          <i
            key={`${row.group} ${row.name}`}
            data-group={row.group}
            style={{ flexGrow: row.perSecond }}
            title={`${row.name}: ${fixed(row.perSecond, 2)} ms, ${fixed(100 * row.share, 1)} %`}
          />
        ))}
      </div>
      <span class="sm t2">
        {fixed(total, 0)}
        <i class="unit">ms</i>
      </span>
    </div>
  );
}

function Table({ rows }: { readonly rows: readonly Row[] }): JSX.Element {
  return (
    <table class="data parts">
      <caption class="sr">Wall time per simulated second</caption>
      <thead>
        <tr>
          <th scope="col">Name</th>
          <th scope="col">Part</th>
          <th scope="col" class="num">
            ms / simulated s
          </th>
          <th scope="col" class="num">
            Share
          </th>
        </tr>
      </thead>
      <tbody>
        {rows.map((row) => (
          <tr key={`${row.group} ${row.name}`}>
            <td title={row.name}>
              <i class="part" data-group={row.group} />
              {row.name}
            </td>
            <td class="t2">{GROUP_NAMES[row.group]}</td>
            <td class="num">{fixed(row.perSecond, 2)}</td>
            <td class="num">{fixed(100 * row.share, 1)} %</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export const performancePanel: Panel = {
  id: "performance",
  title: "Performance",
  programs: [],
  component: Performance,
};
