import { expect, it } from "vitest";

import { loadMesh } from "../../src/displays/meshes/mesh_formats";

/** A triangle that names a file of materials, and what is in that file; undefined: it is missing. */
async function loadTriangle(
  library: string,
  materials?: string,
): Promise<{ triangles: number; missing: readonly string[] }> {
  const files = new Map([["package://robot/a.obj", `mtllib ${library}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n`]]);
  if (materials !== undefined) files.set(`package://robot/${library}`, materials);
  const fetchAsset = (uri: string): Promise<ArrayBuffer> => {
    const text = files.get(uri);
    return text === undefined
      ? Promise.reject(new Error("no such file"))
      : Promise.resolve(new TextEncoder().encode(text).buffer);
  };
  const { object, missing } = await loadMesh("package://robot/a.obj", fetchAsset);
  return { triangles: object.children.length, missing };
}

it("shows a mesh without the file that it names with a stray percent sign", async () => {
  expect(await loadTriangle("50%.mtl")).toEqual({ triangles: 1, missing: ["package://robot/50%.mtl"] });
});

it("reads long runs of blank lines in linear time", async () => {
  expect(await loadTriangle("a.mtl", "\n".repeat(300_000))).toEqual({ triangles: 1, missing: [] });
});
