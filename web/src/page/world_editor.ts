/** What tools need to change a running world. */

import type { Quaternion, Vector3 } from "three";

import type { SimulatedWorld } from "../scene/simulated_world";
import type { Fields } from "./request_fields";

export interface WorldEditor {
  readonly world: SimulatedWorld;
  /** Ask the server for something that is not to be undone; a refusal becomes a notice. */
  ask(title: string, request: string, fields: Fields): Promise<boolean>;
  /** Ask the server for an edit; `before` are the fields that take it back. */
  edit(title: string, request: string, after: Fields, before: Fields): Promise<void>;
}

/** A place on its way: of a body, or of the frame of a joint. */
export interface Placement {
  readonly position: Vector3;
  readonly orientation: Quaternion;
}
