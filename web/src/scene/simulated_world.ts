/** The simulated world as the server describes it (docs/decisions/0020). */

import type { ReadonlySignal, Signal } from "@preact/signals";
import type { Box3, Object3D } from "three";

import type { Draft } from "./draft";
import type { Transform } from "../frames/transform";
import type { ShownParts } from "./overlays/shown_parts";

export type SixNumbers = readonly [number, number, number, number, number, number];
export type Triple = readonly [number, number, number];
export type Colour = Triple;

export interface PluginInfo {
  readonly name: string;
  readonly filename: string;
  readonly source: string | null;
  /** Path below its element (`noise/stddev`) and text. */
  readonly parameters: readonly (readonly [string, string])[];
}

export interface SensorInfo {
  readonly name: string;
  readonly type: string;
  readonly rate: number;
  readonly topic: string | null;
  /** Values of its readings that can be plotted: `angular_velocity.z`. */
  readonly series: readonly string[];
  readonly source: string | null;
  readonly plugins: readonly PluginInfo[];
}

export interface LinkInfo {
  readonly name: string;
  readonly body: number;
  readonly mass: number;
  readonly inertia: SixNumbers;
  readonly inertial_pose: SixNumbers;
  readonly friction: readonly [number, number] | null;
  readonly source: string | null;
  readonly sensors: readonly SensorInfo[];
}

export interface JointInfo {
  readonly name: string;
  readonly type: string;
  readonly parent: string;
  readonly child: string;
  readonly lower: number | null;
  readonly upper: number | null;
  /** Its frame in the child's. */
  readonly pose: SixNumbers;
  /** Directions of its axes in the child's frame. */
  readonly axes: readonly Triple[];
  readonly index: number | null;
  readonly source: string | null;
}

export interface ModelInfo {
  readonly name: string;
  readonly static: boolean;
  /** True if its base is fixed where it is, until it is freed. */
  readonly held: boolean;
  readonly source: string | null;
  readonly links: readonly LinkInfo[];
  readonly joints: readonly JointInfo[];
  readonly plugins: readonly PluginInfo[];
  readonly models: readonly ModelInfo[];
}

export interface LightInfo {
  readonly name: string;
  readonly type: string;
  /** The body it is on, in whose frame its pose is; null: the world's. */
  readonly body: number | null;
  readonly pose: SixNumbers;
  /** Where it shines, in its own frame. */
  readonly direction: Triple;
  readonly diffuse: Colour;
  readonly intensity: number;
}

export interface CameraInfo {
  readonly name: string;
  readonly topic: string;
  readonly body: number;
  readonly pose: SixNumbers;
  readonly horizontal_fov: number;
  readonly width: number;
  readonly height: number;
  /** Nearest and farthest that it draws [m]. */
  readonly near: number;
  readonly far: number;
  readonly rate: number;
}

export interface Manifest {
  readonly generation: number;
  readonly name: string;
  /** Path to save the world at; null: it cannot be written. */
  readonly file: string | null;
  readonly files: readonly { readonly id: string; readonly url: string }[];
  readonly collisions: string | null;
  readonly scene: {
    readonly ambient: Colour;
    readonly background: Colour;
    readonly sky: boolean;
    readonly shadows: boolean;
    readonly grid: boolean;
    readonly fog: {
      readonly type: string;
      readonly color: Colour;
      readonly start: number;
      readonly end: number;
      readonly density: number;
    } | null;
  };
  readonly physics: { readonly gravity: Triple; readonly wind: Triple; readonly step: number };
  readonly robot: number | null;
  readonly models: readonly ModelInfo[];
  /** Of the world itself. */
  readonly plugins: readonly PluginInfo[];
  readonly lights: readonly LightInfo[];
  readonly cameras: readonly CameraInfo[];
  readonly frames: readonly { readonly frame: string; readonly parent: string; readonly body: number }[];
  /** Copy of a model that is edited, in whose place it is shown. */
  readonly draft?: Draft | null;
}

/** The clock of the simulation or recording. */
export interface WorldState {
  readonly time_ns: number;
  readonly paused: boolean;
  readonly real_time_factor: number | null;
  readonly speed: number | null;
  readonly timeline?: { readonly start_ns: number; readonly end_ns: number };
  readonly recording?: { readonly since_ns: number } | null;
}

/** Position [rad, m], velocity and effort of a joint. */
export interface JointState {
  readonly position: number;
  readonly velocity: number;
  readonly effort: number;
}

/** States of all joints at a moment, by the index that the manifest gives each. */
export interface JointStates {
  at(index: number): JointState | undefined;
}

export interface SimulatedWorld {
  /** Null where nothing is simulated or recorded. */
  readonly manifest: ReadonlySignal<Manifest | null>;
  readonly state: ReadonlySignal<WorldState | null>;
  /** Share of the files that has arrived, 0…1. */
  readonly progress: ReadonlySignal<number>;
  /** Sentences about files that could not be shown. */
  readonly faults: ReadonlySignal<readonly string[]>;
  /** Changes at 10 Hz while something listens. */
  readonly joints: ReadonlySignal<JointStates>;
  /** What of the world is shown. */
  readonly shown: ShownParts;
  /** Names (`model` or `model::link`) that are hidden. */
  readonly hidden: Signal<ReadonlySet<string>>;
  /** Call a function with the time [s] of poses as they come; returns how to end it. */
  onPoses(call: (time: number) => void): () => void;
  /** Newest pose of a body in the world; null before the first. */
  pose(body: number): Transform | null;
  object(body: number): Object3D | null;
  bounds(bodies: readonly number[]): Box3;
}
