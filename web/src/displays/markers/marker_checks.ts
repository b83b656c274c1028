/** Faults of a marker, in rviz's words. */

import type { Marker } from "../../protocol/generated/ros_messages";
import type { StatusLevel } from "../../rviz/status_level";
import { Type } from "./marker_type";

export interface MarkerFault {
  readonly level: Extract<StatusLevel, "warn" | "error">;
  readonly text: string;
}

type Report = (level: "warn" | "error", text: string) => void;

/** Faults of an added marker as one status; null: none. Level "error": the marker cannot be drawn. */
export function checkMarker(marker: Marker): MarkerFault | null {
  const texts: string[] = [];
  let level: "warn" | "error" = "warn";
  const report: Report = (worse, text) => {
    if (worse === "error") level = "error";
    texts.push(text);
  };
  if (!isFinite(marker)) return { level: "error", text: "Contains invalid floating point values (nans or infs)" };
  checkByType(marker, report);
  return texts.length === 0 ? null : { level, text: texts.join(" \n") };
}

function checkByType(marker: Marker, report: Report): void {
  const { type, points, scale } = marker;
  if (type < Type.arrow || type > Type.triangleList) {
    report("error", `Unknown marker type: ${type}`);
    return;
  }
  const isArrowOfPoints = type === Type.arrow && points.length > 0;
  if (!isArrowOfPoints) checkQuaternion(marker, report);
  checkScale(marker, report);
  checkPoints(marker, report);
  checkColors(marker, report);
  if (type === Type.text) {
    if (marker.text.trim() === "") report("warn", "Text is empty or only consists of whitespace.");
  } else if (marker.text !== "") report("warn", "Non-empty text is ignored.");
  if (type === Type.mesh) {
    if (marker.mesh_resource === "") report("error", "Empty mesh_resource path.");
  } else {
    if (marker.mesh_resource !== "") report("warn", "Non-empty mesh_resource is ignored.");
    if (marker.mesh_use_embedded_materials) report("warn", "mesh_use_embedded_materials is ignored.");
  }
  if (isArrowOfPoints && (scale.x === 0 || scale.y === 0)) report("warn", "Scale contains 0.0 in x or y.");
}

function checkQuaternion({ pose }: Marker, report: Report): void {
  const { x, y, z, w } = pose.orientation;
  const length = x * x + y * y + z * z + w * w;
  if (length === 0) report("warn", "Uninitialized quaternion, assuming identity.");
  else if (Math.abs(length - 1) > 10e-3) report("warn", "Unnormalized quaternion in marker message.");
}

function checkScale({ type, scale, points }: Marker, report: Report): void {
  switch (type) {
    case Type.lineStrip:
    case Type.lineList:
      if (scale.x === 0) report("error", "Width LINE_LIST or LINE_STRIP is 0.0 (scale.x).");
      else if (scale.y !== 0 || scale.z !== 0)
        report("warn", "scale.y and scale.z of LINE_LIST or LINE_STRIP are ignored.");
      return;
    case Type.points:
      if (scale.x === 0 || scale.y === 0) report("error", "Width and/or height of POINTS is 0.0 (scale.x, scale.y).");
      else if (scale.z !== 0) report("warn", "scale.z of POINTS is ignored.");
      return;
    case Type.text:
      if (scale.z === 0) report("error", "Text height of TEXT_VIEW_FACING is 0.0 (scale.z).");
      else if (scale.x !== 0 || scale.y !== 0) report("warn", "scale.x and scale.y of TEXT_VIEW_FACING are ignored.");
      return;
    default:
      if (type === Type.arrow && points.length > 0) return;
      if (scale.x === 0 || scale.y === 0 || scale.z === 0) report("warn", "Scale contains 0.0 in x, y or z.");
  }
}

function checkPoints({ type, points }: Marker, report: Report): void {
  const count = points.length;
  switch (type) {
    case Type.arrow:
      if (count !== 0 && count !== 2) report("error", "Number of points for an ARROW marker should be either 0 or 2.");
      return;
    case Type.lineStrip:
    case Type.lineList:
    case Type.cubeList:
    case Type.sphereList:
    case Type.points:
    case Type.triangleList:
      if (count === 0) report("error", "Points should not be empty for specified marker type.");
      if (type === Type.triangleList && count % 3 !== 0) {
        report("error", "Number of points should be a multiple of 3 for TRIANGLE_LIST marker.");
      }
      if (type === Type.lineList && count % 2 !== 0)
        report("error", "Number of points should be a multiple of 2 for LINE_LIST marker.");
      if (type === Type.lineStrip && count === 1)
        report("error", "At least two points are required for a LINE_STRIP marker.");
      return;
    default:
      if (count > 0) report("warn", "Non-empty points array is ignored.");
  }
}

function checkColors(marker: Marker, report: Report): void {
  const { type, points, colors, color } = marker;
  const hasColors = (type >= Type.lineStrip && type <= Type.points) || type === Type.triangleList;
  if (colors.length > 0 && !hasColors) report("warn", "Non-empty colors array is ignored.");
  if (hasColors && colors.length > 0) {
    const perTriangle = type === Type.triangleList && 3 * colors.length === points.length;
    if (colors.length !== points.length && !perTriangle)
      report("error", "Number of colors doesn't match number of points.");
    return;
  }
  const isEmbedded = type === Type.mesh && marker.mesh_use_embedded_materials;
  if (color.a === 0 && !isEmbedded) report("warn", "Marker is fully transparent (color.a is 0.0).");
}

function isFinite({ pose, scale, color, points, colors }: Marker): boolean {
  const { position: p, orientation: q } = pose;
  const sum =
    p.x + p.y + p.z + q.x + q.y + q.z + q.w + scale.x + scale.y + scale.z + color.r + color.g + color.b + color.a;
  return (
    Number.isFinite(sum) &&
    points.every(({ x, y, z }) => Number.isFinite(x + y + z)) &&
    colors.every(({ r, g, b, a }) => Number.isFinite(r + g + b + a))
  );
}
