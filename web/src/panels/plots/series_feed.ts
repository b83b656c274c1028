/** Values of the simulation by name, which the server samples while they are plotted (`trundle/series`). */

import { effect } from "@preact/signals";

import type { Page } from "../../page/page";
import { readPayload } from "../../protocol/check";
import type { Subscription } from "../../protocol/connection";
import { seriesHead } from "../../protocol/generated/page_checks";
import type { SeriesHead } from "../../protocol/generated/page_messages";
import { perPage } from "../per_page";
import { sentence } from "../use";

const HEADER = 12;
const NUMBER = 8; // bytes

interface SeriesListener {
  /** Time [s]. */
  readonly onValue: (time: number, value: number) => void;
  readonly onUnit: (unit: string) => void;
  readonly onFault: (text: string) => void;
}

/** Rows of a message: times and values in the order of its names; null: truncated. Throws a `MessageFault`. */
function readSeries(
  payload: DataView,
): { readonly first: number; readonly head: SeriesHead; readonly rows: readonly Float64Array[] } | null {
  if (payload.byteLength < HEADER) return null;
  const start = HEADER + payload.getUint32(8, true);
  if (payload.byteLength < start) return null;
  const text = new Uint8Array(payload.buffer, payload.byteOffset + HEADER, start - HEADER);
  const head = readPayload(text, "trundle/series", seriesHead);
  const width = 1 + head.names.length;
  const count = Math.floor((payload.byteLength - start) / (NUMBER * width));
  const rows = Array.from({ length: count }, (_, row) =>
    Float64Array.from({ length: width }, (_value, column) =>
      payload.getFloat64(start + NUMBER * (row * width + column), true),
    ),
  );
  return { first: Number(payload.getBigUint64(0, true)), head, rows };
}

class SeriesFeed {
  private readonly listeners = new Map<string, Set<SeriesListener>>();
  private subscription: Subscription | null = null;
  /** Number of the next row to receive. */
  private next = 0;

  constructor(private readonly page: Page) {
    effect(() => {
      if (page.connection.state.value.kind === "connected") this.ask();
    });
  }

  /** Subscribe to samples of a value. */
  follow(name: string, listener: SeriesListener): Subscription {
    const listeners = this.listeners.get(name) ?? new Set();
    this.listeners.set(name, listeners.add(listener));
    this.ask();
    return {
      close: () => {
        listeners.delete(listener);
        if (listeners.size === 0 && this.listeners.get(name) === listeners) this.listeners.delete(name);
        this.ask();
      },
    };
  }

  private ask(): void {
    const names = [...this.listeners.keys()];
    if (names.length > 0) {
      this.subscription ??= this.page.connection.subscribeRaw("trundle/series", (payload) => this.receive(payload));
    } else if (this.subscription === null) {
      return;
    } else {
      this.subscription.close();
      this.subscription = null;
    }
    this.next = 0;
    this.page.connection.request("plot", { series: names }).catch((error: unknown) => {
      for (const group of this.listeners.values()) for (const { onFault } of group) onFault(sentence(error));
    });
  }

  private receive(payload: DataView): void {
    const message = readSeries(payload);
    if (message === null) return;
    const { first, head, rows } = message;
    for (const [name, fault] of Object.entries(head.faults))
      for (const { onFault } of this.listeners.get(name) ?? []) onFault(fault);
    head.names.forEach((name, index) => {
      for (const { onUnit, onValue } of this.listeners.get(name) ?? []) {
        onUnit(head.units[index] ?? "");
        rows.forEach((row, at) => {
          if (first + at >= this.next) onValue(row[0] ?? 0, row[1 + index] ?? NaN);
        });
      }
    });
    this.next = Math.max(this.next, first + rows.length);
  }
}

export const seriesFeed = perPage((page) => new SeriesFeed(page));
