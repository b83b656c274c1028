/** Shapes of the drawings at bodies: drawn in front of bodies, not picked. */

import {
  BufferGeometry,
  Float32BufferAttribute,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  SRGBColorSpace,
  Vector3,
  DoubleSide,
  Group,
  type Object3D,
} from "three";

import type { AxisColors } from "../../shapes/axes";
import { HEAD, SHAFT } from "../../shapes/solids";

const X = new Vector3(1, 0, 0);
/** Drawn after the world and its transparent parts: areas first, then lines and solids. */
const [AREAS, SOLIDS] = [20, 21];

/** Colors, the same in both themes as the world's own background lies behind them. */
export const COLORS = {
  axis: 0xf2b134,
  limit: 0x3fbed0,
  inertia: 0xc06bff,
  frustum: 0x6fd3ff,
  force: 0x56cc40,
  contact: 0x4f9dff,
} as const;

const materials = new Map<string, MeshBasicMaterial | LineBasicMaterial>();

/** Flat material drawn in front of bodies; shared, so not to be disposed of. */
export function flat(color: number, opacity = 1): MeshBasicMaterial {
  return shared(`${color} ${opacity}`, () => flatMaterial(color, opacity));
}

function flatMaterial(color: number, opacity: number): MeshBasicMaterial {
  const inFront = { depthTest: false, depthWrite: false } as const;
  return new MeshBasicMaterial({ color, opacity, transparent: true, side: DoubleSide, ...inFront });
}

function shared<M extends MeshBasicMaterial | LineBasicMaterial>(key: string, make: () => M): M {
  const known = materials.get(key) as M | undefined;
  if (known !== undefined) return known;
  const material = make();
  materials.set(key, material);
  return material;
}

/** Lines from each even point to the next. */
export function lines(points: readonly number[], color: number, opacity = 1): LineSegments {
  const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(points, 3));
  const material = shared(
    `line ${color} ${opacity}`,
    () => new LineBasicMaterial({ color: color, opacity, transparent: true, depthTest: false, depthWrite: false }),
  );
  return inFront(new LineSegments(geometry, material));
}

/** An arrow of a length from the origin in a direction. */
export function arrow(direction: Vector3, length: number, color: number): Group {
  return arrowOf(direction, length, flat(color));
}

function arrowOf(direction: Vector3, length: number, material: MeshBasicMaterial): Group {
  const group = new Group();
  const [shaft, head] = [new Mesh(SHAFT, material), new Mesh(HEAD, material)];
  shaft.scale.set(0.78 * length, 0.04 * length, 0.04 * length);
  head.position.x = 0.78 * length;
  head.scale.set(0.22 * length, 0.12 * length, 0.12 * length);
  group.quaternion.setFromUnitVectors(X, direction);
  group.add(inFront(shaft), inFront(head));
  return group;
}

const AXES = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)] as const;
const axisMaterials = AXES.map(() => flatMaterial(0xffffff, 1));

/** Axes of a frame. */
export function triad(length: number): Group {
  return new Group().add(...AXES.map((axis, i) => arrowOf(axis, length, axisMaterials[i] ?? flat(0xffffff))));
}

/** Set the colors of all axes of frames, also of those that are drawn. */
export function setAxisColors(colors: AxisColors): void {
  axisMaterials.forEach((material, i) => {
    const [red, green, blue] = colors[i] ?? [255, 255, 255];
    material.color.setRGB(red / 255, green / 255, blue / 255, SRGBColorSpace);
  });
}

export function inFront<O extends Object3D>(object: O): O {
  object.renderOrder = SOLIDS;
  return object;
}

/** Transparent area. */
export function area(geometry: BufferGeometry, color: number, opacity: number): Mesh {
  const mesh = new Mesh(geometry, flat(color, opacity));
  mesh.renderOrder = AREAS;
  return mesh;
}

/** Free the geometries that an object has for itself. */
export function disposeLines(root: Object3D): void {
  root.traverse((object) => {
    const { geometry } = object as Partial<Mesh>;
    if (object instanceof LineSegments || object.userData["ownGeometry"] === true) geometry?.dispose();
  });
}
