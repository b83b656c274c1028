/** Messages of the server about itself. */

import { signal } from "@preact/signals";

export interface Notice {
  readonly level: "info" | "warning" | "error";
  readonly text: string;
}

const MAX_NOTICES = 100;
const LEVELS = ["info", "warning", "error"] as const;

export class Notices {
  readonly list = signal<readonly (Notice & { readonly id: string | undefined })[]>([]);

  /** Add a message; a message with an `id` replaces the earlier one with the same id. */
  add(level: Notice["level"] | number, text: string, id?: string): void {
    const name = typeof level === "number" ? (LEVELS[level] ?? "error") : level;
    const others = this.list.peek().filter((notice) => id === undefined || notice.id !== id);
    this.list.value = [...others, { level: name, text, id }].slice(-MAX_NOTICES);
  }

  remove(ids: readonly string[]): void {
    this.list.value = this.list.peek().filter((notice) => notice.id === undefined || !ids.includes(notice.id));
  }

  clear(): void {
    if (this.list.peek().length > 0) this.list.value = [];
  }
}
