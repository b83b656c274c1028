/** Transparent preview of the inserted item, which follows the pointer, with its bounds. */

import {
  Box3,
  Box3Helper,
  BoxGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  type BufferGeometry,
  type Color,
  type MeshStandardMaterial,
  type Object3D,
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

import { pictureUrl } from "../protocol/picture_urls";
import { NOT_PICKED } from "../scene/picking";
import type { Insertable } from "../page/insertable";

const OPACITY = 0.6;
const GREY = 0xb3b3b3;
const BULB = 0xffe08a;
/** Heights at which the server puts lights above a point [m]. */
const HEIGHTS = { point: 2, spot: 2, directional: 5 } as const;

export class InsertionGhost extends Group {
  private isDisposed = false;

  /** `onChange` is called when more of the preview is loaded. */
  constructor(
    item: Insertable,
    private readonly color: Color,
    private readonly onChange: () => void,
  ) {
    super();
    this.userData[NOT_PICKED] = true;
    if (item.kind === "model") void this.load(item.name);
    else this.show(item.kind === "shape" ? shapeOf(item.name) : lightOf(HEIGHTS[item.name]));
  }

  override dispose(): void {
    this.isDisposed = true;
    this.removeFromParent();
    this.traverse((object) => {
      const { geometry, material } = object as Partial<Mesh>;
      geometry?.dispose();
      for (const part of [material ?? []].flat()) part.dispose();
    });
  }

  /** Add an object whose origin is the point below the pointer. */
  private show(object: Object3D): void {
    object.traverse((part) => {
      part.userData[NOT_PICKED] = true;
      if (part instanceof Mesh) part.material = seeThrough((part as Mesh).material as MeshStandardMaterial);
    });
    const bounds = new Box3Helper(new Box3().setFromObject(object), this.color);
    bounds.userData[NOT_PICKED] = true;
    this.add(object, bounds);
    this.onChange();
  }

  /** Load a model's preview; a box of 1 m if the server cannot send one. */
  private async load(model: string): Promise<void> {
    const group = new Group();
    try {
      const response = await fetch(pictureUrl("model.glb", { model }));
      if (!response.ok) throw new Error(response.statusText);
      const { scene } = await new GLTFLoader().parseAsync(await response.arrayBuffer(), "");
      for (const turned of [...scene.children]) {
        turned.quaternion.identity(); // the root turns z up into y up
        group.add(turned);
      }
    } catch {
      group.add(shapeOf("box"));
    }
    if (!this.isDisposed) this.show(group);
  }
}

function seeThrough({ color, map }: MeshStandardMaterial): MeshBasicMaterial {
  return new MeshBasicMaterial({ color, map, transparent: true, opacity: OPACITY, depthWrite: false });
}

/** A shape as the server makes it: a metre high, on the ground. */
function shapeOf(name: "box" | "sphere" | "cylinder"): Mesh {
  const shapes: Readonly<Record<typeof name, () => BufferGeometry>> = {
    box: () => new BoxGeometry(1, 1, 1),
    sphere: () => new SphereGeometry(0.5, 24, 16),
    cylinder: () => new CylinderGeometry(0.5, 0.5, 1, 24).rotateX(Math.PI / 2),
  };
  const mesh = new Mesh(shapes[name](), new MeshBasicMaterial({ color: GREY }));
  mesh.position.z = 0.5;
  return mesh;
}

/** Preview of a light: a bulb above the point, on a line. */
function lightOf(height: number): Group {
  const bulb = new Mesh(new SphereGeometry(0.15, 16, 12), new MeshBasicMaterial({ color: BULB }));
  bulb.position.z = height;
  const thread = new Mesh(
    new CylinderGeometry(0.01, 0.01, height, 6).rotateX(Math.PI / 2),
    new MeshBasicMaterial({ color: BULB }),
  );
  thread.position.z = height / 2;
  return new Group().add(bulb, thread);
}
