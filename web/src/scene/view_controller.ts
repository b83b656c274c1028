/** Interface of rviz's views. */

import type { ReadonlySignal, Signal } from "@preact/signals";
import type { Box3, Vector3 } from "three";

import type { Property, Triple, YamlMapping } from "../rviz/properties";

import type { Area } from "./free_area";
import type { CameraInfo } from "./simulated_world";

export type SixSides = "front" | "back" | "left" | "right" | "top" | "bottom";

/** A view of rviz's class: Orbit, XYOrbit, TopDownOrtho, FPS, ThirdPersonFollower. */
export interface ViewController {
  readonly className: string;
  readonly name: Signal<string>;
  readonly properties: readonly Property<unknown>[];
  save(): YamlMapping;
  load(yaml: YamlMapping): string[];
}

export interface Views {
  readonly current: ReadonlySignal<ViewController>;
  /** Where the picture of the camera is that is looked through [px]; null: none is. */
  readonly cameraFrame: ReadonlySignal<Area | null>;
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
  /** Switch between perspective and none, around the same point. */
  toggleProjection(): void;
  /** Look through a simulated camera on a link, `model::link`. */
  lookThrough(camera: CameraInfo, link: string): void;
  /** Look ahead from a point of a frame or body (`model::link`), turning with it. */
  ride(target: string, from: Triple): void;
  /** Keep a body (`model::link`) or frame in the middle; null: stop. */
  follow(target: string | null): void;
  /** The `Views` mapping of an .rviz file. */
  save(): YamlMapping;
  load(yaml: YamlMapping): string[];
}
