/** Messages of nav_msgs and map_msgs. */

import type { RosTime } from "../ros_types";
import type { Point, Pose, PoseStamped, PoseWithCovariance, TwistWithCovariance } from "./geometry_msgs";
import type { Header } from "./std_msgs";

export type Odometry = {
  readonly header: Header;
  readonly child_frame_id: string;
  readonly pose: PoseWithCovariance;
  readonly twist: TwistWithCovariance;
};

export type Path = { readonly header: Header; readonly poses: readonly PoseStamped[] };

export type MapMetaData = {
  readonly map_load_time: RosTime;
  /** [m] of a cell. */
  readonly resolution: number;
  readonly width: number;
  readonly height: number;
  readonly origin: Pose;
};

/** Cells 0…100, −1 unknown, by rows from the origin. */
export type OccupancyGrid = { readonly header: Header; readonly info: MapMetaData; readonly data: Int8Array };

export type GridCells = {
  readonly header: Header;
  readonly cell_width: number;
  readonly cell_height: number;
  readonly cells: readonly Point[];
};

/** A rectangle of a map: map_msgs/OccupancyGridUpdate. */
export type OccupancyGridUpdate = {
  readonly header: Header;
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
  readonly data: Int8Array;
};
