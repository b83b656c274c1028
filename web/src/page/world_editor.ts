/** Interface with which tools change a running world. */

import type { SimulatedWorld } from "../scene/simulated_world";
import type { Fields, RequestName } from "../protocol/connection";

export interface WorldEditor {
  readonly world: SimulatedWorld;
  /** Send a request that cannot be undone; a refusal becomes a notice. */
  ask<N extends RequestName>(title: string, request: N, fields: Fields<N>): Promise<boolean>;
  /** Send an edit; `before` are the fields that undo it. */
  edit<N extends RequestName>(title: string, request: N, after: Fields<N>, before: Fields<N>): Promise<void>;
}
