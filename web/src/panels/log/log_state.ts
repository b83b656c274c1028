/** The page's log, and the state of its panel. */

import { computed, signal } from "@preact/signals";

import type { Page } from "../../page/page";
import { perPage } from "../per_page";
import { entryOf, filtered, LEVELS, type Level, type LogEntry } from "./log_entries";

const LONGEST = 20_000;
const TOPIC = "/rosout";
const PERIOD = 100; // ms between drawings
const NOTICE_LEVELS = { info: "Info", warning: "Warn", error: "Error" } as const;

/** Collects /rosout and the server's notices from the moment it is first asked for. */
export class LogState {
  readonly entries = signal<readonly LogEntry[]>([]);
  readonly levels = signal<ReadonlySet<Level>>(new Set(LEVELS.slice(1)));
  readonly node = signal("");
  readonly text = signal("");
  readonly isFiltering = signal(false);
  readonly selected = signal<number | null>(null);
  /** Entries shown while paused; null: not paused. */
  readonly frozen = signal<readonly LogEntry[] | null>(null);
  readonly shown = computed(() =>
    filtered(this.frozen.value ?? this.entries.value, {
      levels: this.levels.value,
      node: this.node.value,
      text: this.text.value,
    }),
  );
  private pending: LogEntry[] = [];
  private timer: ReturnType<typeof setTimeout> | undefined;
  private count = 0;

  constructor({ connection }: Page) {
    connection.subscribe(TOPIC, ({ message }) => this.add(entryOf(this.nextId(), message)), { every: true });
    let known: readonly unknown[] = [];
    connection.notices.subscribe((notices) => {
      const fresh = notices.filter((notice) => !known.includes(notice));
      known = notices;
      const time = Number(connection.now()) / 1e9;
      for (const { level, text } of fresh) {
        this.add({
          id: this.nextId(),
          time,
          level: NOTICE_LEVELS[level],
          node: "page",
          text,
          file: "",
          line: 0,
          function: "",
        });
      }
    });
  }

  /** Number of kept entries of a level. */
  counts(): ReadonlyMap<Level, number> {
    const counts = new Map<Level, number>();
    for (const { level } of this.entries.value) counts.set(level, (counts.get(level) ?? 0) + 1);
    return counts;
  }

  toggle(level: Level): void {
    const levels = new Set(this.levels.peek());
    if (!levels.delete(level)) levels.add(level);
    this.levels.value = levels;
  }

  pause(on: boolean): void {
    this.frozen.value = on ? this.entries.peek() : null;
  }

  clear(): void {
    this.entries.value = [];
    this.selected.value = null;
    if (this.frozen.peek() !== null) this.frozen.value = [];
  }

  private nextId(): number {
    this.count += 1;
    return this.count;
  }

  private add(entry: LogEntry): void {
    this.pending.push(entry);
    this.timer ??= setTimeout(() => this.flush(), PERIOD);
  }

  private flush(): void {
    this.timer = undefined;
    this.entries.value = [...this.entries.peek(), ...this.pending].slice(-LONGEST);
    this.pending = [];
  }
}

export const logState = perPage((page) => new LogState(page));
