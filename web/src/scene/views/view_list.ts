/** Views of the scene's panes, and saved views; calls act on the active pane's view. */

import { computed, signal, untracked, type ReadonlySignal } from "@preact/signals";
import type { Box3, Vector3 } from "three";

import type { CameraInfo } from "../../protocol/generated/page_messages";
import { isMapping, type Triple, type Yaml, type YamlMapping } from "../../rviz/properties";
import type { Transform } from "../../frames/transform";
import type { Pane } from "../panes/pane";
import type { ThreeScene } from "../three_scene";
import type { PaneLayout } from "../panes/pane_layout";
import type { SixSides, ViewController, ViewPane, Views } from "../view_controller";
import { CameraMotion } from "./camera_motion";
import { Orbit } from "./orbit";
import { PaneView } from "./pane_view";
import { loadPanes, savedLayout, savePanes } from "./saved_panes";
import { SensorCamera } from "./sensor_camera";
import type { View } from "./view";
import { classOfView, copyOfView, createView, loadView, VIEW_CLASSES } from "./view_classes";

/** First sides of further panes, whose views are orthographic. */
const FURTHER: readonly SixSides[] = ["top", "front", "right"];

/** Key of the panes among the views of a file. */
const PANES = "Trundle Panes";

/** Part of the scene that views use. */
export type ViewScene = Pick<ThreeScene, "panes" | "onTick" | "invalidate">;

export class ViewList implements Views {
  readonly classes = VIEW_CLASSES;
  readonly saved = signal<readonly ViewController[]>([]);
  readonly layout;
  onFileLayout: (layout: PaneLayout) => void = (layout) => {
    this.layout.value = layout;
  };
  private readonly known = new Map<Pane, PaneView>();
  /** Saved views of unknown classes, saved unchanged. */
  private unknown: readonly YamlMapping[] = [];
  /** True if the loaded file has panes, and the layout has not changed since. */
  private hasPanes = false;
  private readonly stop: () => void;

  /** `targetPose`: pose of a frame or body (`model::link`) in the fixed frame; null: there is none. */
  constructor(
    private readonly scene: ViewScene,
    private readonly targetPose: (target: string) => Transform | null,
  ) {
    this.layout = scene.panes.layout;
    this.viewOf(scene.panes.active.peek());
    this.stop = scene.onTick((elapsed) => this.tick(elapsed));
  }

  readonly panes: ReadonlySignal<readonly PaneView[]> = computed(() => this.viewsOf(this.scene.panes.shown.value));
  readonly active: ReadonlySignal<PaneView> = computed(() => {
    const pane = this.scene.panes.active.value;
    return untracked(() => this.viewOf(pane));
  });
  readonly current: ReadonlySignal<View> = computed(() => this.active.value.view.value);

  dispose(): void {
    this.stop();
    for (const view of this.known.values()) view.dispose();
  }

  /** The view of the pane that the pointer is in. */
  get pointed(): PaneView {
    return this.viewOf(this.scene.panes.pointed.peek());
  }

  activate(pane: ViewPane): void {
    const chosen = this.panes.peek().find((other) => other === pane);
    if (chosen !== undefined) this.scene.panes.active.value = chosen.pane;
  }

  stepPane(by: number): void {
    this.scene.panes.step(by);
  }

  use(className: string): void {
    this.active.peek().use(className);
  }

  useSaved(saved: ViewController): void {
    this.active.peek().show(copyOfView(saved, "Current View"));
  }

  copyCurrent(name: string): ViewController {
    return copyOfView(this.current.peek(), name);
  }

  frame(box: Box3): void {
    this.active.peek().frame(box);
  }

  focus(point: Vector3): void {
    this.active.peek().focus(point);
  }

  lookFrom(side: SixSides): void {
    this.active.peek().lookFrom(side);
  }

  toggleProjection(): void {
    this.active.peek().toggleProjection();
  }

  lookThrough(camera: CameraInfo, link: string): void {
    this.active.peek().show(SensorCamera.of(camera, link));
  }

  ride(target: string, from: Triple): void {
    this.active.peek().ride(target, from);
  }

  follow(target: string | null): void {
    this.active.peek().follow(target);
  }

  save(): YamlMapping {
    const saved = [...this.saved.peek().map((view) => view.save()), ...this.unknown];
    const panes = this.layout.value !== "one" ? { [PANES]: savePanes(this) } : this.hasPanes ? { [PANES]: null } : {};
    return { Current: this.current.value.save(), Saved: saved.length === 0 ? null : saved, ...panes };
  }

  load(yaml: YamlMapping): string[] {
    const faults = this.loadShown(yaml);
    const saved = Array.isArray(yaml["Saved"]) ? yaml["Saved"].filter((entry: Yaml) => isMapping(entry)) : [];
    this.unknown = saved.filter((entry) => createView(classOfView(entry)) === null);
    this.saved.value = saved.flatMap((entry) => (this.unknown.includes(entry) ? [] : (loadView(entry, faults) ?? [])));
    return [...faults, ...this.unknown.map((entry) => `Views: there is no view ${classOfView(entry)}`)];
  }

  /** The current view, or those of several panes. */
  private loadShown(yaml: YamlMapping): string[] {
    const [current, panes] = [yaml["Current"], yaml[PANES]];
    const layout = isMapping(panes) ? savedLayout(panes) : null;
    if (layout !== null) this.onFileLayout(layout);
    this.hasPanes = layout !== null && this.layout.peek() === layout;
    if (this.hasPanes && isMapping(panes)) return [...loadPanes(this, panes)];
    return isMapping(current) ? this.active.peek().load(current) : [];
  }

  private tick(elapsed: number): void {
    const shown = this.scene.panes.shown.peek();
    for (const pane of shown) this.viewOf(pane).tick(elapsed);
  }

  private viewsOf(panes: readonly Pane[]): readonly PaneView[] {
    return untracked(() => panes.map((pane) => this.viewOf(pane)));
  }

  /** View of a pane, created when it is first shown. */
  private viewOf(pane: Pane): PaneView {
    const known = this.known.get(pane);
    if (known !== undefined) return known;
    const side = FURTHER[this.known.size - 1];
    const first = side === undefined ? new Orbit() : this.besides(side);
    const view = new PaneView(pane, first, this.targetPose, () => this.scene.invalidate());
    this.known.set(pane, view);
    pane.onSide = (from) => {
      this.activate(view);
      view.lookFrom(from);
    };
    return view;
  }

  /** Orthographic view of the active pane's focal point from a side. */
  private besides(side: SixSides): Orbit {
    const { view, target } = this.viewOf(this.scene.panes.active.peek());
    const shown = view.peek();
    const first = new Orbit();
    first.projection.toggle();
    first.targetFrame.value.value = shown.targetFrame.value.peek();
    first.mimic(shown.eye(target), shown.focus(target), target);
    new CameraMotion(first.lookFrom(side), 0).advance(0);
    return first;
  }
}
