/** Messages of visualization_msgs. */

import type { RosTime } from "../ros_types";
import type { Point, Pose, Quaternion, Vector3 } from "./geometry_msgs";
import type { ColorRGBA, Header } from "./std_msgs";

export type Marker = {
  readonly header: Header;
  readonly ns: string;
  readonly id: number;
  /** 0 arrow … 11 triangle list. */
  readonly type: number;
  /** 0 add or modify, 2 delete, 3 delete all. */
  readonly action: number;
  readonly pose: Pose;
  readonly scale: Vector3;
  readonly color: ColorRGBA;
  readonly lifetime: RosTime;
  readonly frame_locked: boolean;
  readonly points: readonly Point[];
  readonly colors: readonly ColorRGBA[];
  readonly text: string;
  readonly mesh_resource: string;
  readonly mesh_use_embedded_materials: boolean;
};

export type MarkerArray = { readonly markers: readonly Marker[] };

export type MenuEntry = {
  readonly id: number;
  readonly parent_id: number;
  readonly title: string;
  readonly command: string;
  readonly command_type: number;
};

export type InteractiveMarkerControl = {
  readonly name: string;
  readonly orientation: Quaternion;
  readonly orientation_mode: number;
  readonly interaction_mode: number;
  readonly always_visible: boolean;
  readonly markers: readonly Marker[];
  readonly independent_marker_orientation: boolean;
  readonly description: string;
};

export type InteractiveMarker = {
  readonly header: Header;
  readonly pose: Pose;
  readonly name: string;
  readonly description: string;
  readonly scale: number;
  readonly menu_entries: readonly MenuEntry[];
  readonly controls: readonly InteractiveMarkerControl[];
};

export type InteractiveMarkerPose = { readonly header: Header; readonly pose: Pose; readonly name: string };

export type InteractiveMarkerUpdate = {
  readonly server_id: string;
  readonly seq_num: bigint;
  /** 0 keep alive, 1 update. */
  readonly type: number;
  readonly markers: readonly InteractiveMarker[];
  readonly poses: readonly InteractiveMarkerPose[];
  readonly erases: readonly string[];
};

export type InteractiveMarkerInit = {
  readonly server_id: string;
  readonly seq_num: bigint;
  readonly markers: readonly InteractiveMarker[];
};

export type InteractiveMarkerFeedback = {
  readonly header: Header;
  readonly client_id: string;
  readonly marker_name: string;
  readonly control_name: string;
  /** 0 keep alive, 1 pose update, 2 menu select, 3 button click, 4 mouse down, 5 mouse up. */
  readonly event_type: number;
  readonly pose: Pose;
  readonly menu_entry_id: number;
  readonly mouse_point: Point;
  readonly mouse_point_valid: boolean;
};
