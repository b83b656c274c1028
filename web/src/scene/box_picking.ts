/** Picking within a box of the picture. */

import { Box3, Matrix4, Vector3, type Camera, type InstancedMesh, type Mesh, type Object3D, type Points } from "three";

import { NOT_PICKED, toPicture, type PictureSize } from "./picking";
import type { Pick, PictureBox, Selectable } from "./scene_view";

/** Entry of `userData` that makes an object selectable. */
export const SELECTABLE = "selectable";

/** Objects, instances and points whose middle lies within the box, at most `limit`. */
export function pickBox(
  roots: readonly Object3D[],
  camera: Camera,
  size: PictureSize,
  box: PictureBox,
  limit: number,
): Pick[] {
  const picked: Pick[] = [];
  const projected = new Vector3();
  camera.updateMatrixWorld();
  const contains = (point: Vector3): boolean => {
    const at = toPicture(projected.copy(point), camera, size);
    return at !== null && at.x >= box.left && at.x <= box.right && at.y >= box.top && at.y <= box.bottom;
  };
  for (const root of roots) {
    root.updateMatrixWorld();
    visit(root, contains, picked, limit);
  }
  return picked;
}

function visit(object: Object3D, contains: (point: Vector3) => boolean, picked: Pick[], limit: number): void {
  if (!object.visible || object.userData[NOT_PICKED] === true) return;
  for (const { point, index } of partsOf(object, contains)) {
    if (picked.length >= limit) return;
    picked.push({ point, object, index });
  }
  for (const child of object.children) visit(child, contains, picked, limit);
}

interface Part {
  readonly point: Vector3;
  readonly index: number | null;
}

function partsOf(object: Object3D, contains: (point: Vector3) => boolean): Part[] {
  const selectable = object.userData[SELECTABLE] as Selectable | undefined;
  if (selectable?.indicesIn !== undefined) {
    return selectable.indicesIn(contains).map((index) => ({ point: object.getWorldPosition(new Vector3()), index }));
  }
  if (isPoints(object)) return pointsOf(object, contains);
  if (isInstanced(object)) return instancesOf(object, contains);
  if (!isMesh(object) || !object.geometry.hasAttribute("position")) return [];
  if (object.geometry.boundingBox === null) object.geometry.computeBoundingBox();
  const point = (object.geometry.boundingBox ?? new Box3()).getCenter(new Vector3()).applyMatrix4(object.matrixWorld);
  return contains(point) ? [{ point, index: null }] : [];
}

function pointsOf(points: Points, contains: (point: Vector3) => boolean): Part[] {
  const position = points.geometry.getAttribute("position");
  const { start, count } = points.geometry.drawRange;
  const parts: Part[] = [];
  const point = new Vector3();
  for (let index = start; index < Math.min(position.count, start + count); index += 1) {
    point.fromBufferAttribute(position, index).applyMatrix4(points.matrixWorld);
    if (contains(point)) parts.push({ point: point.clone(), index });
  }
  return parts;
}

function instancesOf(mesh: InstancedMesh, contains: (point: Vector3) => boolean): Part[] {
  const parts: Part[] = [];
  const matrix = new Matrix4();
  for (let index = 0; index < mesh.count; index += 1) {
    mesh.getMatrixAt(index, matrix);
    const point = new Vector3().setFromMatrixPosition(matrix).applyMatrix4(mesh.matrixWorld);
    if (contains(point)) parts.push({ point, index });
  }
  return parts;
}

function isMesh(object: Object3D): object is Mesh {
  return (object as Partial<Mesh>).isMesh === true;
}

function isInstanced(object: Object3D): object is InstancedMesh {
  return (object as Partial<InstancedMesh>).isInstancedMesh === true;
}

function isPoints(object: Object3D): object is Points {
  return (object as Partial<Points>).isPoints === true;
}
