/** An object that handles move, and its drag. */

import type { Vector3 } from "three";

import type { Transform } from "../../frames/transform";
import type { Request } from "../../protocol/connection";

export interface HandleTarget {
  /** "Move of cart". */
  readonly title: string;
  /** Bodies that move with it. */
  readonly bodies: readonly number[];
  /** Single axis, in the frame of `pose`; null: all axes. */
  readonly axis: { readonly direction: Vector3; readonly turns: boolean } | null;
  /** Pose of the handles in the world; null: the object was removed. */
  pose(): Transform | null;
  /** True: the edit is recorded elsewhere, as in the draft. */
  readonly isRemembered?: boolean;
  /** Begin a drag; returns its requests. */
  begin(): Drawn;
}

export interface Drawn {
  /** Request during the drag; null: none. */
  move(to: Transform): Request | null;
  /** Request that ends the drag, before the last `place`; null: none. */
  readonly release: Request | null;
  place(to: Transform): Request;
  /** Text of a joint's position during the drag. */
  describe?(to: Transform): string;
}
