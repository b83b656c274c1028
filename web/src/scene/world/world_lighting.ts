/** Lights, shadows, ambient light and fog of the simulated world. */

import {
  Color,
  Object3D,
  Vector3,
  type Light,
  type Mesh,
  type Scene,
  type ShaderMaterial,
  type WebGLRenderer,
} from "three";

import type { Manifest } from "../../protocol/generated/page_messages";
import { FOG_KINDS, fragmentShader, type LightKind } from "./sdf_shader";
import { CASTERS, ShadowMap } from "./shadow_map";

const MAX_LIGHTS = 16;
const MAX_SHADOWS = 4;

/** `extras.sdf` of a light. */
interface SdfLight {
  readonly diffuse: readonly number[];
  readonly specular: readonly number[];
  readonly attenuation: readonly [number, number, number];
  readonly cast_shadows: boolean;
  readonly spot?: { readonly inner_angle: number; readonly outer_angle: number; readonly falloff: number };
}

interface WorldLight {
  /** Shines along its −z. */
  readonly object: Object3D;
  readonly kind: LightKind;
  readonly sdf: SdfLight;
  readonly range: number;
  readonly uniform: ReturnType<typeof emptyUniform>;
  readonly shadow: ShadowMap | null;
}

/** The sun of a world without lights, as in Trundle's renderer. */
const DEFAULT_DIRECTION = new Vector3(-0.3, 0.5, -0.8);
const DEFAULT_SUN: SdfLight = {
  diffuse: [0.8, 0.8, 0.8],
  specular: [0.1, 0.1, 0.1],
  attenuation: [1, 0, 0],
  cast_shadows: false,
};

function emptyUniform() {
  const [cosInner, cosOuter, falloff, range] = [1, 0, 1, 0] as number[];
  return {
    range,
    cosInner,
    cosOuter,
    falloff,
    position: new Vector3(),
    toLight: new Vector3(),
    diffuse: new Color(),
    specular: new Color(),
    attenuation: new Vector3(1, 0, 0),
  };
}

export class WorldLighting {
  private lights: WorldLight[] = [];
  private readonly materials = new Set<ShaderMaterial>();
  private casters: Mesh[] = [];
  private areShadowsStale = true;
  private readonly direction = new Vector3();
  private readonly uniforms: ShaderMaterial["uniforms"] = {
    ambientLight: { value: new Color(0.4, 0.4, 0.4) },
    fogOfWorld: { value: { kind: 0, color: new Color(), start: 0, end: 1, density: 0 } },
    lights: { value: [] },
    shadows: { value: [] },
    ...Object.fromEntries(Array.from({ length: MAX_SHADOWS }, (_, i) => [`shadowMap${i}`, { value: null }])),
  };

  constructor() {
    this.setLights([]);
  }

  /** Register a material to be lit. */
  light(material: ShaderMaterial): void {
    Object.assign(material.uniforms, this.uniforms);
    material.fragmentShader = this.shader;
    this.materials.add(material);
  }

  forget(material: ShaderMaterial): void {
    this.materials.delete(material);
  }

  setScene({ ambient, fog }: Manifest["scene"]): void {
    this.set("ambientLight", new Color(...ambient));
    const { start = 0, end = 1, density = 0, color = [0, 0, 0] as const } = fog ?? {};
    this.set("fogOfWorld", {
      kind: FOG_KINDS[fog?.type ?? "none"] ?? 0,
      color: new Color(...color),
      start,
      end,
      density,
    });
  }

  /** Set the lights and shadow casters from the objects of the world. */
  setContents(root: Object3D, hasShadows: boolean): void {
    const objects: Light[] = [];
    this.casters = [];
    root.traverse((object) => {
      if (isLight(object) && object.userData["sdf"] !== undefined) objects.push(object);
      else if (isMesh(object) && object.layers.isEnabled(CASTERS)) this.casters.push(object);
    });
    this.setLights(objects, hasShadows);
  }

  /** Draw shadows again, since something moved. */
  invalidate(): void {
    this.areShadowsStale = true;
  }

  /** Update lights and shadows before a picture. */
  update(renderer: WebGLRenderer, scene: Scene): void {
    scene.updateMatrixWorld();
    for (const light of this.lights) this.place(light);
    if (!this.areShadowsStale) return;
    this.areShadowsStale = false;
    const shown = this.casters.filter(isShown);
    const shadowed = this.lights.filter(({ shadow }) => shadow !== null);
    shadowed.forEach(({ shadow, kind, sdf, range, uniform }, i) => {
      this.direction.copy(uniform.toLight).negate();
      if (kind === "directional") shadow?.drawDirectional(renderer, scene, this.direction, shown);
      else shadow?.drawSpot(renderer, scene, uniform.position, this.direction, sdf.spot?.outer_angle ?? 1, range);
      this.set(`shadowMap${i}`, shadow?.texture ?? null);
    });
  }

  private get shader(): string {
    return fragmentShader(
      this.lights.map(({ kind }) => kind),
      this.lights.filter(({ shadow }) => shadow !== null).length,
    );
  }

  private setLights(objects: readonly Light[], hasShadows = false): void {
    for (const { shadow } of this.lights) shadow?.dispose();
    let maps = 0;
    const lights = objects.map((light): WorldLight => {
      light.visible = false; // hides it from three.js' own shading
      const sdf = light.userData["sdf"] as SdfLight;
      const kind = kindOf(light);
      const isShadowed = hasShadows && sdf.cast_shadows && kind !== "point" && maps < MAX_SHADOWS;
      if (isShadowed) maps += 1;
      const distance = "distance" in light && typeof light.distance === "number" ? light.distance : 0;
      return {
        object: light,
        kind,
        sdf,
        range: distance > 0 ? distance : 1e9,
        uniform: emptyUniform(),
        shadow: isShadowed ? new ShadowMap() : null,
      };
    });
    if (lights.length === 0) lights.push(defaultSun());
    // the shader expects lights with shadow maps first
    lights.sort((a, b) => Number(b.shadow !== null) - Number(a.shadow !== null));
    this.lights = lights.slice(0, MAX_LIGHTS);
    for (const light of this.lights) setConstants(light);
    this.set(
      "lights",
      this.lights.map(({ uniform }) => uniform),
    );
    this.set(
      "shadows",
      this.lights.flatMap(({ shadow }) => shadow?.uniform ?? []),
    );
    this.areShadowsStale = true;
    for (const material of this.materials) {
      material.fragmentShader = this.shader;
      material.needsUpdate = true;
    }
  }

  private place({ object, uniform }: WorldLight): void {
    if (object.parent === null) return; // the default sun does not move
    uniform.position.setFromMatrixPosition(object.matrixWorld);
    uniform.toLight.setFromMatrixColumn(object.matrixWorld, 2).normalize();
  }

  private set(name: string, value: unknown): void {
    const uniform = this.uniforms[name];
    if (uniform !== undefined) uniform.value = value;
  }
}

function setConstants({ sdf, range, uniform }: WorldLight): void {
  uniform.range = range;
  uniform.diffuse.fromArray(sdf.diffuse);
  uniform.specular.fromArray(sdf.specular);
  uniform.attenuation.set(...sdf.attenuation);
  if (sdf.spot === undefined) return;
  const { inner_angle, outer_angle, falloff } = sdf.spot;
  uniform.cosOuter = Math.cos(outer_angle / 2);
  uniform.cosInner = Math.max(Math.cos(Math.min(inner_angle, outer_angle) / 2), uniform.cosOuter + 1e-4);
  uniform.falloff = falloff;
}

function defaultSun(): WorldLight {
  const uniform = emptyUniform();
  uniform.toLight.copy(DEFAULT_DIRECTION).negate();
  return { object: new Object3D(), kind: "directional", sdf: DEFAULT_SUN, range: 1e9, uniform, shadow: null };
}

function kindOf(light: Light): LightKind {
  if (light.type === "PointLight") return "point";
  return light.type === "SpotLight" ? "spot" : "directional";
}

function isMesh(object: Object3D): object is Mesh {
  return (object as Partial<Mesh>).isMesh === true;
}

function isLight(object: Object3D): object is Light {
  return (object as Partial<Light>).isLight === true;
}

function isShown(object: Object3D): boolean {
  for (let at: Object3D | null = object; at !== null; at = at.parent) if (!at.visible) return false;
  return true;
}
