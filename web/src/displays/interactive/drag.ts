/** Motion of a marker by a pointer's ray: pure geometry, in the fixed frame. */

import { Plane, Quaternion, Vector3, type Ray } from "three";

import { InteractionMode } from "./control_modes";

/** Turn per pixel of rviz's free rotation [rad]. */
const TURN_PER_PX = (2 * Math.PI) / 300;

export interface DragInput {
  readonly ray: Ray;
  /** Position [px]. */
  readonly x: number;
  readonly y: number;
  readonly shift: boolean;
  readonly control: boolean;
}

/** Axes of the camera. */
export interface ViewAxes {
  readonly right: Vector3;
  readonly up: Vector3;
  /** Towards the viewer. */
  readonly back: Vector3;
}

/** Drag of one control, from its grasped point along the pointer's rays. */
export class Drag {
  private readonly startPosition: Vector3;
  private readonly startOrientation: Quaternion;
  private lastX: number;
  private lastY: number;

  constructor(
    private readonly mode: number,
    /** The control's x axis. */
    private readonly axis: Vector3,
    private readonly grasp: Vector3,
    readonly position: Vector3,
    readonly orientation: Quaternion,
    input: DragInput,
  ) {
    this.startPosition = position.clone();
    this.startOrientation = orientation.clone();
    this.lastX = input.x;
    this.lastY = input.y;
  }

  /** Follow the pointer; afterwards `position` and `orientation` are the marker's new pose. */
  move(input: DragInput, view: ViewAxes): void {
    const [dx, dy] = [input.x - this.lastX, input.y - this.lastY];
    this.lastX = input.x;
    this.lastY = input.y;
    switch (this.mode) {
      case InteractionMode.moveAxis:
        this.moveAxis(input.ray);
        return;
      case InteractionMode.movePlane:
        this.movePlane(input.ray, this.axis);
        return;
      case InteractionMode.rotateAxis:
        this.rotateAxis(input.ray);
        return;
      case InteractionMode.moveRotate:
        this.moveRotate(input.ray);
        return;
      case InteractionMode.rotate3D:
        this.rotate(dx, dy, view, input.shift);
        return;
      case InteractionMode.moveRotate3D:
        if (input.control) this.rotate(dx, dy, view, false);
        else this.move3D(input, dy, view);
        return;
      case InteractionMode.move3D:
        this.move3D(input, dy, view);
    }
  }

  private moveAxis(ray: Ray): void {
    const along = closestOnLine(this.grasp, this.axis, ray);
    if (along !== null) this.position.copy(this.startPosition).addScaledVector(this.axis, along);
  }

  private movePlane(ray: Ray, normal: Vector3): void {
    const hit = planeHit(ray, normal, this.grasp);
    if (hit !== null) this.position.copy(this.startPosition).add(hit).sub(this.grasp);
  }

  private rotateAxis(ray: Ray): void {
    const hit = planeHit(ray, this.axis, this.grasp);
    if (hit === null) return;
    const angle = angleAbout(this.axis, this.grasp.clone().sub(this.startPosition), hit.sub(this.startPosition));
    this.orientation.setFromAxisAngle(this.axis, angle).multiply(this.startOrientation);
  }

  /** Move the grasped point to the pointer; the marker turns with it and is pulled along. */
  private moveRotate(ray: Ray): void {
    const hit = planeHit(ray, this.axis, this.grasp);
    if (hit === null) return;
    const arm = this.grasp.clone().sub(this.position);
    const turn = new Quaternion().setFromAxisAngle(
      this.axis,
      angleAbout(this.axis, arm, hit.clone().sub(this.position)),
    );
    this.orientation.premultiply(turn);
    this.position.copy(hit).sub(arm.applyQuaternion(turn));
    this.grasp.copy(hit);
  }

  /** Move in the plane of the picture; with Shift along the view direction. */
  private move3D(input: DragInput, dy: number, { back }: ViewAxes): void {
    if (input.shift) {
      const distance = input.ray.origin.distanceTo(this.grasp);
      const step = input.ray.direction.clone().multiplyScalar((-dy * distance) / 500);
      this.position.add(step);
      this.startPosition.copy(this.position);
      this.grasp.add(step);
      return;
    }
    this.movePlane(input.ray, back);
  }

  private rotate(dx: number, dy: number, { right, up, back }: ViewAxes, roll: boolean): void {
    if (roll) this.orientation.premultiply(new Quaternion().setFromAxisAngle(back, -dx * TURN_PER_PX));
    else {
      this.orientation.premultiply(new Quaternion().setFromAxisAngle(up, dx * TURN_PER_PX));
      this.orientation.premultiply(new Quaternion().setFromAxisAngle(right, dy * TURN_PER_PX));
    }
  }
}

/** Distance along the line to its point nearest to the ray; null: they are parallel. */
export function closestOnLine(origin: Vector3, direction: Vector3, ray: Ray): number | null {
  const between = origin.clone().sub(ray.origin);
  const cosine = direction.dot(ray.direction);
  const parallel = 1 - cosine * cosine;
  if (parallel < 1e-6) return null;
  return (cosine * ray.direction.dot(between) - direction.dot(between)) / parallel;
}

function planeHit(ray: Ray, normal: Vector3, point: Vector3): Vector3 | null {
  return ray.intersectPlane(new Plane().setFromNormalAndCoplanarPoint(normal, point), new Vector3());
}

/** Angle from one vector to another about an axis [rad]. */
function angleAbout(axis: Vector3, from: Vector3, to: Vector3): number {
  const [a, b] = [from.projectOnPlane(axis), to.projectOnPlane(axis)];
  return Math.atan2(axis.dot(new Vector3().crossVectors(a, b)), a.dot(b));
}
