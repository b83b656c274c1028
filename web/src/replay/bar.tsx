/** Controls of a replay: play and pause, the time to scrub, the speed. */

import type { JSX } from "preact";

import { Button } from "../theme/button";
import { clock } from "../theme/format";
import { Select } from "../theme/select";
import type { Player } from "./player";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 10] as const;
const STEP = 0.01; // s

interface BarProps {
  readonly player: Player;
  readonly title: string;
  /** Simulated time at the start [s]. */
  readonly start: number;
}

export function Bar({ player, title, start }: BarProps): JSX.Element {
  const { time, isPlaying, speed, duration } = player;
  const now = clock(start + time.value);
  return (
    <div class="replay-bar">
      <Button
        tone="primary"
        icon={isPlaying.value ? "pause" : "play"}
        label={isPlaying.value ? "Pause" : "Play"}
        keys="Space"
        onClick={() => player.toggle()}
      />
      <span class="num now">{now}</span>
      <input
        type="range"
        aria-label="Time"
        aria-valuetext={now}
        min={0}
        max={duration}
        step={STEP}
        value={time.value}
        onInput={(event) => {
          isPlaying.value = false;
          player.seek(Number(event.currentTarget.value));
        }}
      />
      <span class="num t2">{clock(start + duration)}</span>
      <Select
        label="Speed"
        value={`${speed.value}×`}
        choices={SPEEDS.map((factor) => `${factor}×`)}
        onChange={(text) => (speed.value = Number.parseFloat(text))}
      />
      <span class="n t2 title" title={title}>
        {title}
      </span>
    </div>
  );
}
