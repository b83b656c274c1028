/** Interface of the 3D view, for displays and tools. */

import type { ReadonlySignal, Signal } from "@preact/signals";
import type {
  Camera,
  Group,
  Object3D,
  OrthographicCamera,
  PerspectiveCamera,
  Ray,
  Vector3,
  WebGLRenderer,
} from "three";

import type { Area, Insets } from "./free_area";

/** Object under a pointer. */
export interface Pick {
  /** Point in the fixed frame [m]. */
  readonly point: Vector3;
  readonly object: Object3D;
  /** Index of the instance or point within the object, if it has several. */
  readonly index: number | null;
}

/** Entry `selectable` of `Object3D.userData`: makes an object and those below it selectable. */
export interface Selectable {
  /** Name and value pairs of the picked object; nested for messages. */
  describe(index: number | null): Readonly<Record<string, unknown>>;
  /** Indices of the points within a box, for objects that are not of three.js' own kinds. */
  indicesIn?(contains: (point: Vector3) => boolean): readonly number[];
}

/** A pointer at an object that has handlers. */
export interface TargetEvent {
  /** Position in the scene's element [px]. */
  readonly x: number;
  readonly y: number;
  /** Ray from the camera through that position, in the fixed frame. */
  readonly ray: Ray;
  /** Picked object there; null while it is dragged off its object. */
  readonly pick: Pick | null;
  readonly button: number;
  readonly shift: boolean;
  readonly control: boolean;
}

/** Entry `pointerTarget` of `Object3D.userData`: the tool Interact hands it the pointer's events. */
export interface PointerTarget {
  /** Called when the pointer enters or leaves the object. */
  hover(isOver: boolean): void;
  /** Called when a button goes down on the object; true: the object handles the drag. */
  down(event: TargetEvent): boolean;
  move(event: TargetEvent): void;
  /** Called when the drag ends; `isCancelled`: undo it. */
  up(event: TargetEvent, isCancelled: boolean): void;
}

/** Text at an object; the scene lays labels out without overlap. */
export interface Label {
  readonly anchor: Object3D;
  text: string;
  /** Second text, shown while the label is hovered: "in camera_base". */
  detail: string;
  /** Full text, shown while the label is hovered. */
  full: string;
  /** Rank of a robot's frame: only the few of lowest rank have labels; null: no robot's frame. */
  rank: number | null;
  /** True: it shows only while it is hovered. */
  isQuiet: boolean;
  /** Distance in front of the anchor in which a surface, such as the anchor's own, does not cover the label [m]. */
  reach: number;
  remove(): void;
}

/** A rectangle of the picture [px]. */
export interface PictureBox {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

export type SceneStatus =
  | { readonly kind: "drawing" }
  /** The graphics context was lost; the browser may give it back. */
  | { readonly kind: "lost" }
  /** Nothing can be drawn; the reason is a sentence. */
  | { readonly kind: "unsupported"; readonly reason: string };

/** Additional drawing steps of a picture: shadow maps before the scene, outlines after it. */
export interface DrawStep {
  /** Before the picture, once for all panes. */
  before?(renderer: WebGLRenderer): void;
  /** Before a pane of this height [px], which its camera sees. */
  beforePane?(camera: PerspectiveCamera | OrthographicCamera, height: number): void;
  /** After a pane, over it: the renderer's viewport is the pane. */
  afterPane?(renderer: WebGLRenderer, camera: Camera): void;
  after?(renderer: WebGLRenderer): void;
}

export interface SceneView {
  readonly status: ReadonlySignal<SceneStatus>;
  /** True where the browser draws on the CPU: edges are smooth only while nothing changes. */
  readonly isSlow: boolean;
  /** Root of displays, in the fixed frame: x forward, z up [m]. */
  readonly displays: Group;
  /** Root of the simulated world, placed at its frame in the fixed frame. */
  readonly world: Group;
  /** The camera of the pane that the pointer is in. */
  readonly camera: ReadonlySignal<PerspectiveCamera | OrthographicCamera>;
  /** Element that has the pointer's events. */
  readonly element: HTMLCanvasElement;
  /** Size of the element [px]. */
  readonly size: ReadonlySignal<{ readonly width: number; readonly height: number }>;
  /** Insets of the element under panels; the camera's target stays in the middle of the rest. */
  readonly freeArea: Signal<Insets>;
  /** Size of the pane that the pointer is in [px]. */
  readonly paneSize: ReadonlySignal<{ readonly width: number; readonly height: number }>;
  /** The part of the active pane that no panel covers, in the element [px]. */
  readonly freePart: ReadonlySignal<Area>;
  /** CSS color behind everything, as "#16191c" or "rgb(22, 25, 28)". */
  readonly background: Signal<string>;
  /** The ground's grid. */
  readonly grid: Signal<boolean>;
  /** Request drawing at the next frame; nothing is drawn otherwise. */
  invalidate(): void;
  /** Call a function at each animation frame with the seconds since the last one; returns a function that stops it. */
  onTick(callback: (elapsed: number) => void): () => void;
  addStep(step: DrawStep): () => void;
  /** Picture of the view, drawn once in a given size [px]; throws a sentence if that fails. */
  picture(width: number, height: number): HTMLCanvasElement;
  /** Object under a point of the element [px]; null: none. */
  pick(x: number, y: number): Pick | null;
  /** Objects within a box of the element [px], at most `limit`. */
  pickBox(box: PictureBox, limit: number): readonly Pick[];
  /** Ray from the camera through a point of the element, in the fixed frame. */
  ray(x: number, y: number): Ray;
  /** Point at which the ray through a point of the element meets the plane z = 0 of the fixed frame. */
  pickGround(x: number, y: number): Vector3 | null;
  /** `color`: token of the label's background color. */
  addLabel(anchor: Object3D, text: string, color?: `--${string}`): Label;
}
