/** Mesh files as three.js objects, in the file's own axes as rviz has them. */

import { BufferGeometry, Group, LoadingManager, Mesh, MeshBasicMaterial, type Object3D } from "three";
import { ColladaLoader } from "three/examples/jsm/loaders/ColladaLoader.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { MTLLoader } from "three/examples/jsm/loaders/MTLLoader.js";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
import { STLLoader } from "three/examples/jsm/loaders/STLLoader.js";

export type FetchAsset = (uri: string) => Promise<ArrayBuffer>;

export interface LoadedMesh {
  readonly object: Object3D;
  /** False where the file has no materials of its own, as .stl has none. */
  readonly hasMaterials: boolean;
  /** Textures and material files that could not be fetched. */
  readonly missing: readonly string[];
}

/** Read a mesh by the end of its name; rejects with a sentence. */
export async function loadMesh(uri: string, fetchAsset: FetchAsset): Promise<LoadedMesh> {
  const bytes = await fetchAsset(uri);
  const side = new SideFiles(uri, fetchAsset);
  switch (extension(uri)) {
    case "stl":
      return { object: named(new STLLoader().parse(bytes)), hasMaterials: false, missing: [] };
    case "dae":
      return { object: await readCollada(text(bytes), side), hasMaterials: true, missing: side.missing };
    case "obj":
      return readObj(text(bytes), side);
    case "glb":
    case "gltf":
      return { object: await readGltf(bytes, side), hasMaterials: true, missing: side.missing };
    default:
      throw new Error(`.${extension(uri)} is no mesh that can be read; .stl, .dae, .obj, .glb and .gltf are`);
  }
}

/** Files that a mesh refers to: fetched first, then passed to the loaders by name. */
class SideFiles {
  readonly folder: string;
  readonly manager = new LoadingManager();
  readonly missing: string[] = [];
  /** Pictures being read by loaders; resolves also for unreadable ones. */
  private pictures: Promise<unknown> = Promise.resolve();
  private readonly urls = new Map<string, string>();

  constructor(
    uri: string,
    private readonly fetchAsset: FetchAsset,
  ) {
    this.folder = uri.slice(0, uri.lastIndexOf("/") + 1);
    this.manager.setURLModifier((url) => this.urls.get(url) ?? url);
    this.manager.onStart = () => {
      this.pictures = new Promise<void>((resolve) => (this.manager.onLoad = resolve));
    };
  }

  /** Wait until all pictures are read, so that nothing is drawn without its texture. */
  async settle(): Promise<void> {
    await this.pictures;
  }

  /** Bytes of a file beside the mesh; null: it is missing, which is noted. */
  async bytes(name: string): Promise<ArrayBuffer | null> {
    const uri = /^[a-z]+:\/\//.test(name) ? name : joined(this.folder, decoded(name));
    try {
      return await this.fetchAsset(uri);
    } catch {
      this.missing.push(uri);
      return null;
    }
  }

  /** Fetch textures; loaders ask for them by the folder and their name. */
  async fetchAll(names: Iterable<string>): Promise<void> {
    await Promise.all(
      [...new Set(names)]
        .filter((name) => !name.startsWith("data:"))
        .map(async (name) => {
          const bytes = await this.bytes(name);
          const url = bytes === null ? EMPTY_PICTURE : URL.createObjectURL(new Blob([bytes]));
          this.urls.set(name, url).set(this.folder + name, url);
        }),
    );
  }
}

/** One white pixel, for a texture that is missing. */
const EMPTY_PICTURE =
  "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP4DwABAQEAsTjnjwAAAABJRU5ErkJggg==";

async function readCollada(xml: string, side: SideFiles): Promise<Object3D> {
  const inside = [...xml.matchAll(/<init_from>(?:\s*<ref>)?([^<]*)</g)].map(([, name = ""]) => name.trim());
  await side.fetchAll(inside.filter((name) => /\.[A-Za-z]{3,4}$/.test(name)));
  const scene = parseCollada(xml, side);
  await side.settle();
  return scene;
}

function parseCollada(xml: string, side: SideFiles): Object3D {
  const warn = console.warn;
  console.warn = (): undefined => undefined; // three.js warns of an up axis that rviz ignores, too
  try {
    const collada = new ColladaLoader(side.manager).parse(xml, side.folder);
    if (collada === null) throw new Error("the file is no Collada");
    collada.scene.rotation.set(0, 0, 0);
    return collada.scene;
  } finally {
    console.warn = warn;
  }
}

async function readObj(source: string, side: SideFiles): Promise<LoadedMesh> {
  const loader = new OBJLoader(side.manager);
  const library = /^mtllib[ \t]+(\S.*)$/m.exec(source)?.[1]?.trim();
  const bytes = library === undefined ? null : await side.bytes(library);
  if (bytes !== null) {
    const mtl = text(bytes);
    await side.fetchAll([...mtl.matchAll(/^[ \t]*map_Kd[ \t]+(\S.*)$/gm)].map(([, name = ""]) => name.trim()));
    const materials = new MTLLoader(side.manager).parse(mtl, side.folder);
    materials.preload();
    loader.setMaterials(materials);
  }
  const object = loader.parse(source);
  await side.settle();
  return { object, hasMaterials: bytes !== null, missing: side.missing };
}

async function readGltf(bytes: ArrayBuffer, side: SideFiles): Promise<Object3D> {
  const magic = new DataView(bytes).getUint32(0, true);
  if (magic !== 0x46546c67) {
    const uris = [...text(bytes).matchAll(/"uri"\s*:\s*"([^"]+)"/g)].map(([, uri = ""]) => uri);
    await side.fetchAll(uris);
  }
  const { scene } = await new GLTFLoader(side.manager).parseAsync(bytes, side.folder);
  return scene;
}

function named(geometry: BufferGeometry): Object3D {
  return new Group().add(new Mesh(geometry, new MeshBasicMaterial()));
}

function extension(uri: string): string {
  return uri.slice(uri.lastIndexOf(".") + 1).toLowerCase();
}

function text(bytes: ArrayBuffer): string {
  return new TextDecoder().decode(bytes);
}

/** A name with its escapes decoded; a name with a stray `%` is left as it is. */
function decoded(name: string): string {
  try {
    return decodeURIComponent(name);
  } catch {
    return name;
  }
}

/** A name relative to a folder, without `..`. */
function joined(folder: string, name: string): string {
  const [, scheme = "", path = ""] = /^([a-z]+:\/\/)?(.*)$/.exec(folder + name.replaceAll("\\", "/")) ?? [];
  const parts: string[] = [];
  for (const part of path.split("/")) {
    if (part === "..") parts.pop();
    else if (part !== ".") parts.push(part);
  }
  return scheme + parts.join("/");
}
