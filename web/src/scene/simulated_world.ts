/** The simulated world as it is drawn. */

import type { ReadonlySignal, Signal } from "@preact/signals";
import type { Box3, Object3D } from "three";

import type { ClockState, Manifest, ReferenceInfo } from "../protocol/generated/page_messages";
import type { Transform } from "../frames/transform";
import type { ShownParts } from "./overlays/shown_parts";
import type { ReferenceMotion } from "./world/reference_motion";

export type SixNumbers = readonly [number, number, number, number, number, number];
export type Triple = readonly [number, number, number];

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

/** Recording that the world, or the graph, is compared with. */
export interface Reference {
  readonly info: ReferenceInfo;
  readonly motion: ReferenceMotion;
}

export interface SimulatedWorld {
  /** Null where nothing is simulated or recorded. */
  readonly manifest: ReadonlySignal<Manifest | null>;
  readonly state: ReadonlySignal<ClockState | null>;
  /** Ratio of the files that has arrived, 0…1. */
  readonly progress: ReadonlySignal<number>;
  /** True while a picture shows all files. */
  readonly isDrawn: ReadonlySignal<boolean>;
  /** Sentences about files that could not be shown. */
  readonly faults: ReadonlySignal<readonly string[]>;
  /** Changes at 10 Hz while something listens. */
  readonly joints: ReadonlySignal<JointStates>;
  /** Description of the recording to compare with; null: nothing is compared. */
  readonly referenceInfo: ReadonlySignal<ReferenceInfo | null>;
  /** Null: nothing is compared, or it is not loaded yet. */
  readonly reference: ReadonlySignal<Reference | null>;
  /** Shown parts of the world. */
  readonly shown: ShownParts;
  /** Names (`model` or `model::link`) that are hidden. */
  readonly hidden: Signal<ReadonlySet<string>>;
  /** Call a function with the time [s] of poses as they come; returns a function that stops it. */
  onPoses(call: (time: number) => void): () => void;
  /** Newest pose of a body in the world; null before the first. */
  pose(body: number): Transform | null;
  object(body: number): Object3D | null;
  bounds(bodies: readonly number[]): Box3;
  /** Extent of the compared recording's ghost of a model, or null: of all its models; empty: none is shown. */
  referenceBounds(model: string | null): Box3;
  /** Extent of bodies' visible surfaces in the axes of one of them, so that it is the same wherever they stand. */
  extent(bodies: readonly number[], of: number): Box3;
}
