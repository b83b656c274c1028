/** What tools need to change a running world. */

import type { SimulatedWorld } from "../scene/simulated_world";
import type { Fields, RequestName } from "../protocol/connection";

export interface WorldEditor {
  readonly world: SimulatedWorld;
  /** Ask the server for something that is not to be undone; a refusal becomes a notice. */
  ask<N extends RequestName>(title: string, request: N, fields: Fields<N>): Promise<boolean>;
  /** Ask the server for an edit; `before` are the fields that take it back. */
  edit<N extends RequestName>(title: string, request: N, after: Fields<N>, before: Fields<N>): Promise<void>;
}
