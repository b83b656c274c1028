/** Meshes by their address: each is fetched and read once, and every use has materials of its own. */

import {
  DoubleSide,
  Mesh,
  NoColorSpace,
  SRGBColorSpace,
  type Color,
  type Material,
  type Object3D,
  type Texture,
} from "three";

import type { Connection } from "../../protocol/connection";
import { ShapeMaterial } from "../../shapes/shape_material";
import { loadMesh, type LoadedMesh } from "./mesh_formats";

/** Copy of a mesh with materials of its own. */
interface MeshCopy {
  readonly object: Object3D;
  readonly materials: readonly ShapeMaterial[];
  readonly hasMaterials: boolean;
  readonly missing: readonly string[];
}

const libraries = new WeakMap<Connection, MeshLibrary>();

/** The library of a connection; all displays share it. */
export function meshLibrary(connection: Connection): MeshLibrary {
  const cached = libraries.get(connection) ?? new MeshLibrary(connection);
  libraries.set(connection, cached);
  return cached;
}

class MeshLibrary {
  private readonly loaded = new Map<string, Promise<LoadedMesh>>();

  constructor(private readonly connection: Connection) {}

  /** Copy of the mesh at an address; rejects with a sentence. Failures are not cached, so that a retry may succeed. */
  async copy(uri: string): Promise<MeshCopy> {
    let loading = this.loaded.get(uri);
    if (loading === undefined) {
      loading = loadMesh(uri, (asset) => this.connection.fetchAsset(asset));
      this.loaded.set(uri, loading);
      loading.catch(() => this.loaded.delete(uri));
    }
    const { object, hasMaterials, missing } = await loading;
    return { ...copyMeshes(object), hasMaterials, missing };
  }
}

/** The object's meshes in their places, without its lights, cameras and lines. */
function copyMeshes(object: Object3D): {
  readonly object: Object3D;
  readonly materials: readonly ShapeMaterial[];
} {
  const materials = new Map<Material, ShapeMaterial>();
  const convert = (material: Material): ShapeMaterial => {
    const cached = materials.get(material) ?? shapeMaterial(material);
    materials.set(material, cached);
    return cached;
  };
  const copy = object.clone(true);
  const others: Object3D[] = [];
  copy.traverse((part) => {
    if (!(part instanceof Mesh)) {
      if (part.type !== "Group" && part.type !== "Object3D" && part.type !== "Scene") others.push(part);
      return;
    }
    const mesh = part as Mesh;
    if (!mesh.geometry.hasAttribute("normal")) mesh.geometry.computeVertexNormals();
    mesh.material = Array.isArray(mesh.material) ? mesh.material.map(convert) : convert(mesh.material);
  });
  for (const other of others) other.removeFromParent();
  return { object: copy, materials: [...materials.values()] };
}

interface ColoredMaterial extends Material {
  readonly color?: Color;
  readonly map?: Texture | null;
}

function isRead(map: Texture | null | undefined): map is Texture {
  return Boolean(map?.image);
}

function shapeMaterial(material: ColoredMaterial): ShapeMaterial {
  const map = isRead(material.map) ? material.map : null;
  const shape = new ShapeMaterial({ side: DoubleSide, map });
  if (map !== null) map.colorSpace = NoColorSpace; // the shader computes in sRGB
  const { r, g, b } = material.color?.getRGB({ r: 1, g: 1, b: 1 }, SRGBColorSpace) ?? { r: 1, g: 1, b: 1 };
  shape.setRgba(r, g, b, material.opacity);
  return shape;
}
