/** Timeline of a simulation, a recorded run or a bag, to scrub; with events and marks (rqt_bag). */

import type { JSX } from "preact";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";

import { canControl } from "../page/view_only";
import { Button } from "../theme/button";
import { count as messages } from "../theme/format";
import { Select } from "../theme/select";
import { StatusShape } from "../theme/status_shape";
import { TextField } from "../theme/text_field";
import { logState } from "./log/log_state";
import { timeText } from "./messages/format";
import type { Panel, PanelProps } from "./panel";
import { Head } from "./timeline/head";
import { Bands, Lane, LaneGroup, type GroupedLane, type ShareProps } from "./timeline/lane";
import { rulerTimes, timelineState, type Mark, type TimelineState } from "./timeline/timeline_state";
import { useShown, useTick, useWidth } from "./use";

const PERIOD = 250; // ms
const MAX_LABELS = 8;
/** Room of a label on the ruler [px]. */
const LABEL = 64;
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
  useLayoutEffect(() => {
    const lanes = root.current?.querySelector<HTMLElement>(".timeline");
    const last = lanes?.lastElementChild;
    if (!(last instanceof HTMLElement) || last.offsetHeight === 0) return; // a tab in the background has no height
    state.height.value = (lanes?.offsetTop ?? 0) + last.offsetTop + last.offsetHeight;
  });
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
          <Lane name="Log" pinned="log">
            {entries.map(({ id, level, time, text }) => (
              <i key={id} class="event" title={text} style={{ left: share(time ?? 0) }}>
                <StatusShape level={level === "Warn" ? "warn" : "error"} label={text} />
              </i>
            ))}
          </Lane>
          <Lane name="Marks" pinned="marks">
            {state.marks.value.map((mark) => (
              <MarkFlag key={mark.id} state={state} mark={mark} left={share(mark.time)} />
            ))}
          </Lane>
          {kind !== "bag" && (
            <Lane name={!span.isSeekable ? "Simulated" : kind === "simulation" ? "History" : "Recorded"}>
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
              <LaneGroup name="Contacts" lanes={contactLanes(state)} folds={state.folds} span={span} share={share} />
            </>
          )}
          <LaneGroup
            name="Topics"
            lanes={topicLanes(state)}
            folds={state.folds}
            isOpen={kind === "bag"}
            span={span}
            share={share}
          />
        </div>
      </div>
    </div>
  );
}

function contactLanes(state: TimelineState): readonly GroupedLane[] {
  return state.contacts.all.map(({ pair, bands }) => ({
    name: pair,
    title: `Contacts of ${pair.replace(" · ", " and ")}`,
    bands,
  }));
}

function topicLanes(state: TimelineState): readonly GroupedLane[] {
  return state.topics.all.map(({ topic, count, bands }) => ({
    name: topic,
    title: count === null ? topic : `${topic}: ${messages(count, "message")}`,
    bands,
  }));
}

function Ruler({ span, share }: ShareProps): JSX.Element {
  const ruler = useRef<HTMLDivElement>(null);
  const times = rulerTimes(span, Math.max(1, Math.min(MAX_LABELS, Math.floor(useWidth(ruler) / LABEL))));
  const decimals = (times[1] ?? 1) - (times[0] ?? 0) < 1 ? 1 : 0;
  return (
    <div class="ruler" ref={ruler}>
      {times.map((time) => (
        <span key={time} style={{ left: share(time) }}>
          {timeText(time, decimals)}
        </span>
      ))}
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
  const past = state.past();
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
      {past !== null && (
        <span class="past" role="status">
          past, {past < 60 ? `${past.toFixed(past < 10 ? 1 : 0)} s` : timeText(past, 0)} ago
        </span>
      )}
      {past !== null && canControl(page) && (
        <>
          <Button small onClick={() => state.do("play", {})}>
            Resume here
          </Button>
          <Button small onClick={() => state.seek(state.span()?.end ?? 0)}>
            Back to now
          </Button>
        </>
      )}
    </>
  );
}

export const timelinePanel: Panel = {
  id: "timeline",
  title: "Timeline",
  programs: ["rqt_bag"],
  contentHeight: (page) => timelineState(page).height,
  component: Timeline,
  actions: Actions,
};
