import type { Vector3 } from "three";

import type { Selection } from "../../page/page";

/** What a menu is open for, and where. */
export interface OpenMenu {
  readonly selection: Selection | null;
  /** Corner of the menu in the page [px]. */
  readonly x: number;
  readonly y: number;
  /** Where it was asked for, in the world [m]; null: in a list. */
  readonly at: Vector3 | null;
  /** What gets the focus back. */
  readonly from: Element | null;
}
