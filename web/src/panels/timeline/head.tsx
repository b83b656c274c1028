/** The time that is shown, over all lanes: a press anywhere on them goes there, and the pointer shows its time. */

import type { JSX } from "preact";
import { useState } from "preact/hooks";

import { timeText } from "../messages/format";
import type { ShareProps } from "./lane";
import type { TimelineState } from "./timeline_state";

type AreaEvent = PointerEvent & { readonly currentTarget: HTMLElement };

export function Head({ state, span, share }: ShareProps & { readonly state: TimelineState }): JSX.Element {
  /** Position of the pointer from the left, 0 … 1; null: elsewhere. */
  const [pointed, point] = useState<number | null>(null);
  const now = Math.min(span.end, Math.max(span.start, state.now()));
  const canSeek = state.canSeek();
  const go = (time: number): void => {
    const within = Math.min(span.end, Math.max(span.start, time));
    state.seek(within);
    if (state.scrub.peek() !== null) state.scrub.value = within;
  };
  const timeAt = (across: number): number => span.start + across * (span.end - span.start);
  const move = (event: AreaEvent): void => {
    const box = event.currentTarget.getBoundingClientRect();
    const across = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
    point(event.pointerType === "touch" ? null : across);
    if (state.scrub.peek() !== null) go(timeAt(across));
  };
  const release = (): void => void (state.scrub.value = null);
  const keys: Readonly<Record<string, number>> = {
    ArrowLeft: now - 1,
    ArrowRight: now + 1,
    PageDown: now - 10,
    PageUp: now + 10,
    Home: span.start,
    End: span.end,
  };
  return (
    <>
      <div
        class={canSeek ? "headarea" : "headarea fixed"}
        onPointerDown={(event) => {
          if (!canSeek || event.button !== 0) return;
          event.currentTarget.setPointerCapture(event.pointerId);
          state.scrub.value = now;
          move(event);
        }}
        onPointerMove={move}
        onPointerLeave={() => point(null)}
        onPointerUp={release}
        onPointerCancel={release}
      />
      <div class="headlines">
        {span.known < span.end && <div class="future" style={{ left: share(span.known) }} />}
        {pointed !== null && state.scrub.value === null && (
          <div class="pointed" style={{ left: `${100 * pointed}%`, "--at": `${100 * pointed}%` }}>
            <span>{timeText(timeAt(pointed))}</span>
          </div>
        )}
        <div
          class="playhead"
          role="slider"
          aria-label="Time"
          aria-valuemin={span.start}
          aria-valuemax={span.end}
          aria-valuenow={now}
          aria-valuetext={timeText(now)}
          aria-disabled={!canSeek}
          tabIndex={0}
          style={{ left: share(now), "--at": share(now) }}
          onKeyDown={(event) => {
            const to = keys[event.key];
            if (to === undefined || !canSeek) return;
            event.preventDefault();
            go(to);
          }}
        >
          <span>{timeText(now)}</span>
        </div>
      </div>
    </>
  );
}
