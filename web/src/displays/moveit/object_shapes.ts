/** Shapes of a collision object: primitives, meshes and planes, at its pose. */

import { BufferAttribute, BufferGeometry, ConeGeometry, DoubleSide, Group, Mesh, Quaternion, Vector3 } from "three";

import { placed } from "../../frames/valid";
import type {
  CollisionObject,
  Plane,
  Pose,
  Mesh as RosMesh,
  SolidPrimitive,
} from "../../protocol/generated/ros_messages";
import type { Selectable } from "../../scene/scene_view";
import { ShapeMaterial } from "../../shapes/shape_material";
import { BOX, CYLINDER, SPHERE } from "../../shapes/solids";

export const Primitive = { box: 1, sphere: 2, cylinder: 3, cone: 4 } as const;
export type Rgba = readonly [number, number, number, number];

/** Cone of 1 m diameter and height about its middle, along z. */
const CONE = new ConeGeometry(0.5, 1, 24).rotateX(Math.PI / 2);
/** rviz shows a plane as a thin box of this size [m], half as opaque. */
const PLANE = { width: 10, height: 0.001, alpha: 0.5 } as const;
const Z = new Vector3(0, 0, 1);

export class ObjectShapes extends Group {
  private readonly materials: { readonly material: ShapeMaterial; readonly share: number }[] = [];
  private readonly own: BufferGeometry[] = [];

  constructor(
    readonly object: CollisionObject,
    describe: () => Readonly<Record<string, unknown>>,
  ) {
    super();
    this.name = object.id;
    placed(this, object.pose);
    const { primitives, primitive_poses, meshes, mesh_poses, planes, plane_poses } = object;
    primitives.forEach((shape, index) => this.put(this.primitive(shape), primitive_poses[index]));
    meshes.forEach((mesh, index) => this.put(this.mesh(mesh), mesh_poses[index]));
    planes.forEach((plane, index) => this.put(this.plane(plane), plane_poses[index]));
    const selectable: Selectable = { describe };
    this.userData["selectable"] = selectable;
  }

  /** Color all shapes, components 0…1. */
  paint([red, green, blue, alpha]: Rgba): void {
    for (const { material, share } of this.materials) material.setRgba(red, green, blue, alpha * share);
  }

  override dispose(): void {
    for (const { material } of this.materials) material.dispose();
    for (const geometry of this.own) geometry.dispose();
  }

  private put(shape: Mesh | null, pose: Pose | undefined): void {
    if (shape === null) return;
    const group = new Group().add(shape);
    super.add(pose === undefined ? group : placed(group, pose));
  }

  private material(share = 1, isOpen = false): ShapeMaterial {
    const material = new ShapeMaterial(isOpen ? { side: DoubleSide } : {});
    this.materials.push({ material, share });
    return material;
  }

  private primitive({ type, dimensions }: SolidPrimitive): Mesh | null {
    const [a = 0, b = 0, c = 0] = dimensions;
    const solid = (geometry: BufferGeometry, x: number, y: number, z: number): Mesh => {
      const mesh = new Mesh(geometry, this.material());
      mesh.scale.set(x, y, z);
      return mesh;
    };
    switch (type) {
      case Primitive.box:
        return solid(BOX, a, b, c);
      case Primitive.sphere:
        return solid(SPHERE, 2 * a, 2 * a, 2 * a);
      case Primitive.cylinder:
        return solid(CYLINDER, 2 * b, 2 * b, a);
      case Primitive.cone:
        return solid(CONE, 2 * b, 2 * b, a);
      default:
        return null;
    }
  }

  private mesh({ vertices, triangles }: RosMesh): Mesh {
    const positions = new Float32Array(9 * triangles.length);
    triangles.forEach(({ vertex_indices: corners }, triangle) => {
      for (let corner = 0; corner < 3; corner++) {
        const { x, y, z } = vertices[corners[corner] ?? 0] ?? { x: 0, y: 0, z: 0 };
        positions.set([x, y, z], 9 * triangle + 3 * corner);
      }
    });
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(positions, 3));
    geometry.computeVertexNormals();
    this.own.push(geometry);
    return new Mesh(geometry, this.material(1, true));
  }

  /** Plane of the points with ax + by + cz = d, as MoveIt draws it and checks collisions with it. */
  private plane({ coef }: Plane): Mesh | null {
    const normal = new Vector3(coef[0], coef[1], coef[2]);
    const length = normal.length();
    if (!(length > 0)) return null;
    normal.divideScalar(length);
    const mesh = new Mesh(BOX, this.material(PLANE.alpha));
    mesh.scale.set(PLANE.width, PLANE.width, PLANE.height);
    mesh.quaternion.copy(new Quaternion().setFromUnitVectors(Z, normal));
    mesh.position.copy(normal).multiplyScalar((coef[3] ?? 0) / length);
    return mesh;
  }
}
