/** An interactive marker in the scene, and the feedback that it gives. */

import { Group, Quaternion, Vector3 } from "three";

import { NoTransform, type Transform } from "../../frames/transform";
import type { InteractiveMarker, InteractiveMarkerFeedback, Pose } from "../../protocol/generated/ros_messages";
import { nanoseconds } from "../../protocol/ros_types";
import type { Label, Selectable, TargetEvent } from "../../scene/scene_view";
import type { DisplayContext } from "../display";
import type { ViewParts } from "../markers/marker_views";
import type { Rgb } from "../../rviz/properties";
import { Axes } from "../../shapes/axes";
import { FeedbackEvent, InteractionMode } from "./control_modes";
import { ControlView, type ControlEvents } from "./control_view";
import { Drag } from "./drag";
import { openMenu } from "./menu";

/** Wall seconds between keep-alive messages while a marker is dragged. */
const KEEP_ALIVE_S = 0.25;

export interface MarkerLooks {
  readonly descriptions: boolean;
  readonly axes: boolean;
}

export type SendFeedback = (feedback: InteractiveMarkerFeedback) => void;

export class InteractiveMarkerView extends Group implements ControlEvents {
  /** Group at the marker's pose; this object itself is at its frame. */
  private readonly poseGroup = new Group();
  private readonly controls: readonly ControlView[];
  private axes: Axes | null = null;
  private label: Label | null = null;
  private drag: Drag | null = null;
  private pressed: ControlView | null = null;
  private requested: Pose | null = null;
  private isMoved = false;
  private sinceFeedback = 0;

  constructor(
    readonly marker: InteractiveMarker,
    private readonly context: DisplayContext,
    parts: ViewParts,
    private readonly clientId: string,
    private readonly send: SendFeedback,
  ) {
    super();
    this.name = marker.name;
    this.controls = marker.controls.map((control) => new ControlView(control, parts, this));
    for (const control of this.controls) this.poseGroup.add(control);
    super.add(this.poseGroup);
    this.setPose(marker.pose);
    const selectable: Selectable = {
      describe: () => ({ Marker: marker.name, Description: marker.description, Frame: marker.header.frame_id }),
    };
    this.userData["selectable"] = selectable;
  }

  /** Set a pose from the server; it is deferred while a person drags the marker. */
  setPose(pose: Pose): void {
    if (this.drag !== null) {
      this.requested = pose;
      return;
    }
    const { position: p, orientation: q } = pose;
    this.poseGroup.position.set(p.x, p.y, p.z);
    this.poseGroup.quaternion.set(q.x, q.y, q.z, q.w);
    if (this.poseGroup.quaternion.lengthSq() === 0) this.poseGroup.quaternion.identity();
    this.poseGroup.quaternion.normalize();
  }

  /** Follow the frame and the camera; the reason where there is no transform. */
  update(elapsed: number): NoTransform | null {
    const { frame_id: frame, stamp } = this.marker.header;
    const transform = this.context.frames.lookup(this.context.fixedFrame.peek(), frame, nanoseconds(stamp));
    this.visible = !(transform instanceof NoTransform);
    if (transform instanceof NoTransform) return transform;
    this.follow(transform);
    this.sinceFeedback += elapsed;
    if (this.drag === null) return null;
    if (this.isMoved) this.feedback(FeedbackEvent.poseUpdate);
    else if (this.sinceFeedback > KEEP_ALIVE_S) this.feedback(FeedbackEvent.keepAlive);
    this.isMoved = false;
    return null;
  }

  show(looks: MarkerLooks): void {
    const size = this.marker.scale === 0 ? 1 : this.marker.scale;
    if (looks.axes !== (this.axes !== null)) {
      this.axes?.removeFromParent();
      this.axes?.dispose();
      this.axes = looks.axes ? new Axes(size, size * 0.05) : null;
      if (this.axes !== null) this.poseGroup.add(this.axes);
    }
    const named = looks.descriptions && this.marker.description !== "";
    if (named === (this.label !== null)) return;
    this.label?.remove();
    this.label = named ? this.context.scene.addLabel(this.poseGroup, this.marker.description) : null;
  }

  get isDragged(): boolean {
    return this.drag !== null;
  }

  /** Position of the handles in the fixed frame. */
  handlePosition(result: Vector3): Vector3 {
    return this.poseGroup.getWorldPosition(result);
  }

  /** Show the handles larger or smaller than the marker says. */
  resize(factor: number): void {
    this.poseGroup.scale.setScalar(factor);
  }

  /** Color a control's shapes; null: their own colors. */
  tint(control: string, color: Rgb | null): void {
    const [red, green, blue] = color ?? [0, 0, 0];
    for (const view of this.controls)
      if (view.control.name === control) view.tint(red / 255, green / 255, blue / 255, color === null ? 0 : 1);
  }

  override dispose(): void {
    this.show({ descriptions: false, axes: false });
    for (const control of this.controls) control.dispose();
  }

  press(control: ControlView, event: TargetEvent): boolean {
    const mode = control.control.interaction_mode;
    if (event.button === 2 || mode === InteractionMode.menu) return this.openMenu(control, event);
    if (event.button !== 0 || event.pick === null) return false;
    this.pressed = control;
    this.feedback(FeedbackEvent.mouseDown, event.pick.point);
    if (!control.isMovable) return true;
    const axis = control.axis(this.poseGroup.quaternion, this.quaternion, this.cameraTurn(), new Vector3()).normalize();
    const [position, orientation] = [
      this.poseGroup.getWorldPosition(new Vector3()),
      this.poseGroup.getWorldQuaternion(new Quaternion()),
    ];
    this.drag = new Drag(mode, axis, event.pick.point.clone(), position, orientation, event);
    return true;
  }

  pull(_control: ControlView, event: TargetEvent): void {
    if (this.drag === null) return;
    const turn = this.cameraTurn();
    const along = (x: number, y: number, z: number): Vector3 => new Vector3(x, y, z).applyQuaternion(turn);
    this.drag.move(event, { right: along(1, 0, 0), up: along(0, 1, 0), back: along(0, 0, 1) });
    const back = this.quaternion.clone().invert();
    this.poseGroup.position.copy(this.drag.position).sub(this.position).applyQuaternion(back);
    this.poseGroup.quaternion.copy(back).multiply(this.drag.orientation);
    this.isMoved = true;
    this.context.scene.invalidate();
  }

  release(control: ControlView, event: TargetEvent, isCancelled: boolean): void {
    const wasMoved = this.isMoved;
    this.drag = null;
    this.isMoved = false;
    if (wasMoved) this.feedback(FeedbackEvent.poseUpdate);
    const point = event.pick?.point;
    if (control.control.interaction_mode === InteractionMode.button && !isCancelled && point !== undefined) {
      this.feedback(FeedbackEvent.buttonClick, point);
    }
    if (this.pressed !== null) this.feedback(FeedbackEvent.mouseUp, point);
    this.pressed = null;
    if (this.requested !== null) this.setPose(this.requested);
    this.requested = null;
  }

  private openMenu(control: ControlView, event: TargetEvent): boolean {
    if (this.marker.menu_entries.length === 0) return false;
    const { left, top } = this.context.scene.element.getBoundingClientRect();
    const point = event.pick?.point;
    openMenu(this.marker.menu_entries, left + event.x, top + event.y, (entry) => {
      this.pressed = control;
      this.feedback(FeedbackEvent.menuSelect, point, entry.id);
      this.pressed = null;
    });
    return true;
  }

  private follow({ position, orientation }: Transform): void {
    if (!this.position.equals(position) || !this.quaternion.equals(orientation)) this.context.scene.invalidate();
    this.position.copy(position);
    this.quaternion.copy(orientation);
    for (const control of this.controls) control.orient(this.poseGroup.quaternion, this.quaternion, this.cameraTurn());
  }

  private cameraTurn(): Quaternion {
    return this.context.scene.camera.peek().quaternion;
  }

  /** Send feedback: in the marker's own frame if its stamp is 0, otherwise in the fixed frame at the current time. */
  private feedback(event: number, point?: Vector3, entry = 0): void {
    this.sinceFeedback = 0;
    const { header } = this.marker;
    const isLocked = nanoseconds(header.stamp) === 0n;
    const now = this.context.connection.now();
    const position = isLocked ? this.poseGroup.position : this.poseGroup.getWorldPosition(new Vector3());
    const orientation = isLocked ? this.poseGroup.quaternion : this.poseGroup.getWorldQuaternion(new Quaternion());
    const mouse = point === undefined ? new Vector3() : isLocked ? this.worldToLocal(point.clone()) : point;
    const stamp = { sec: Number(now / 1_000_000_000n), nsec: Number(now % 1_000_000_000n) };
    this.send({
      header: isLocked ? header : { seq: 0, stamp, frame_id: this.context.fixedFrame.peek() },
      client_id: this.clientId,
      marker_name: this.marker.name,
      control_name: this.pressed?.control.name ?? "",
      event_type: event,
      pose: { position: xyz(position), orientation: { ...xyz(orientation), w: orientation.w } },
      menu_entry_id: entry,
      mouse_point: xyz(mouse),
      mouse_point_valid: point !== undefined,
    });
  }
}

function xyz({ x, y, z }: { readonly x: number; readonly y: number; readonly z: number }): {
  x: number;
  y: number;
  z: number;
} {
  return { x, y, z };
}
