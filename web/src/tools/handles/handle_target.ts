/** An object that handles move, and its drag. */

import type { Vector3 } from "three";

import type { Transform } from "../../frames/transform";
import type { Request } from "../../protocol/connection";

export interface HandleTarget {
  /** "Move of cart". */
  readonly title: string;
  /** Bodies that go with it. */
  readonly bodies: readonly number[];
  /** Its only axis, in the frame of `pose`, if it has only one. */
  readonly axis: { readonly direction: Vector3; readonly turns: boolean } | null;
  /** Place of the handles in the world; null: it is gone. */
  pose(): Transform | null;
  /** True: what it moves remembers the edit, which is only asked for. */
  readonly isRemembered?: boolean;
  /** A drag begins; returns what it asks for on its way, and at its end. */
  begin(): Drawn;
}

export interface Drawn {
  /** While it is dragged; null: nothing is asked before its end. */
  move(to: Transform): Request | null;
  /** To end the drag, before what is asked for last; null: nothing. */
  readonly release: Request | null;
  place(to: Transform): Request;
  /** A joint's position on its way. */
  describe?(to: Transform): string;
}
