/** Mesh files as meshes of messages. */

import { Mesh, Vector3 } from "three";

import { loadMesh, type FetchAsset } from "../../displays/meshes/mesh_formats";
import type { Mesh as RosMesh } from "../../protocol/generated/ros_messages";

const MAX_TRIANGLES = 500_000;

/** Triangles of a mesh by the end of its name (.stl, .dae, .obj, .glb, .gltf); rejects with a sentence. */
export async function importMesh(uri: string, fetchAsset: FetchAsset): Promise<RosMesh> {
  const { object } = await loadMesh(uri, fetchAsset);
  object.updateMatrixWorld(true);
  const vertices: { x: number; y: number; z: number }[] = [];
  const triangles: { vertex_indices: Uint32Array }[] = [];
  const known = new Map<string, number>();
  const point = new Vector3();
  object.traverse((part) => {
    if (!(part instanceof Mesh)) return;
    const { geometry, matrixWorld } = part as Mesh;
    const positions = geometry.getAttribute("position");
    const corner = (at: number): number => {
      point.fromBufferAttribute(positions, at).applyMatrix4(matrixWorld);
      const key = point.toArray().join(" ");
      const index = known.get(key) ?? vertices.length;
      if (index === vertices.length) {
        known.set(key, index);
        vertices.push({ x: point.x, y: point.y, z: point.z });
      }
      return index;
    };
    const count = geometry.index?.count ?? positions.count;
    if (count / 3 + triangles.length > MAX_TRIANGLES)
      throw new Error(`the mesh has more than ${MAX_TRIANGLES} triangles`);
    for (let at = 0; at + 2 < count; at += 3)
      triangles.push({
        vertex_indices: Uint32Array.from([0, 1, 2], (side) => corner(geometry.index?.getX(at + side) ?? at + side)),
      });
  });
  if (triangles.length === 0) throw new Error("the mesh has no triangles");
  return { vertices, triangles };
}
