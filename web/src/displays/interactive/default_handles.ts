/** Shapes of controls that bring none of their own, as interactive_markers' autoComplete makes them. */

import { Quaternion, Vector3 } from "three";

import type {
  ColorRGBA,
  InteractiveMarker,
  InteractiveMarkerControl,
  Marker,
  Point,
} from "../../protocol/generated/ros_messages";
import { Type } from "../markers/marker_type";
import { InteractionMode } from "./control_modes";

const STEPS = 36;
/** Radii of rings at scale 1 [m]. */
const INNER = 0.5;
const OUTER = 0.65;
const ORIGIN = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } } as const;

/** The marker with handles on controls that have no shape; `alpha`: opacity of the handles. */
export function withHandles(marker: InteractiveMarker, alpha: number): InteractiveMarker {
  const controls = marker.controls.map((control) => ({
    ...control,
    markers: control.markers.length > 0 ? control.markers.map(completed) : handlesOf(marker, control, alpha),
  }));
  return { ...marker, controls };
}

/** Shape whose missing sizes are 1 m. */
function completed(shape: Marker): Marker {
  const { x, y, z } = shape.scale;
  return { ...shape, scale: { x: x || 1, y: y || 1, z: z || 1 } };
}

function handlesOf(marker: InteractiveMarker, control: InteractiveMarkerControl, alpha: number): readonly Marker[] {
  switch (control.interaction_mode) {
    case InteractionMode.moveAxis:
      return [arrow(marker, control, 1, alpha), arrow(marker, control, -1, alpha)];
    case InteractionMode.movePlane:
    case InteractionMode.rotateAxis:
    case InteractionMode.moveRotate:
      return [ring(marker, control, alpha)];
    case InteractionMode.menu:
      return [button(marker, control)];
    default:
      return [];
  }
}

function blank(marker: InteractiveMarker, control: InteractiveMarkerControl, id: number, alpha: number): Marker {
  return {
    header: { ...marker.header, frame_id: "" },
    ns: control.name,
    id,
    type: 0,
    action: 0,
    pose: ORIGIN,
    scale: { x: 1, y: 1, z: 1 },
    color: { ...colorOf(control), a: alpha },
    lifetime: { sec: 0, nsec: 0 },
    frame_locked: true,
    points: [],
    colors: [],
    text: "",
    mesh_resource: "",
    mesh_use_embedded_materials: false,
  };
}

/** Arrow of two points beside the marker, colored by its direction. */
function arrow(marker: InteractiveMarker, control: InteractiveMarkerControl, side: 1 | -1, alpha: number): Marker {
  const size = scaleOf(marker);
  const at = (distance: number): Point => turned(control, new Vector3(side * distance * size, 0, 0));
  return {
    ...blank(marker, control, side, alpha),
    type: Type.arrow,
    scale: { x: 0.15 * size, y: 0.25 * size, z: 0.2 * size },
    points: [at(0.5), at(0.9)],
  };
}

/** The title of a menu, as a text above the marker that can be clicked. */
function button(marker: InteractiveMarker, control: InteractiveMarkerControl): Marker {
  const size = 0.25 * scaleOf(marker);
  const position = { x: -0.1 * size, y: 0, z: 1.2 * scaleOf(marker) - 0.1 * size };
  return {
    ...blank(marker, control, 0, 1),
    type: Type.text,
    text: control.description,
    color: { r: 1, g: 1, b: 1, a: 1 },
    scale: { x: size, y: size, z: size },
    pose: { ...ORIGIN, position },
  };
}

/**
 * A ring in the control's yz plane: striped aslant if it rotates the marker, with teeth if it moves the marker as well.
 */
function ring(marker: InteractiveMarker, control: InteractiveMarkerControl, alpha: number): Marker {
  const size = scaleOf(marker);
  const at = (radius: number, step: number): Point => {
    const angle = (2 * Math.PI * step) / STEPS;
    return turned(control, new Vector3(0, radius * Math.cos(angle), radius * Math.sin(angle)));
  };
  const inner = (step: number): Point => at(INNER * size, step);
  const outer = (step: number): Point => at(OUTER * size, step);
  const shape = { ...blank(marker, control, 0, alpha), type: Type.triangleList };
  if (control.interaction_mode === InteractionMode.rotateAxis) return stripedRing(shape, inner, outer);
  if (control.interaction_mode === InteractionMode.moveRotate) return toothedRing(shape, inner, outer);
  const steps = Array.from({ length: STEPS }, (_, step) => step);
  const points = steps.flatMap((step) => [
    inner(step),
    outer(step),
    inner(step + 1),
    inner(step + 1),
    outer(step),
    outer(step + 1),
  ]);
  return { ...shape, points };
}

function stripedRing(shape: Marker, inner: (step: number) => Point, outer: (step: number) => Point): Marker {
  const points: Point[] = [];
  const colors: ColorRGBA[] = [];
  const opaque = { ...shape.color, a: 1 };
  for (let a = 0; a < STEPS; a++) {
    const [b, c] = [a + 1, a + 2];
    points.push(inner(a), outer(b), inner(b), inner(b), outer(b), outer(c));
    colors.push(...twice(a % 2 === 0 ? dimmed(opaque, 0.6) : opaque));
  }
  return { ...shape, points, colors };
}

/** Ring with teeth, whose bright ones are drawn twice, as in rviz. */
function toothedRing(shape: Marker, inner: (step: number) => Point, outer: (step: number) => Point): Marker {
  const points: Point[] = [];
  const colors: ColorRGBA[] = [];
  for (let a = 0; a < STEPS; a += 2) {
    const [b, c] = [a + 1, a + 2];
    points.push(inner(a), outer(b), inner(b), inner(b), outer(b), inner(c));
    points.push(outer(a), outer(b), inner(a), outer(b), outer(c), inner(c));
    colors.push(...twice({ ...dimmed(shape.color, 0.6), a: 1 }), ...twice(shape.color));
  }
  return { ...shape, points, colors };
}

function dimmed({ r, g, b, a }: ColorRGBA, light: number): ColorRGBA {
  return { r: r * light, g: g * light, b: b * light, a };
}

function twice(color: ColorRGBA): readonly ColorRGBA[] {
  return [color, color];
}

function scaleOf({ scale }: InteractiveMarker): number {
  return scale === 0 ? 1 : scale;
}

function turned({ orientation: { x, y, z, w } }: InteractiveMarkerControl, point: Vector3): Point {
  const turn = new Quaternion(x, y, z, w);
  if (turn.lengthSq() > 0) point.applyQuaternion(turn.normalize());
  return { x: point.x, y: point.y, z: point.z };
}

/** Red for controls along x, green for y, blue for z, mixed for others. */
function colorOf(control: InteractiveMarkerControl): ColorRGBA {
  const axis = turned(control, new Vector3(1, 0, 0));
  const largest = Math.max(Math.abs(axis.x), Math.abs(axis.y), Math.abs(axis.z));
  return { r: Math.abs(axis.x) / largest, g: Math.abs(axis.y) / largest, b: Math.abs(axis.z) / largest, a: 1 };
}
