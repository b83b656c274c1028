/** The shapes of one link: visuals or collisions, with rviz's rules of color. */

import {
  DoubleSide,
  Euler,
  FrontSide,
  Group,
  Mesh,
  NoColorSpace,
  Quaternion,
  Texture,
  type Object3D,
  type Side,
} from "three";

import { meshLibrary } from "../meshes/mesh_library";
import type { Connection } from "../../protocol/connection";
import type { Rgb } from "../../rviz/properties";
import { ShapeMaterial } from "../../shapes/shape_material";
import { BOX, CYLINDER, SPHERE } from "../../shapes/solids";
import type { Geometry, RobotMaterial, RobotShape } from "./urdf";

/** rviz's color of a link that has none. */
const SHADED_RED = [1, 0, 0, 1] as const;

/** Called with the address of a missing mesh or texture, and the reason. */
export type OnMissing = (uri: string, reason: string) => void;

export class LinkShapes extends Group {
  private readonly materials: ShapeMaterial[] = [];
  private readonly colors = new Map<ShapeMaterial, readonly [number, number, number, number]>();
  private alpha = 1;
  /** Color in place of the materials' own, 0…255; null: none. */
  private override: Rgb | null = null;
  private isPlaced = true;
  private isDisposed = false;

  constructor(
    private readonly connection: Connection,
    shapes: readonly RobotShape[],
    otherwise: RobotMaterial | null,
    private readonly onMissing: OnMissing,
    private readonly onChange: () => void,
  ) {
    super();
    for (const shape of shapes) this.addShape(shape, shape.material ?? otherwise);
  }

  /** Alpha of robot and link, 0…1; it multiplies each material's own. */
  setAlpha(alpha: number): void {
    this.alpha = alpha;
    for (const material of this.materials) this.paint(material);
  }

  /** Color all shapes, as rviz colors the links of a planned state; null: their own colors. */
  setColor(color: Rgb | null): void {
    if (color?.join() === this.override?.join()) return;
    this.override = color;
    for (const material of this.materials) this.paint(material);
  }

  /** Show the link in white without a transform, as rviz does; true: changed. */
  setPlaced(isPlaced: boolean): boolean {
    if (isPlaced === this.isPlaced) return false;
    this.isPlaced = isPlaced;
    for (const material of this.materials) this.paint(material);
    return true;
  }

  override dispose(): void {
    this.isDisposed = true;
    for (const material of this.materials) material.dispose();
    this.materials.length = 0;
  }

  private paint(material: ShapeMaterial): void {
    const [r, g, b] = this.override ?? [0, 0, 0];
    material.setTint(r / 255, g / 255, b / 255, this.override === null ? 0 : 1);
    const [red, green, blue, alpha] = this.isPlaced
      ? (this.colors.get(material) ?? SHADED_RED)
      : ([1, 1, 1, 1] as const);
    material.setRgba(red, green, blue, alpha * this.alpha);
  }

  private keep(material: ShapeMaterial, rgba: readonly [number, number, number, number]): ShapeMaterial {
    this.materials.push(material);
    this.colors.set(material, rgba);
    this.paint(material);
    return material;
  }

  private addShape(shape: RobotShape, material: RobotMaterial | null): void {
    const group = new Group();
    group.position.fromArray(shape.origin.xyz);
    group.quaternion.copy(orientation(shape.origin.rpy));
    super.add(group);
    if (shape.geometry.kind === "mesh") void this.addMesh(group, shape.geometry, material);
    else group.add(...solid(shape.geometry, this.linkMaterial(material, FrontSide)));
  }

  private async addMesh(
    group: Group,
    geometry: Geometry & { kind: "mesh" },
    material: RobotMaterial | null,
  ): Promise<void> {
    group.scale.fromArray(geometry.scale);
    try {
      const { object, materials, hasMaterials, missing } = await meshLibrary(this.connection).copy(geometry.uri);
      if (this.isDisposed) return;
      for (const uri of missing) this.onMissing(uri, "Could not load texture");
      if (hasMaterials) for (const material of materials) this.keep(material, material.color.toArray());
      else setMaterial(object, this.linkMaterial(material));
      group.add(object);
      this.onChange();
    } catch (error) {
      if (!this.isDisposed) this.onMissing(geometry.uri, error instanceof Error ? error.message : String(error));
    }
  }

  /** Material of the URDF; one with a texture has no color. */
  private linkMaterial(material: RobotMaterial | null, side: Side = DoubleSide): ShapeMaterial {
    if (material?.texture === null || material?.texture === undefined) {
      return this.keep(new ShapeMaterial({ side }), material?.rgba ?? SHADED_RED);
    }
    const map = new Texture();
    map.colorSpace = NoColorSpace;
    void this.fetchTexture(material.texture, map);
    return this.keep(new ShapeMaterial({ side, map }), [1, 1, 1, 1]);
  }

  private async fetchTexture(uri: string, map: Texture): Promise<void> {
    try {
      const url = URL.createObjectURL(new Blob([await this.connection.fetchAsset(uri)]));
      const image = new Image();
      image.src = url;
      await image.decode();
      URL.revokeObjectURL(url);
      map.image = image;
      map.needsUpdate = true;
      this.onChange();
    } catch (error) {
      this.onMissing(uri, error instanceof Error ? error.message : String(error));
    }
  }
}

function setMaterial(object: Object3D, material: ShapeMaterial): void {
  object.traverse((part) => {
    if (part instanceof Mesh) part.material = material;
  });
}

function solid(geometry: Exclude<Geometry, { kind: "mesh" }>, material: ShapeMaterial): Mesh[] {
  if (geometry.kind === "box") {
    const box = new Mesh(BOX, material);
    box.scale.fromArray(geometry.size);
    return [box];
  }
  const width = 2 * geometry.radius;
  if (geometry.kind === "sphere") {
    const sphere = new Mesh(SPHERE, material);
    sphere.scale.setScalar(width);
    return [sphere];
  }
  const cylinder = new Mesh(CYLINDER, material);
  cylinder.scale.set(width, width, geometry.length);
  if (geometry.kind === "cylinder") return [cylinder];
  const caps = [-0.5, 0.5].map((end) => {
    const cap = new Mesh(SPHERE, material);
    cap.scale.setScalar(width);
    cap.position.z = end * geometry.length;
    return cap;
  });
  return [cylinder, ...caps];
}

/** Rotation about the fixed axes x, y, z in this order. */
function orientation([roll, pitch, yaw]: readonly [number, number, number]): Quaternion {
  return new Quaternion().setFromEuler(new Euler(roll, pitch, yaw, "ZYX"));
}
