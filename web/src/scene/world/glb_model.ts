/** A GLB file of the simulated world: its bodies, with materials that shade as Trundle's renderer does. */

import {
  Group,
  Mesh,
  SkinnedMesh,
  type AnimationClip,
  type BufferGeometry,
  type Light,
  type MeshStandardMaterial,
  type Object3D,
  type ShaderMaterial,
  type Texture,
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

import { sdfColors, sdfMaterial, sdfVariant } from "./sdf_material";
import { CASTERS } from "./shadow_map";
import type { WorldLighting } from "./world_lighting";

/** Geometries and textures that several files share, by the names of their contents. */
export class SharedContents {
  private readonly geometries = new Map<string, BufferGeometry>();
  private readonly textures = new Map<string, Texture>();

  geometry(resource: BufferGeometry): BufferGeometry {
    return shared(this.geometries, resource.userData["content"], resource);
  }

  texture(resource: Texture): Texture {
    const { offset, repeat } = resource;
    const name = resource.name === "" ? "" : [resource.name, offset.x, offset.y, repeat.x, repeat.y].join(" ");
    return shared(this.textures, name, resource);
  }

  /** Dispose of all contents, for another world. */
  dispose(): void {
    for (const resource of [...this.geometries.values(), ...this.textures.values()]) resource.dispose();
    this.geometries.clear();
    this.textures.clear();
  }
}

function shared<T>(known: Map<string, T>, name: unknown, resource: T): T {
  if (typeof name !== "string" || name === "") return resource;
  const cached = known.get(name) ?? resource;
  known.set(name, cached);
  return cached;
}

/** Drawing mode of a model's visuals. */
export interface VisualMode {
  readonly visuals: boolean;
  readonly transparent: boolean;
  readonly wireframe: boolean;
}

/** The model of a body, `model` of `model::link`. */
export function modelOf(body: Object3D): string {
  const name = String(body.userData["name"]);
  return name.slice(0, Math.max(0, name.lastIndexOf("::")));
}

export class GlbModel {
  /** In the world's frame, z up. */
  readonly root = new Group();
  readonly bodies = new Map<number, Object3D>();
  private readonly materials = new Map<string, ShaderMaterial>();
  /** Original materials. */
  private readonly plain = new Map<Object3D, { readonly mesh: Mesh; readonly material: ShaderMaterial }>();

  private constructor(
    private readonly lighting: WorldLighting,
    private readonly contents: SharedContents,
    readonly animations: readonly AnimationClip[],
  ) {}

  /** Read a file; `path`: folder of the files that it refers to. */
  static async read(
    data: ArrayBuffer,
    path: string,
    lighting: WorldLighting,
    contents: SharedContents,
  ): Promise<GlbModel> {
    const loader = new GLTFLoader();
    const gltf = await loader.parseAsync(data, path);
    const model = new GlbModel(lighting, contents, gltf.animations);
    for (const turned of [...gltf.scene.children]) {
      turned.quaternion.identity(); // the root turns z up into y up
      model.root.add(turned);
    }
    model.root.traverse((object) => model.prepare(object));
    return model;
  }

  /** Draw the visuals of each body in the mode of its model. */
  show(modeOf: (model: string) => VisualMode): void {
    for (const body of this.bodies.values()) {
      const mode = modeOf(modelOf(body));
      for (const visual of body.children) {
        if (visual.userData["visual"] === undefined) continue;
        visual.visible = mode.visuals;
        visual.traverse((object) => {
          const plain = this.plain.get(object);
          if (plain !== undefined) plain.mesh.material = this.variantOf(plain.material, mode);
        });
      }
    }
  }

  dispose(): void {
    for (const material of this.materials.values()) {
      this.lighting.forget(material);
      material.dispose();
    }
  }

  private prepare(object: Object3D): void {
    const body: unknown = object.userData["body"];
    if (typeof body === "number") this.bodies.set(body, object);
    else if (!isLight(object)) {
      object.updateMatrix();
      object.matrixAutoUpdate = false;
    }
    if (!(object instanceof Mesh)) return;
    const mesh = object as Mesh;
    mesh.geometry = this.contents.geometry(mesh.geometry);
    const standard = mesh.material as MeshStandardMaterial;
    const material = this.materialOf(standard, !mesh.geometry.hasAttribute("normal"));
    mesh.material = material;
    this.plain.set(mesh, { mesh, material });
    const extras = { ...mesh.parent?.userData, ...mesh.userData } as Record<string, unknown>;
    if (mesh instanceof SkinnedMesh) mesh.frustumCulled = false; // bones move the mesh out of its bounds
    if (extras["casts_shadow"] !== false && !material.transparent) mesh.layers.enable(CASTERS);
  }

  private materialOf(standard: MeshStandardMaterial, isFlat: boolean): ShaderMaterial {
    const key = `${standard.uuid} ${isFlat}`;
    const known = this.materials.get(key);
    if (known !== undefined) return known;
    const texture = standard.map === null ? null : this.contents.texture(standard.map);
    const material = sdfMaterial(sdfColors(standard), texture, isFlat, this.lighting);
    this.materials.set(key, material);
    return material;
  }

  private variantOf(plain: ShaderMaterial, mode: VisualMode): ShaderMaterial {
    if (!mode.transparent && !mode.wireframe) return plain;
    const key = `${plain.uuid} ${mode.transparent} ${mode.wireframe}`;
    const known = this.materials.get(key);
    if (known !== undefined) return known;
    const variant = sdfVariant(plain, mode, this.lighting);
    this.materials.set(key, variant);
    return variant;
  }
}

function isLight(object: Object3D): boolean {
  return (object as Partial<Light>).isLight === true;
}

/** Bytes of a file, with the share that has arrived, 0…1. */
export async function fetchBytes(
  url: string,
  onShare: (share: number) => void,
  signal: AbortSignal,
): Promise<ArrayBuffer> {
  const response = await fetch(url, { signal });
  if (!response.ok) throw new Error(`${url}: the server answered ${response.status}`);
  const total = Number(response.headers.get("content-length") ?? 0);
  const isEncoded = response.headers.get("content-encoding") !== null; // the length is that of the encoded bytes
  if (response.body === null || total === 0 || isEncoded) return response.arrayBuffer();
  const bytes = new Uint8Array(total);
  let at = 0;
  const reader = response.body.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    if (at + value.length > total) throw new Error(`${url}: longer than the server announced`);
    bytes.set(value, at);
    at += value.length;
    onShare(at / total);
  }
  if (at < total) throw new Error(`${url}: cut short after ${at} of ${total} bytes`);
  return bytes.buffer;
}
