/** The recording that the world is compared with, as a translucent copy of its models. */

import {
  Box3,
  Color,
  Group,
  Mesh,
  NormalBlending,
  OctahedronGeometry,
  ShaderMaterial,
  type Object3D,
  type Quaternion,
  type Vector3,
} from "three";

import type { ReferenceInfo } from "../../protocol/generated/page_messages";
import { NOT_PICKED } from "../picking";
import type { ThreeScene } from "../three_scene";
import type { Label } from "../scene_view";
import type { ReferenceMotion } from "./reference_motion";

const TOKEN = "--reference";
/** Shapes of a recorded link or frame. */
export type ShapesOf = (link: string) => readonly Object3D[];

/** What stands for a frame where no robot's shapes are known; its radius is 4 cm. */
const MARK = new OctahedronGeometry(0.04);
/** Models with more than this share one name. */
const MAX_LABELS = 8;

const VERTEX = /* glsl */ `
varying vec3 toEye;
void main() {
  vec4 at = modelViewMatrix * vec4(position, 1.0);
  toEye = -at.xyz;
  gl_Position = projectionMatrix * at;
}`;

/** Fragment shader: denser where the surface turns away, so that the shape is seen. */
const FRAGMENT = /* glsl */ `
varying vec3 toEye;
uniform vec3 color;
void main() {
  vec3 normal = normalize(cross(dFdx(toEye), dFdy(toEye)));
  float facing = abs(dot(normal, isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(toEye)));
  gl_FragColor = vec4(color, mix(0.75, 0.35, facing));
}`;

export class ReferenceGhost {
  private readonly root = new Group();
  private readonly material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { color: { value: new Color() } },
    blending: NormalBlending,
    transparent: true,
    depthWrite: false,
    // behind the world's own surfaces at the same place
    polygonOffset: true,
    polygonOffsetFactor: 2,
    polygonOffsetUnits: 33,
  });
  private readonly style: CSSStyleDeclaration;
  /** Copies by the recording's index of their link. */
  private copies: readonly Group[] = [];
  private labels: readonly Label[] = [];

  constructor(private readonly scene: ThreeScene) {
    this.root.userData[NOT_PICKED] = true;
    this.style = getComputedStyle(scene.element);
  }

  /** Copy the shapes of the recorded links, or mark the frames of a bag if none of them has a shape. */
  build({ links, root }: ReferenceInfo, shapesOf: ShapesOf): void {
    this.clear();
    (root === "" ? this.scene.world : this.scene.displays).add(this.root);
    const isMarked = root !== "" && links.every((link) => shapesOf(link).length === 0);
    this.copies = links.map((link) => {
      const copy = new Group();
      copy.name = link;
      for (const shape of shapesOf(link)) copy.add(this.copyOf(shape));
      if (isMarked) copy.add(new Mesh(MARK, this.material));
      this.root.add(copy);
      return copy;
    });
    const models = root === "" ? [...new Set(links.map(modelName))] : links.slice(0, 1).map(modelName);
    const firsts = models.slice(0, MAX_LABELS).map((model) => links.findIndex((link) => modelName(link) === model));
    this.labels = firsts.flatMap((first, index) => {
      const anchor = this.copies[first];
      if (anchor === undefined) return [];
      const text = models.length === 1 ? "reference" : `reference of ${models[index] ?? ""}`;
      return [this.scene.addLabel(anchor, text, TOKEN)];
    });
  }

  /** Show the poses at a time since the recording's start [s]. */
  show(motion: ReferenceMotion, time: number): void {
    this.copies.forEach((copy, link) => motion.pose(link, time, copy.position, copy.quaternion));
  }

  /** Place the root of all poses; true: it has moved. */
  place(position: Vector3, orientation: Quaternion): boolean {
    const { root } = this;
    if (root.position.equals(position) && root.quaternion.equals(orientation)) return false;
    root.position.copy(position);
    root.quaternion.copy(orientation);
    return true;
  }

  /** Extent in the fixed frame of the shown copies of some links. */
  bounds(isOf: (link: string) => boolean): Box3 {
    const box = new Box3();
    for (const copy of this.copies) {
      if (!copy.visible || !isOf(copy.name)) continue;
      copy.updateWorldMatrix(true, false);
      box.union(new Box3().setFromObject(copy));
    }
    return box;
  }

  /** Show the models that are not hidden. */
  hide(isHidden: (link: string) => boolean): void {
    for (const copy of this.copies) copy.visible = !isHidden(copy.name);
  }

  /** Read the color's token, which the theme changes. */
  setColor(): void {
    const shown = this.style.getPropertyValue(TOKEN).trim() || "#ff8fb3";
    (this.material.uniforms["color"]?.value as Color).set(shown).convertLinearToSRGB();
  }

  clear(): void {
    for (const label of this.labels) label.remove();
    this.labels = [];
    this.copies = [];
    this.root.clear();
    this.root.position.set(0, 0, 0);
    this.root.quaternion.identity();
  }

  dispose(): void {
    this.clear();
    this.material.dispose();
    this.root.removeFromParent();
  }

  /** A copy that shares geometries; without lights, and without what marks a body or a caster of shadows. */
  private copyOf(object: Object3D): Object3D {
    const copy = object instanceof Mesh ? new Mesh((object as Mesh).geometry, this.material) : new Group();
    copy.matrixAutoUpdate = false;
    object.updateMatrix();
    copy.matrix.copy(object.matrix);
    for (const child of object.children) copy.add(this.copyOf(child));
    return copy;
  }
}

function modelName(link: string): string {
  return link.split("::")[0] ?? link;
}
