/** Row of the timeline, with its intervals. */

import type { JSX } from "preact";

import type { PairStretches } from "./contact_times";
import type { Span } from "./intervals";

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
  readonly children: JSX.Element | readonly JSX.Element[];
}

export function Lane({ name, title = name, children }: LaneProps): JSX.Element {
  return (
    <>
      <div class="lanename" title={title}>
        {name}
      </div>
      <div class="lane" role="group" aria-label={name}>
        {children}
      </div>
    </>
  );
}

/** Lanes of the pairs of models that touched. */
export function ContactLanes({
  lanes,
  span,
  share,
}: ShareProps & { readonly lanes: readonly PairStretches[] }): JSX.Element {
  if (lanes.length === 0) return <Lane name="Contacts">{[]}</Lane>;
  return (
    <>
      {lanes.map(({ pair, bands }) => (
        <Lane key={pair} name={pair} title={`Contacts of ${pair.replace(" · ", " and ")}`}>
          <Bands weak bands={bands} span={span} share={share} />
        </Lane>
      ))}
    </>
  );
}
