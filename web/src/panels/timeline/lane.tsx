/** Row of the timeline, with its intervals. */

import type { Signal } from "@preact/signals";
import type { JSX } from "preact";

import { united, type Span } from "./intervals";

export interface ShareProps {
  readonly span: Span;
  /** Position of a time [s] from the left, in percent. */
  readonly share: (time: number) => string;
}

interface BandsProps extends ShareProps {
  readonly weak?: boolean;
  /** Intervals: start and end [s]. */
  readonly bands: readonly (readonly [number, number])[];
}

/** Intervals of a lane, clipped to the timeline's span. */
export function Bands({ weak = false, bands, span, share }: BandsProps): JSX.Element {
  const visible = bands.filter(([start, end]) => end >= span.start && start <= span.end);
  return (
    <>
      {visible.map(([start, end]) => (
        <i
          key={start}
          class={weak ? "band weak" : "band"}
          style={{ left: share(Math.max(start, span.start)), right: `calc(100% - ${share(Math.min(end, span.end))})` }}
        />
      ))}
    </>
  );
}

interface LaneProps {
  readonly name: string;
  readonly title?: string;
  /** Row below the ruler that stays in view. */
  readonly pinned?: "log" | "marks";
  /** In place of the name. */
  readonly label?: JSX.Element;
  readonly children: JSX.Element | readonly JSX.Element[];
}

export function Lane({ name, title = name, pinned, label, children }: LaneProps): JSX.Element {
  const place = pinned === undefined ? "" : ` pinned ${pinned}-row`;
  return (
    <>
      <div class={`lanename${place}`} title={title}>
        {label ?? name}
      </div>
      <div class={`lane${place}`} role="group" aria-label={name}>
        {children}
      </div>
    </>
  );
}

export interface GroupedLane {
  readonly name: string;
  readonly title: string;
  readonly bands: readonly (readonly [number, number])[];
}

interface LaneGroupProps extends ShareProps {
  readonly name: string;
  readonly lanes: readonly GroupedLane[];
  readonly folds: Signal<ReadonlyMap<string, boolean>>;
  /** True: its lanes are shown until a person folds them. */
  readonly isOpen?: boolean;
}

/** Lanes of one kind below a lane with the intervals of all; if there are several, they are folded at first. */
export function LaneGroup({ name, lanes, folds, isOpen = false, span, share }: LaneGroupProps): JSX.Element {
  const rows = lanes.map(({ name: row, title, bands }) => (
    <Lane key={row} name={row} title={title}>
      <Bands weak bands={bands} span={span} share={share} />
    </Lane>
  ));
  if (lanes.length < 2) return rows[0] ?? <Lane name={name}>{[]}</Lane>;
  const isFolded = folds.value.get(name) ?? !isOpen;
  const label = (
    <button
      type="button"
      class="fold"
      aria-expanded={!isFolded}
      onClick={() => void (folds.value = new Map(folds.peek()).set(name, !isFolded))}
    >
      {name} <span class="dim">{lanes.length}</span>
    </button>
  );
  return (
    <>
      <Lane name={name} label={label}>
        {isFolded ? <Bands weak bands={united(lanes.flatMap(({ bands }) => bands))} span={span} share={share} /> : []}
      </Lane>
      {!isFolded && rows}
    </>
  );
}
