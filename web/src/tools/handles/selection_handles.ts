/** Handles of the selection: of constant size on the screen, in front of everything. */

import {
  Group,
  OrthographicCamera,
  PerspectiveCamera,
  Quaternion,
  Raycaster,
  Vector3,
  type Camera,
  type Ray,
} from "three";

import type { Transform } from "../../frames/transform";
import { NOT_PICKED } from "../../scene/picking";
import { HandleShape, type HandleKind } from "./handle_shapes";

/** Length of an arrow [px]. */
const LENGTH = 110;
const Z = new Vector3(0, 0, 1);
const COLORS = ["--x", "--y", "--z"] as const;

/** A handle: an axis or a plane's normal in the handles' frame; the color is that of its letter, if it has one. */
export interface Handle {
  readonly kind: HandleKind;
  readonly axis: Vector3;
  readonly letter?: 0 | 1 | 2;
}

export class SelectionHandles extends Group {
  private shapes: { readonly handle: Handle; readonly shape: HandleShape }[] = [];
  private readonly raycaster = new Raycaster();
  private lit: Handle | null = null;
  private theme: string | undefined;

  constructor() {
    super();
    this.userData[NOT_PICKED] = true;
    this.visible = false;
  }

  /** Replace the handles. */
  show(handles: readonly Handle[]): void {
    this.clear();
    this.lit = null;
    this.shapes = handles.map((handle) => {
      const shape = new HandleShape(handle.kind);
      if (handle.kind === "plane") shape.quaternion.copy(turnOfPlane(handle.axis));
      else shape.quaternion.setFromUnitVectors(Z, handle.axis);
      this.add(shape);
      return { handle, shape };
    });
    this.paint();
  }

  /** Place them at a pose, for a picture of this height [px]. */
  place({ position, orientation }: Transform, camera: Camera, height: number): void {
    if (this.theme !== document.documentElement.dataset["theme"]) this.paint();
    this.position.copy(position);
    this.quaternion.copy(orientation);
    this.updateWorldMatrix(true, false);
    this.scale.setScalar(LENGTH * metresPerPx(camera, this.getWorldPosition(new Vector3()), height));
    this.updateMatrixWorld();
  }

  /** Handle that a ray in the fixed frame meets, and the point. */
  hit(ray: Ray): { readonly handle: Handle; readonly point: Vector3 } | null {
    if (!this.visible) return null;
    this.raycaster.ray.copy(ray);
    const order = { free: 0, axis: 1, ring: 2, plane: 3 };
    const hits = this.shapes.flatMap(({ handle, shape }) =>
      this.raycaster.intersectObject(shape).map(({ point, distance }) => ({ handle, point, distance })),
    );
    hits.sort((a, b) => order[a.handle.kind] - order[b.handle.kind] || a.distance - b.distance);
    return hits[0] ?? null;
  }

  /** Highlight one; true: the highlight changed. */
  light(handle: Handle | null): boolean {
    if (handle === this.lit) return false;
    this.lit = handle;
    this.paint();
    return true;
  }

  private paint(): void {
    this.theme = document.documentElement.dataset["theme"];
    const style = getComputedStyle(document.documentElement);
    const token = (name: string): string => style.getPropertyValue(name).trim() || "#ffffff";
    for (const { handle, shape } of this.shapes) {
      const base =
        handle.letter === undefined
          ? handle.kind === "free"
            ? "#ffffff"
            : token("--accent")
          : token(COLORS[handle.letter]);
      const isLit = handle === this.lit;
      shape.paint(
        isLit ? token("--focus") : base,
        handle.kind === "plane" ? (isLit ? 0.7 : 0.35) : isLit || this.lit === null ? 1 : 0.55,
      );
    }
  }
}

/** Rotation after which x and y lie in the plane of a normal, towards the positive sides of the other axes. */
function turnOfPlane(normal: Vector3): Quaternion {
  const third = (2 * Math.PI) / 3;
  const diagonal = new Vector3(1, 1, 1).normalize();
  return new Quaternion().setFromAxisAngle(diagonal, normal.z > 0.5 ? 0 : normal.x > 0.5 ? third : -third);
}

function metresPerPx(camera: Camera, point: Vector3, height: number): number {
  if (camera instanceof OrthographicCamera) return (camera.top - camera.bottom) / camera.zoom / height;
  if (!(camera instanceof PerspectiveCamera)) return 1;
  const depth = Math.max(1e-3, -point.applyMatrix4(camera.matrixWorldInverse).z);
  return (2 * depth * Math.tan((camera.fov * Math.PI) / 360)) / height;
}
