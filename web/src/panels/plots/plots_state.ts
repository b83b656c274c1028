/** Plots with their curves, and their common window, zoom, pause and cursor. */

import { effect, signal, untracked, type ReadonlySignal } from "@preact/signals";

import type { Page } from "../../page/page";
import { forEachNew } from "../../page/session";
import type { Reference } from "../../scene/simulated_world";
import { perPage } from "../per_page";
import { Curve } from "./curve";
import { csvText, type CsvColumn } from "./csv";
import { linesOf, type Line, type ReferenceMode } from "./line";
import type { Plot, Range } from "./plot";
import { speedOf } from "./suggestions";
import { svgText } from "./svg";

export const WINDOWS = [5, 10, 30, 60, 120] as const; // s

/** Largest delay of the newest points behind the clock [s]. */
const LAG = 0.005;

export class PlotsState {
  readonly plots = signal<readonly Plot[]>([{ id: 0, curves: [] }]);
  /** Seconds that are shown. */
  readonly window = signal<number>(30);
  /** A time range that a person chose; null: the last seconds. */
  readonly zoom = signal<Range | null>(null);
  readonly isPaused = signal(false);
  /** Time under the cursor [s]. */
  readonly cursor = signal<number | null>(null);
  readonly isAdding = signal(false);
  /** What is drawn while the world is compared with a recording. */
  readonly mode = signal<ReferenceMode>("With reference");
  /** Time at which the plots are paused; null: running. */
  pausedAt: number | null = null;
  private plotCount = 1;

  constructor(private readonly page: Page) {
    forEachNew(
      () => page.session.plots,
      (path) => this.add(path),
    );
    this.drawSpeed();
  }

  /** Recording that the world is compared with; null: none. */
  get reference(): ReadonlySignal<Reference | null> {
    return this.page.world.reference;
  }

  /** Lines of curves: those of the run, and of the recording that it is compared with. */
  lines(curves: readonly Curve[]): readonly Line[] {
    return linesOf(curves, this.mode.value, this.reference.value);
  }

  /** Add the robot's commanded and measured speed once their topics are known, unless the plots already have curves. */
  private drawSpeed(): void {
    const stop = effect(() => {
      const isEmpty = this.plots.value.every(({ curves }) => curves.length === 0);
      const speed = isEmpty ? speedOf(this.page) : null;
      if (isEmpty && speed === null) return;
      queueMicrotask(() => stop()); // later: the first call comes before `stop` is defined
      untracked(() => speed?.curves.forEach(([path, name]) => this.add(path, name)));
    });
  }

  get curves(): readonly Curve[] {
    return this.plots.value.flatMap((plot) => plot.curves);
  }

  /**
   * Add curves to the last plot; `/pose/x:y` is two curves, as for rqt_plot. Without a name, the legend shows the path.
   */
  add(text: string, name?: string): void {
    const plot = this.plots.peek().at(-1)?.id;
    const [first = "", ...others] = text
      .trim()
      .split(":")
      .filter((part) => part !== "");
    const paths = text.includes("::")
      ? [text.trim()]
      : [first, ...others.map((field) => first.replace(/[^./]+$/, field))];
    const known =
      this.plots
        .peek()
        .find(({ id }) => id === plot)
        ?.curves.map((curve) => curve.path) ?? [];
    const fresh = paths
      .filter((path) => path !== "" && !known.includes(path))
      .map((path) => new Curve(this.page, path, name));
    this.change(plot, (curves) => [...curves, ...fresh]);
  }

  remove(curve: Curve): void {
    curve.close();
    this.take(curve);
  }

  /** Move a curve into a plot of its own. */
  separate(curve: Curve): void {
    this.take(curve);
    this.plots.value = [...this.plots.peek(), { id: this.plotCount, curves: [curve] }];
    this.plotCount += 1;
  }

  move(curve: Curve, plot: number): void {
    this.change(plot, (curves) => [...curves, curve]);
    this.plots.value = withoutEmpty(
      this.plots
        .peek()
        .map((one) => (one.id === plot ? one : { ...one, curves: one.curves.filter((other) => other !== curve) })),
    );
  }

  /** Time of the simulation while a person scrubs before the newest point [s]; null: the newest point is shown. */
  shownTime(): number | null {
    const time = (this.page.world.state.value?.time_ns ?? Infinity) / 1e9;
    const newest = this.newest();
    return newest !== null && time < newest - LAG && this.page.world.state.value?.paused === true ? time : null;
  }

  pause(on: boolean): void {
    this.pausedAt = on ? this.newest() : null;
    this.isPaused.value = on;
    if (!on) this.zoom.value = null;
  }

  /** Visible range of time [s]. */
  range(): Range {
    const zoom = this.zoom.peek();
    if (zoom !== null) return zoom;
    const end = this.pausedAt ?? this.newest() ?? 0;
    return [end - this.window.peek(), end];
  }

  csv(): string {
    return csvText(this.columns());
  }

  /** The plots as they are shown, one below the other. */
  svg(): string {
    return svgText(
      this.plots.peek().map(({ curves }) => this.lines(curves)),
      this.range(),
    );
  }

  /** All lines, whole. */
  columns(): readonly CsvColumn[] {
    return this.lines(this.curves).map(({ name, between }) => {
      const [xs, ys] = between(-Infinity, Infinity);
      return { name, xs, ys };
    });
  }

  private newest(): number | null {
    const times = this.plots.peek().flatMap((plot) => plot.curves.map((curve) => curve.points.lastX ?? -Infinity));
    const newest = Math.max(...times);
    return Number.isFinite(newest) ? newest : null;
  }

  private take(curve: Curve): void {
    const plots = this.plots
      .peek()
      .map((plot) => ({ ...plot, curves: plot.curves.filter((other) => other !== curve) }));
    this.plots.value = withoutEmpty(plots);
  }

  private change(plot: number | undefined, edit: (curves: readonly Curve[]) => readonly Curve[]): void {
    this.plots.value = this.plots.peek().map((one) => (one.id === plot ? { ...one, curves: edit(one.curves) } : one));
  }
}

/** All plots that have curves; at least one plot. */
function withoutEmpty(plots: readonly Plot[]): readonly Plot[] {
  const nonEmpty = plots.filter((plot) => plot.curves.length > 0);
  return nonEmpty.length > 0 ? nonEmpty : plots.slice(0, 1);
}

export const plotsState = perPage((page) => new PlotsState(page));
