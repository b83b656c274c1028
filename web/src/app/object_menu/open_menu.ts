import type { Vector3 } from "three";

import type { Selection } from "../../page/page";

/** Open menu: its object and its position. */
export interface OpenMenu {
  readonly selection: Selection | null;
  /** Corner of the menu in the page [px]. */
  readonly x: number;
  readonly y: number;
  /** Point of the world where the menu was opened [m]; null: in a list. */
  readonly at: Vector3 | null;
  /** Element that regains the focus when the menu closes. */
  readonly from: Element | null;
}
