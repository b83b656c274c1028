/** Control of an interactive marker: its shapes, their orientation, and their pointer events. */

import { Group, Matrix4, Mesh, Quaternion, Vector3 } from "three";

import type { InteractiveMarkerControl, Marker } from "../../protocol/generated/ros_messages";
import type { PointerTarget, TargetEvent } from "../../scene/scene_view";
import { poseMatrix } from "../markers/marker_scene";
import { makeView, type MarkerView, type ViewParts } from "../markers/marker_views";
import { ShapeMaterial } from "../../shapes/shape_material";
import { InteractionMode, OrientationMode } from "./control_modes";

/** Brightening of the hovered control, and of the dragged one, as in rviz. */
const HOVER_GLOW = 0.3;
const DRAG_GLOW = 0.5;

/** Events of a control, for its marker. */
export interface ControlEvents {
  /** True: the control handles the drag. */
  press(control: ControlView, event: TargetEvent): boolean;
  pull(control: ControlView, event: TargetEvent): void;
  release(control: ControlView, event: TargetEvent, isCancelled: boolean): void;
}

const matrix = new Matrix4();
const scale = new Vector3();
const parentTurn = new Quaternion();

export class ControlView extends Group {
  private readonly views: readonly MarkerView[];
  private readonly orientation = new Quaternion();
  private isOver = false;
  private isPressed = false;

  constructor(
    readonly control: InteractiveMarkerControl,
    parts: ViewParts,
    private readonly events: ControlEvents,
  ) {
    super();
    const { x, y, z, w } = control.orientation;
    this.orientation.set(x, y, z, w);
    if (this.orientation.lengthSq() === 0) this.orientation.identity();
    this.orientation.normalize();
    this.views = control.markers.map((shape) => this.addShape(shape, parts));
    if (control.interaction_mode !== InteractionMode.none) this.userData["pointerTarget"] = this.target();
  }

  get isMovable(): boolean {
    return this.control.interaction_mode >= InteractionMode.moveAxis;
  }

  /** Orient by the control's mode; `reference`: marker's frame in the fixed frame, `camera`: camera's rotation. */
  orient(marker: Quaternion, reference: Quaternion, camera: Quaternion): void {
    const mode = this.control.orientation_mode;
    if (mode === OrientationMode.inherit) return;
    parentTurn.copy(reference).multiply(marker).invert();
    if (mode === OrientationMode.fixed) this.quaternion.copy(parentTurn).multiply(reference);
    else if (!this.control.independent_marker_orientation)
      this.quaternion.copy(parentTurn).multiply(camera).multiply(FACING);
  }

  /** The control's x axis in the fixed frame. */
  axis(marker: Quaternion, reference: Quaternion, camera: Quaternion, result: Vector3): Vector3 {
    result.set(1, 0, 0);
    if (this.control.orientation_mode === OrientationMode.viewFacing)
      return result.set(0, 0, 1).applyQuaternion(camera);
    result.applyQuaternion(this.orientation);
    if (this.control.orientation_mode === OrientationMode.inherit) result.applyQuaternion(marker);
    return result.applyQuaternion(reference);
  }

  /** Blend a color over those of the shapes, components and weight 0…1. */
  tint(red: number, green: number, blue: number, share: number): void {
    this.traverse((part) => {
      if (part instanceof Mesh && part.material instanceof ShapeMaterial)
        part.material.setTint(red, green, blue, share);
    });
  }

  override dispose(): void {
    for (const view of this.views) view.dispose();
  }

  private addShape(shape: Marker, parts: ViewParts): MarkerView {
    const view = makeView(shape, parts);
    poseMatrix(shape.pose, matrix).decompose(view.object.position, view.object.quaternion, scale);
    super.add(view.object);
    return view;
  }

  private target(): PointerTarget {
    return {
      hover: (isOver) => {
        this.isOver = isOver;
        this.glow();
      },
      down: (event) => {
        this.isPressed = this.events.press(this, event);
        this.glow();
        return this.isPressed;
      },
      move: (event) => this.events.pull(this, event),
      up: (event, isCancelled) => {
        this.isPressed = false;
        this.glow();
        this.events.release(this, event, isCancelled);
      },
    };
  }

  private glow(): void {
    const glow = this.isPressed ? DRAG_GLOW : this.isOver ? HOVER_GLOW : 0;
    this.traverse((part) => {
      if (part instanceof Mesh && part.material instanceof ShapeMaterial) part.material.setGlow(glow);
    });
  }
}

/** Turns a control's x axis towards the viewer, its z axis up. */
const FACING = new Quaternion().setFromRotationMatrix(
  new Matrix4().makeBasis(new Vector3(0, 0, 1), new Vector3(1, 0, 0), new Vector3(0, 1, 0)),
);
