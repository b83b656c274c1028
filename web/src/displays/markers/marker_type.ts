/** Types and actions of visualization_msgs/Marker, and a marker's name. */

import type { Marker } from "../../protocol/generated/ros_messages";

export const Type = {
  arrow: 0,
  cube: 1,
  sphere: 2,
  cylinder: 3,
  lineStrip: 4,
  lineList: 5,
  cubeList: 6,
  sphereList: 7,
  points: 8,
  text: 9,
  mesh: 10,
  triangleList: 11,
} as const;

export const TYPE_NAMES = [
  "ARROW",
  "CUBE",
  "SPHERE",
  "CYLINDER",
  "LINE_STRIP",
  "LINE_LIST",
  "CUBE_LIST",
  "SPHERE_LIST",
  "POINTS",
  "TEXT_VIEW_FACING",
  "MESH_RESOURCE",
  "TRIANGLE_LIST",
] as const;

/** MODIFY is ADD. */
export const Action = { add: 0, delete: 2, deleteAll: 3 } as const;

/** A marker's name in rviz's list of statuses. */
export function markerName(marker: Pick<Marker, "ns" | "id">): string {
  return `${marker.ns}/${marker.id}`;
}
