/** Timeline: its span, its events and its marks. */

import { computed, signal } from "@preact/signals";

import { canControl } from "../../page/view_only";
import type { Page } from "../../page/page";
import { bodiesOf } from "../../page/world_nodes";
import type { Fields, Subscription } from "../../protocol/connection";
import { perPage } from "../per_page";
import { sentence } from "../use";
import { ContactTimes, touchingPairs } from "./contact_times";
import { Intervals, type Span } from "./intervals";
import { TopicTimes } from "./topic_times";

export interface Mark {
  readonly id: number;
  /** [s] */
  readonly time: number;
  readonly name: string;
}

const FUTURE = 1.2;
const PERIOD = 200; // ms between updates
const NS = 1e9;
const SHORTEST_PAST = 0.05; // s

export class TimelineState {
  readonly marks = signal<readonly Mark[]>([]);
  readonly fault = signal("");
  /** Time to which the pointer drags the head [s]; null: no drag. */
  readonly scrub = signal<number | null>(null);
  readonly topics: TopicTimes;
  /** Intervals in which this page drove the robot, and in which the simulation was recorded. */
  readonly drives = new Intervals();
  readonly recordings = new Intervals();
  readonly contacts = new ContactTimes();
  private readonly models = computed(() => {
    const models = this.page.world.manifest.value?.models ?? [];
    return new Map(models.flatMap((model) => bodiesOf(model).map((body) => [body, model.name] as const)));
  });
  private contactSubscription: Subscription | null = null;
  /** Kinds of lanes that a person has folded (true) or unfolded. */
  readonly folds = signal<ReadonlyMap<string, boolean>>(new Map());
  /** Height of all lanes [px]; null: not shown yet. */
  readonly height = signal<number | null>(null);
  private markCount = 0;
  private requestedTime: number | null = null;
  private isSeeking = false;

  constructor(private readonly page: Page) {
    this.topics = new TopicTimes(page.connection);
    setInterval(() => this.look(), PERIOD);
  }

  /** Record contacts from now on; the simulation computes them only while subscribed. */
  followContacts(): void {
    if (this.page.session.kind !== "simulation") return;
    this.contactSubscription ??= this.page.connection.subscribeRaw("trundle/contacts", (payload) =>
      this.noteContacts(payload),
    );
  }

  /** Span of the recording, or of the simulation so far; null: not known yet. */
  span(): Span | null {
    const state = this.page.world.state.value;
    if (state === null) return null;
    const { timeline } = state;
    if (timeline === undefined) {
      const known = state.time_ns / NS;
      return { start: 0, end: Math.max(10, known * FUTURE), known, isSeekable: false };
    }
    const end = timeline.end_ns / NS;
    return { start: timeline.start_ns / NS, end, known: end, isSeekable: true };
  }

  /** True if a person may go to a time. */
  canSeek(): boolean {
    return this.span()?.isSeekable === true && canControl(this.page);
  }

  /** Time of the head [s]. */
  now(): number {
    return this.scrub.value ?? (this.page.world.state.value?.time_ns ?? 0) / NS;
  }

  /** Time by which a paused simulation is behind its newest state [s]; null: it shows its newest state, or plays. */
  past(): number | null {
    const state = this.page.world.state.value;
    if (state?.timeline === undefined || !state.paused || this.page.session.kind !== "simulation") return null;
    const seconds = (state.timeline.end_ns - state.time_ns) / NS;
    return seconds < SHORTEST_PAST ? null : seconds;
  }

  /** Go to a time; while a request is pending, only the newest time is kept. */
  seek(time: number): void {
    this.requestedTime = time;
    if (!this.isSeeking) void this.ask();
  }

  do<N extends "play" | "pause" | "step" | "speed">(request: N, fields: Fields<N>): void {
    this.page.connection.request(request, fields).then(
      () => void (this.fault.value = ""),
      (error: unknown) => void (this.fault.value = sentence(error)),
    );
  }

  mark(): void {
    this.markCount += 1;
    const mark = { id: this.markCount, time: this.now(), name: `Mark ${this.markCount}` };
    this.marks.value = [...this.marks.peek(), mark].sort((one, other) => one.time - other.time);
  }

  rename(mark: Mark, name: string): void {
    const others = this.marks.peek().filter(({ id }) => id !== mark.id);
    this.marks.value =
      name === "" ? others : [...others, { ...mark, name }].sort((one, other) => one.time - other.time);
  }

  private look(): void {
    const span = this.span();
    if (span === null) return;
    this.topics.look(span, this.now());
    this.drives.note(this.page.drive.command.peek() !== null, span.known);
    this.recordings.note((this.page.world.state.peek()?.recording ?? null) !== null, span.known);
  }

  private noteContacts(payload: DataView): void {
    const generation = this.page.world.manifest.peek()?.generation;
    if (payload.byteLength < 8) return;
    const time = Number(payload.getBigUint64(0, true)) / NS;
    this.contacts.note(touchingPairs(payload, generation, this.models.peek()), time, this.span()?.known ?? 0);
  }

  private async ask(): Promise<void> {
    this.isSeeking = true;
    while (this.requestedTime !== null) {
      const time = this.requestedTime;
      this.requestedTime = null;
      try {
        await this.page.connection.request("seek", { time_ns: Math.round(time * 1e9) });
        this.fault.value = "";
      } catch (error) {
        this.fault.value = sentence(error);
      }
    }
    this.isSeeking = false;
  }
}

export const timelineState = perPage((page) => new TimelineState(page));

/** Times of the ruler's ticks at a round step, at most `maxCount`. */
export function rulerTimes({ start, end }: Span, maxCount: number): readonly number[] {
  const step =
    [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600].find(
      (one) => (end - start) / one <= maxCount,
    ) ?? 7200;
  const first = Math.ceil(start / step - 1e-9);
  const count = Math.floor((end - first * step) / step + 1e-9) + 1;
  return Array.from({ length: Math.max(0, count) }, (_, index) => (first + index) * step);
}
