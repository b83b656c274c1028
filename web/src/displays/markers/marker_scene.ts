/** Shown markers: their poses, lifetimes and views. */

import { Group, Matrix4, Quaternion, Vector3 } from "three";

import type { Marker, Pose } from "../../protocol/generated/ros_messages";
import { nanoseconds } from "../../protocol/ros_types";
import type { Transform } from "../../frames/transform";
import type { Selectable } from "../../scene/scene_view";
import { Type, markerName, TYPE_NAMES } from "./marker_type";
import { makeView, type MarkerView, type ViewParts } from "./marker_views";
import { SolidBatches } from "./solid_batches";

interface Shown {
  marker: Marker;
  /** ROS time at which it expires [ns]; null: never. */
  expires: bigint | null;
  isVisible: boolean;
  /** Pose in the fixed frame. */
  readonly matrix: Matrix4;
  /** Null: it is one of the instances. */
  view: MarkerView | null;
}

const UNIT = new Vector3(1, 1, 1);
const position = new Vector3();
const orientation = new Quaternion();
const matrix = new Matrix4();

export class MarkerScene extends Group {
  private readonly shown = new Map<string, Shown>();
  private readonly parts: ViewParts;
  private readonly batches: SolidBatches;
  private isStale = false;

  constructor(parts: Omit<ViewParts, "describe">) {
    super();
    this.parts = { ...parts, describe: describeMarker };
    this.batches = new SolidBatches(describeMarker);
    super.add(this.batches);
  }

  get size(): number {
    return this.shown.size;
  }

  /** Add or change a marker at the pose of its frame in the fixed frame. */
  put(marker: Marker, frame: Transform, now: bigint, isVisible: boolean): void {
    const name = markerName(marker);
    this.drop(name);
    const lifetime = nanoseconds(marker.lifetime);
    const shown: Shown = {
      marker,
      isVisible,
      matrix: new Matrix4(),
      view: null,
      expires: lifetime > 0n ? now + lifetime : null,
    };
    this.shown.set(name, shown);
    if (marker.type > Type.cylinder) this.addView(shown);
    this.place(shown, frame);
    this.isStale = true;
  }

  delete(name: string): void {
    this.drop(name);
  }

  deleteAll(): void {
    for (const name of [...this.shown.keys()]) this.drop(name);
  }

  setVisible(namespace: string, isVisible: boolean): void {
    for (const shown of this.shown.values()) {
      if (shown.marker.ns !== namespace || shown.isVisible === isVisible) continue;
      shown.isVisible = isVisible;
      if (shown.view === null) this.isStale = true;
      else shown.view.object.visible = isVisible;
    }
  }

  /** Drop expired markers. */
  expire(now: bigint, onExpired: (name: string) => void): void {
    for (const [name, { expires }] of this.shown) {
      if (expires === null || expires > now) continue;
      this.drop(name);
      onExpired(name);
    }
  }

  /** Move markers as their frames move: the locked ones, or all. */
  follow(filter: "locked" | "all", find: (marker: Marker) => Transform | null): void {
    for (const shown of this.shown.values()) {
      if (filter === "locked" && !shown.marker.frame_locked) continue;
      const frame = find(shown.marker);
      if (frame !== null) this.place(shown, frame);
    }
  }

  /** Draw changed markers; true: any changed. */
  refresh(): boolean {
    if (!this.isStale) return false;
    this.isStale = false;
    this.batches.begin();
    for (const { view, isVisible, marker, matrix: pose } of this.shown.values()) {
      if (view === null && isVisible) this.batches.draw(marker, pose);
    }
    this.batches.finish();
    return true;
  }

  override dispose(): void {
    this.deleteAll();
    this.batches.dispose();
  }

  private addView(shown: Shown): void {
    const view = makeView(shown.marker, this.parts);
    const selectable: Selectable = { describe: () => describeMarker(shown.marker) };
    view.object.name = "Marker";
    view.object.userData["selectable"] = selectable;
    view.object.visible = shown.isVisible;
    shown.view = view;
    super.add(view.object);
  }

  private place(shown: Shown, frame: Transform): void {
    poseMatrix(shown.marker.pose, matrix);
    matrix.premultiply(frameMatrix(frame));
    if (shown.matrix.equals(matrix)) return;
    shown.matrix.copy(matrix);
    this.isStale = true;
    if (shown.view !== null) matrix.decompose(shown.view.object.position, shown.view.object.quaternion, position);
  }

  private drop(name: string): void {
    const shown = this.shown.get(name);
    if (shown === undefined) return;
    this.shown.delete(name);
    this.isStale = true;
    shown.view?.object.removeFromParent();
    shown.view?.dispose();
  }
}

const frameOf = new Matrix4();

function frameMatrix({ position: at, orientation: turn }: Transform): Matrix4 {
  return frameOf.compose(at, turn, UNIT);
}

/** Matrix of a pose; one whose quaternion is all zeros is not turned. */
export function poseMatrix({ position: p, orientation: q }: Pose, result: Matrix4): Matrix4 {
  orientation.set(q.x, q.y, q.z, q.w);
  if (orientation.lengthSq() === 0) orientation.identity();
  else orientation.normalize();
  return result.compose(position.set(p.x, p.y, p.z), orientation, UNIT);
}

function describeMarker(marker: Marker): Readonly<Record<string, unknown>> {
  const { pose, scale, color, text, points } = marker;
  const fields: Record<string, unknown> = {
    Marker: markerName(marker),
    Type: TYPE_NAMES[marker.type] ?? marker.type,
    Frame: marker.header.frame_id,
    Position: pose.position,
    Orientation: pose.orientation,
    Scale: scale,
    Color: color,
  };
  if (points.length > 0) fields["Points"] = points.length;
  if (text !== "") fields["Text"] = text;
  return fields;
}
