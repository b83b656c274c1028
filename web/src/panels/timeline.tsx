/** Timeline of a simulation, a recorded run or a bag, to scrub; with events and marks (rqt_bag). */

import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";

import { canControl } from "../page/looking";
import { Button } from "../theme/button";
import { count as messages } from "../theme/format";
import { Select } from "../theme/select";
import { StatusShape } from "../theme/status_shape";
import { TextField } from "../theme/text_field";
import { logState } from "./log/log_state";
import { timeText } from "./messages/format";
import type { Panel, PanelProps } from "./panel";
import { Bands, ContactLanes, Lane, type ShareProps } from "./timeline/lane";
import { rulerTimes, timelineState, type Mark, type TimelineState } from "./timeline/timeline_state";
import { useShown, useTick } from "./use";

const PERIOD = 250; // ms
const MAX_LABELS = 8;
const SPEEDS: Readonly<Record<string, number | null>> = {
  "0.1×": 0.1,
  "0.25×": 0.25,
  "0.5×": 0.5,
  "1×": 1,
  "2×": 2,
  "4×": 4,
  "10×": 10,
  "As fast as possible": null,
};

function Timeline({ page }: PanelProps): JSX.Element {
  const state = timelineState(page);
  const root = useRef<HTMLDivElement>(null);
  const isShown = useShown(root);
  useTick(PERIOD, isShown);
  useEffect(() => {
    if (isShown) state.followContacts();
  }, [state, isShown]);
  const span = state.span();
  if (span === null)
    return (
      <div class="empty" ref={root}>
        There is no timeline: neither a simulation runs nor a recording plays.
      </div>
    );
  const { kind } = page.session;
  const entries = logState(page).entries.value.filter(
    ({ level, time }) =>
      time !== null && time >= span.start && time <= span.end && level !== "Info" && level !== "Debug",
  );
  const share = (time: number): string => `${(100 * (time - span.start)) / Math.max(1e-9, span.end - span.start)}%`;
  return (
    <div class="stack" ref={root}>
      {state.fault.value !== "" && (
        <div class="fault pad" role="alert">
          {state.fault.value}
        </div>
      )}
      <div class="scroll">
        <div class="timeline">
          <div class="lanename ruler" />
          <Ruler span={span} share={share} />
          <Head state={state} span={span} share={share} />
          {kind !== "bag" && (
            <Lane name={!span.isSeekable ? "Simulated" : kind === "simulation" ? "Kept" : "Recorded"}>
              <Bands bands={[[span.start, span.known]]} span={span} share={share} />
            </Lane>
          )}
          {kind === "simulation" && (
            <>
              <Lane name="Recorded">
                <Bands bands={state.recordings.bands} span={span} share={share} />
              </Lane>
              <Lane name="Drive">
                <Bands weak bands={state.drives.bands} span={span} share={share} />
              </Lane>
              <ContactLanes lanes={state.contacts.all} span={span} share={share} />
            </>
          )}
          <Lane name="Log">
            {entries.map(({ id, level, time, text }) => (
              <i key={id} class="event" title={text} style={{ left: share(time ?? 0) }}>
                <StatusShape level={level === "Warn" ? "warn" : "error"} label={text} />
              </i>
            ))}
          </Lane>
          <Lane name="Marks">
            {state.marks.value.map((mark) => (
              <MarkFlag key={mark.id} state={state} mark={mark} left={share(mark.time)} />
            ))}
          </Lane>
          {state.topics.all.map(({ topic, count, bands }) => (
            <Lane key={topic} name={topic} title={count === null ? topic : `${topic}: ${messages(count, "message")}`}>
              <Bands weak bands={bands} span={span} share={share} />
            </Lane>
          ))}
        </div>
      </div>
    </div>
  );
}

function Ruler({ span, share }: ShareProps): JSX.Element {
  const times = rulerTimes(span, MAX_LABELS);
  const decimals = (times[1] ?? 1) - (times[0] ?? 0) < 1 ? 1 : 0;
  return (
    <div class="ruler">
      {times.map((time) => (
        <span key={time} style={{ left: share(time) }}>
          {timeText(time, decimals)}
        </span>
      ))}
    </div>
  );
}

/** The line at the time that is shown; dragged, or moved by the arrow keys. */
function Head({ state, span, share }: ShareProps & { readonly state: TimelineState }): JSX.Element {
  const area = useRef<HTMLDivElement>(null);
  const now = Math.min(span.end, Math.max(span.start, state.now()));
  const go = (time: number): void => {
    const within = Math.min(span.end, Math.max(span.start, time));
    state.seek(within);
    if (state.scrub.peek() !== null) state.scrub.value = within;
  };
  const drag = (event: PointerEvent): void => {
    const box = area.current?.getBoundingClientRect();
    if (state.scrub.peek() === null || box === undefined) return;
    go(span.start + ((event.clientX - box.left) / box.width) * (span.end - span.start));
  };
  const keys: Readonly<Record<string, number>> = {
    ArrowLeft: now - 1,
    ArrowRight: now + 1,
    PageDown: now - 10,
    PageUp: now + 10,
    Home: span.start,
    End: span.end,
  };
  return (
    <div
      ref={area}
      class={state.canSeek() ? "headarea" : "headarea fixed"}
      onPointerDown={(event) => {
        if (!state.canSeek()) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        state.scrub.value = now;
        drag(event);
      }}
      onPointerMove={drag}
      onPointerUp={() => void (state.scrub.value = null)}
      onPointerCancel={() => void (state.scrub.value = null)}
    >
      {span.known < span.end && <div class="future" style={{ left: share(span.known) }} />}
      <div
        class="playhead"
        role="slider"
        aria-label="Time"
        aria-valuemin={span.start}
        aria-valuemax={span.end}
        aria-valuenow={now}
        aria-valuetext={timeText(now)}
        aria-disabled={!state.canSeek()}
        tabIndex={0}
        style={{ left: share(now), "--at": share(now) }}
        onKeyDown={(event) => {
          const to = keys[event.key];
          if (to === undefined || !state.canSeek()) return;
          event.preventDefault();
          go(to);
        }}
      >
        <span>{timeText(now)}</span>
      </div>
    </div>
  );
}

/** A mark, whose name is edited in place; an empty name removes it. */
function MarkFlag({
  state,
  mark,
  left,
}: {
  readonly state: TimelineState;
  readonly mark: Mark;
  readonly left: string;
}): JSX.Element {
  return (
    <span class="mark-flag" style={{ left }} onClick={() => state.canSeek() && state.seek(mark.time)}>
      <TextField
        label={`Mark at ${timeText(mark.time)}`}
        class="small bare"
        value={mark.name}
        onCommit={(name) => state.rename(mark, name.trim())}
      />
    </span>
  );
}

function Actions({ page }: PanelProps): JSX.Element | null {
  const state = timelineState(page);
  if (state.span() === null) return null;
  const world = page.world.state.value;
  const isPaused = world?.paused ?? true;
  const speed =
    Object.entries(SPEEDS).find(([, factor]) => factor === (world?.speed ?? null))?.[0] ?? `${world?.speed ?? 1}×`;
  return (
    <>
      {canControl(page) && (
        <>
          <Button
            small
            icon={isPaused ? "play" : "pause"}
            disabled={world === null}
            onClick={() => state.do(isPaused ? "play" : "pause", {})}
          >
            {isPaused ? "Play" : "Pause"}
          </Button>
          <Button
            small
            icon="step"
            label="Step 1"
            disabled={world === null}
            onClick={() => state.do("step", { count: 1 })}
          />
          <Select
            label="Speed"
            value={speed}
            choices={Object.keys(SPEEDS)}
            onChange={(name) => state.do("speed", { factor: SPEEDS[name] ?? null })}
          />
          <Button
            small
            disabled={world === null}
            onClick={() =>
              page.commands.all
                .peek()
                .find(({ id }) => id === "time")
                ?.run()
            }
          >
            Go to…
          </Button>
        </>
      )}
      <Button small icon="plus" disabled={world === null} onClick={() => state.mark()}>
        Mark
      </Button>
      {world?.timeline !== undefined && canControl(page) && (
        <Button small onClick={() => state.seek((world.timeline?.end_ns ?? 0) / 1e9)}>
          To the end
        </Button>
      )}
    </>
  );
}

export const timelinePanel: Panel = {
  id: "timeline",
  title: "Timeline",
  programs: ["rqt_bag"],
  component: Timeline,
  actions: Actions,
};
