/** Panes of the scene: the shown ones with their areas, the active one, and the one under the pointer. */

import { computed, effect, signal, untracked, type ReadonlySignal } from "@preact/signals";

import type { LabelSet } from "../label_layer";
import type { Insets } from "../free_area";
import { Pane } from "./pane";
import { isInside, paneCount, paneAreas, type PaneLayout, type PaneArea } from "./pane_layout";

/** Height of the tools at the top of the scene [px]. */
const TOOLS = 40;

export class ScenePanes {
  readonly layout = signal<PaneLayout>("one");
  /** The pane last pressed. */
  readonly active;
  /** The pane that the pointer is in, or was in last. */
  readonly pointed;
  /** Shown panes; hidden ones keep their views. */
  readonly shown: ReadonlySignal<readonly Pane[]>;
  readonly areas: ReadonlySignal<readonly PaneArea[]>;
  private readonly panes;
  /** Pane in which the pressed button went down. */
  private pressed: Pane | null = null;
  private readonly stops: (() => void)[];

  constructor(
    private readonly host: HTMLElement,
    private readonly labels: LabelSet,
    size: ReadonlySignal<{ readonly width: number; readonly height: number }>,
    insets: ReadonlySignal<Insets>,
  ) {
    const first = new Pane(host, labels);
    this.panes = signal<readonly Pane[]>([first]);
    this.active = signal(first);
    this.pointed = signal(first);
    this.shown = computed(() => this.chosen());
    this.areas = computed(() => paneAreas(this.layout.value, size.value, insets.value, TOOLS));
    this.stops = [
      effect(() => {
        const count = paneCount(this.layout.value);
        untracked(() => this.make(count));
      }),
      effect(() => {
        const [shown, areas] = [this.shown.value, this.areas.value];
        untracked(() => this.put(shown, areas));
      }),
    ];
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    for (const pane of this.panes.peek()) pane.dispose();
  }

  /** Pane at a point of the scene [px]; while a button is down, the pane where it went down. */
  at(x: number, y: number): Pane {
    if (this.pressed !== null) return this.pressed;
    const shown = this.shown.peek();
    if (shown.length === 1) return this.active.peek();
    return shown.find((pane) => isInside(pane.place.peek().area, x, y)) ?? this.active.peek();
  }

  /** Move the pointer to a point [px]. */
  point(x: number, y: number): Pane {
    const pane = this.at(x, y);
    this.pointed.value = pane;
    return pane;
  }

  /** Press a button at a point [px]: its pane becomes active, and has the pointer until the release. */
  press(x: number, y: number): Pane {
    this.pressed = null;
    this.active.value = this.point(x, y);
    this.pressed = this.active.peek();
    return this.pressed;
  }

  release(): void {
    this.pressed = null;
  }

  /** Make the next pane, or the one before it, the active one. */
  step(by: number): void {
    const shown = this.shown.peek();
    const next = shown.at((shown.indexOf(this.active.peek()) + by) % shown.length);
    if (next !== undefined) this.active.value = this.pointed.value = next;
  }

  private make(count: number): void {
    const panes = this.panes.peek();
    const more = Array.from({ length: Math.max(0, count - panes.length) }, () => new Pane(this.host, this.labels));
    if (more.length > 0) this.panes.value = [...panes, ...more];
  }

  /** First panes of the layout, including the active one. */
  private chosen(): readonly Pane[] {
    const [panes, active, count] = [this.panes.value, this.active.value, paneCount(this.layout.value)];
    const first = panes.slice(0, count);
    return first.includes(active) ? first : [active, ...first.slice(0, count - 1)];
  }

  private put(shown: readonly Pane[], areas: readonly PaneArea[]): void {
    for (const pane of this.panes.peek()) pane.isShown = shown.includes(pane);
    shown.forEach((pane, index) => {
      const place = areas[index];
      if (place !== undefined) pane.place.value = place;
    });
    if (!shown.includes(this.pointed.peek())) this.pointed.value = this.active.peek();
  }
}
