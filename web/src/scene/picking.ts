/** Picking under a point of the picture. */

import {
  BufferGeometry,
  Mesh,
  OrthographicCamera,
  Plane,
  Ray,
  Raycaster,
  Vector2,
  Vector3,
  type Camera,
  type Intersection,
  type Line,
  type LineSegments,
  type Object3D,
  type Points,
} from "three";
import { acceleratedRaycast, computeBoundsTree, disposeBoundsTree } from "three-mesh-bvh";

import { BodySpheres } from "./body_spheres";
import type { Pick } from "./scene_view";

BufferGeometry.prototype.computeBoundsTree = computeBoundsTree;
BufferGeometry.prototype.disposeBoundsTree = disposeBoundsTree;
Mesh.prototype.raycast = acceleratedRaycast;

/** Distance at which a point or a line counts as met [px]. */
const TOLERANCE = 6;
/** Meshes of fewer vertices are searched without a tree. */
const SMALL_MESH = 1000;
const GROUND = new Plane(new Vector3(0, 0, 1), 0);

interface Candidate extends Pick {
  /** Depth in the picture, −1…1. */
  readonly depth: number;
}

export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

/** Entry of `userData` that excludes an object and its descendants from picking. */
export const NOT_PICKED = "notPicked";

export class Picker {
  private readonly raycaster = new Raycaster();
  private readonly hits: Intersection[] = [];
  private readonly bodies = new BodySpheres();

  constructor() {
    this.raycaster.params.Line2 = { threshold: TOLERANCE };
  }

  /** Nearest object under a point [px] of the picture, at current poses: the picture may be older. */
  pick(roots: readonly Object3D[], camera: Camera, size: PictureSize, x: number, y: number): Pick | null {
    this.aim(camera, size, x, y);
    const candidates: Candidate[] = [];
    for (const root of roots) {
      root.updateMatrixWorld();
      this.visit(root, camera, size, new Vector2(x, y), candidates);
    }
    let best: Candidate | null = null;
    for (const candidate of candidates) if (best === null || candidate.depth < best.depth) best = candidate;
    return best === null ? null : { point: best.point, object: best.object, index: best.index };
  }

  /** True if a surface covers a point of the fixed frame, nearer to the camera by more than a distance [m]. */
  isCovered(roots: readonly Object3D[], camera: Camera, point: Vector3, reach: number): boolean {
    const { x, y } = point.clone().project(camera);
    this.raycaster.setFromCamera(new Vector2(x, y), camera);
    const far = this.raycaster.ray.origin.distanceTo(point) - reach;
    return roots.some((root) => this.isMet(root, far));
  }

  private isMet(object: Object3D, far: number): boolean {
    if (!object.visible || object.userData[NOT_PICKED] === true) return false;
    if (this.bodies.isMissed(object, this.raycaster.ray)) return false;
    if (isMesh(object)) {
      const candidates: Candidate[] = [];
      this.pickMesh(object, this.raycaster.camera, candidates);
      if (candidates.some(({ point }) => point.distanceTo(this.raycaster.ray.origin) < far)) return true;
    }
    return object.children.some((child) => this.isMet(child, far));
  }

  /** Point at which the ray through a point [px] meets z = 0. */
  pickGround(camera: Camera, size: PictureSize, x: number, y: number): Vector3 | null {
    this.aim(camera, size, x, y);
    return this.raycaster.ray.intersectPlane(GROUND, new Vector3());
  }

  ray(camera: Camera, size: PictureSize, x: number, y: number): Ray {
    this.aim(camera, size, x, y);
    return this.raycaster.ray.clone();
  }

  private aim(camera: Camera, size: PictureSize, x: number, y: number): void {
    camera.updateMatrixWorld();
    const metresPerPx =
      camera instanceof OrthographicCamera ? (camera.top - camera.bottom) / camera.zoom / size.height : 0;
    this.raycaster.params.Points = { threshold: TOLERANCE * metresPerPx };
    this.raycaster.setFromCamera(new Vector2((2 * x) / size.width - 1, 1 - (2 * y) / size.height), camera);
  }

  private visit(object: Object3D, camera: Camera, size: PictureSize, at: Vector2, candidates: Candidate[]): void {
    if (!object.visible || object.userData[NOT_PICKED] === true || this.bodies.isMissed(object, this.raycaster.ray))
      return;
    if (isPoints(object)) pickPoints(object, camera, size, at, candidates);
    else if (isLine(object)) pickLine(object, camera, size, at, candidates);
    else if (isMesh(object)) this.pickMesh(object, camera, candidates);
    for (const child of object.children) this.visit(child, camera, size, at, candidates);
  }

  private pickMesh(mesh: Mesh, camera: Camera, candidates: Candidate[]): void {
    const { geometry } = mesh;
    if (!geometry.hasAttribute("position")) return;
    const { count } = geometry.getAttribute("position");
    if (count >= SMALL_MESH && geometry.boundsTree === undefined && mesh.type === "Mesh") geometry.computeBoundsTree();
    const { hits } = this;
    hits.length = 0;
    mesh.raycast(this.raycaster, hits);
    for (const hit of hits) {
      const depth = hit.point.clone().project(camera).z;
      candidates.push({ point: hit.point, object: mesh, index: hit.instanceId ?? null, depth });
    }
  }
}

function isMesh(object: Object3D): object is Mesh {
  return (object as Partial<Mesh>).isMesh === true;
}

function isPoints(object: Object3D): object is Points {
  return (object as Partial<Points>).isPoints === true;
}

function isLine(object: Object3D): object is Line {
  return (object as Partial<Line>).isLine === true;
}

/** Position of a point [px] with its depth as z; null: behind the camera or beyond the far plane. */
export function toPicture(point: Vector3, camera: Camera, size: PictureSize): Vector3 | null {
  const projected = point.project(camera);
  if (projected.z < -1 || projected.z > 1) return null;
  return projected.set(((projected.x + 1) / 2) * size.width, ((1 - projected.y) / 2) * size.height, projected.z);
}

function pickPoints(points: Points, camera: Camera, size: PictureSize, at: Vector2, candidates: Candidate[]): void {
  const position = points.geometry.getAttribute("position");
  const { start, count } = points.geometry.drawRange;
  const end = Math.min(position.count, start + count);
  let index = -1;
  let depth = Infinity;
  const projected = new Vector3();
  for (let i = start; i < end; i += 1) {
    projected.fromBufferAttribute(position, i).applyMatrix4(points.matrixWorld);
    if (toPicture(projected, camera, size) === null) continue;
    if (Math.hypot(projected.x - at.x, projected.y - at.y) > TOLERANCE || projected.z >= depth) continue;
    index = i;
    depth = projected.z;
  }
  if (index < 0) return;
  const point = new Vector3().fromBufferAttribute(position, index).applyMatrix4(points.matrixWorld);
  candidates.push({ point, object: points, index, depth });
}

function pickLine(line: Line, camera: Camera, size: PictureSize, at: Vector2, candidates: Candidate[]): void {
  const position = line.geometry.getAttribute("position");
  const order = line.geometry.index;
  const count = Math.min(order?.count ?? position.count, line.geometry.drawRange.count);
  const stride = (line as Partial<LineSegments>).isLineSegments === true ? 2 : 1;
  const [from, to, a, b] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
  for (let i = 0; i + 1 < count; i += stride) {
    from.fromBufferAttribute(position, order?.getX(i) ?? i).applyMatrix4(line.matrixWorld);
    to.fromBufferAttribute(position, order?.getX(i + 1) ?? i + 1).applyMatrix4(line.matrixWorld);
    if (toPicture(a.copy(from), camera, size) === null || toPicture(b.copy(to), camera, size) === null) continue;
    const share = shareAlong(a, b, at);
    if (Math.hypot(a.x + share * (b.x - a.x) - at.x, a.y + share * (b.y - a.y) - at.y) > TOLERANCE) continue;
    const depth = a.z + share * (b.z - a.z);
    candidates.push({ point: from.clone().lerp(to, share), object: line, index: i / stride, depth });
  }
}

/** Ratio 0…1 along a segment of the picture that is nearest to a point. */
function shareAlong(a: Vector3, b: Vector3, at: Vector2): number {
  const [x, y] = [b.x - a.x, b.y - a.y];
  const squared = x * x + y * y;
  if (squared === 0) return 0;
  return Math.min(1, Math.max(0, ((at.x - a.x) * x + (at.y - a.y) * y) / squared));
}
