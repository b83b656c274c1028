/** Messages of std_msgs. Type aliases, not interfaces: they are also a `RosMessage`. */

import type { RosTime } from "../ros_types";

export type Header = {
  readonly seq: number;
  readonly stamp: RosTime;
  readonly frame_id: string;
};

/** Each part 0…1. */
export type ColorRGBA = { readonly r: number; readonly g: number; readonly b: number; readonly a: number };

/** A message of one field: Bool, String, Float64 and their like. */
export type Data<T> = { readonly data: T };

export type Empty = Record<string, never>;
