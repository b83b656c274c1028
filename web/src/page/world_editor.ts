/** What tools need to change a running world. */

import type { Quaternion, Vector3 } from "three";

import type { SimulatedWorld } from "../scene/simulated_world";
import type { Fields, RequestName } from "../protocol/connection";

export interface WorldEditor {
  readonly world: SimulatedWorld;
  /** Ask the server for something that is not to be undone; a refusal becomes a notice. */
  ask<N extends RequestName>(title: string, request: N, fields: Fields<N>): Promise<boolean>;
  /** Ask the server for an edit; `before` are the fields that take it back. */
  edit<N extends RequestName>(title: string, request: N, after: Fields<N>, before: Fields<N>): Promise<void>;
}

/** A place on its way: of a body, or of the frame of a joint. */
export interface Placement {
  readonly position: Vector3;
  readonly orientation: Quaternion;
}
