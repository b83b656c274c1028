/** Interface of rviz's views. */

import type { ReadonlySignal, Signal } from "@preact/signals";
import type { Box3, Vector3 } from "three";

import type { CameraInfo } from "../protocol/generated/page_messages";
import type { Property, Triple, YamlMapping } from "../rviz/properties";

import type { Area } from "./free_area";
import type { PaneLayout, PaneArea } from "./panes/pane_layout";

export type SixSides = "front" | "back" | "left" | "right" | "top" | "bottom";

/** A view of rviz's class: Orbit, XYOrbit, TopDownOrtho, FPS, ThirdPersonFollower. */
export interface ViewController {
  readonly className: string;
  readonly name: Signal<string>;
  readonly properties: readonly Property<unknown>[];
  save(): YamlMapping;
  load(yaml: YamlMapping): string[];
}

/** A part of the scene that has a view of its own. */
export interface ViewPane {
  readonly current: ReadonlySignal<ViewController>;
  readonly place: ReadonlySignal<PaneArea>;
  /** The part that no panel covers, within the pane [px]. */
  readonly free: ReadonlySignal<Area>;
  /** True once anything but `frameFirst` has changed its view. */
  readonly isChosen: Signal<boolean>;
  /** Move smoothly so that a box of the fixed frame fills the pane, unless its view was chosen. */
  frameFirst(box: Box3): void;
  /** Rectangle of the picture in the pane while looking through a camera [px]; null: not through a camera. */
  readonly cameraFrame: ReadonlySignal<Area | null>;
  /** Load a view from a file. */
  load(yaml: YamlMapping): string[];
}

export interface Views {
  readonly layout: Signal<PaneLayout>;
  /** Called with a file's layout, which it applies; a page that keeps its own layout replaces this function. */
  onFileLayout: (layout: PaneLayout) => void;
  /** Panes that are shown. */
  readonly panes: ReadonlySignal<readonly ViewPane[]>;
  /** Active pane, whose view the other members concern. */
  readonly active: ReadonlySignal<ViewPane>;
  activate(pane: ViewPane): void;
  /** Activate the pane that is `by` after the active one. */
  stepPane(by: number): void;
  readonly current: ReadonlySignal<ViewController>;
  readonly classes: readonly string[];
  readonly saved: Signal<readonly ViewController[]>;
  use(className: string): void;
  useSaved(view: ViewController): void;
  /** The current view as one to save. */
  copyCurrent(name: string): ViewController;
  /** Move smoothly so that a box of the fixed frame fills the free part of the scene. */
  frame(box: Box3): void;
  focus(point: Vector3): void;
  lookFrom(side: SixSides): void;
  /** Switch between a perspective and an orthographic view of the same focal point. */
  toggleProjection(): void;
  /** Look through a simulated camera on a link, `model::link`. */
  lookThrough(camera: CameraInfo, link: string): void;
  /** Look ahead from a point of a frame or body (`model::link`), turning with it. */
  ride(target: string, from: Triple): void;
  /** Keep a body (`model::link`) or frame in the middle; null: stop. */
  follow(target: string | null): void;
  /** The `Views` mapping of an .rviz file; several panes have a key of Trundle's, which rviz ignores. */
  save(): YamlMapping;
  load(yaml: YamlMapping): string[];
}
