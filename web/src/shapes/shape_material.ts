/**
 * Material of rviz's shapes: one light that shines as the camera looks, and nothing else, in the colors' own numbers.
 *
 * Measured on pictures of rviz: a face toward the camera is as bright as its color, a face at right angles is black.
 * The lights of the simulated world do not reach it, so that a marker has the same color in every world.
 */

import { DoubleSide, FrontSide, ShaderMaterial, Vector4, type Side, type Texture } from "three";

import type { Rgb } from "../rviz/properties";

const VERTEX = /* glsl */ `
#include <common>
#include <logdepthbuf_pars_vertex>
varying vec3 vShapeNormal;
varying vec4 vShapeColor;
varying vec2 vShapeUv;
uniform vec4 shapeColor;
#ifdef INSTANCE_RGBA
attribute vec4 instanceRgba;
#endif
#ifdef VERTEX_RGBA
attribute vec4 vertexRgba;
#endif
void main() {
  vShapeColor = shapeColor;
  #ifdef INSTANCE_RGBA
  vShapeColor *= instanceRgba;
  #endif
  #ifdef VERTEX_RGBA
  vShapeColor *= vertexRgba;
  #endif
  vShapeUv = uv;
  mat4 shape_from_object = modelMatrix;
  #ifdef USE_INSTANCING
  shape_from_object = modelMatrix * instanceMatrix;
  #endif
  // normals by the inverse transpose: rows of the 3x3 over their squared lengths
  mat3 turn = mat3(shape_from_object);
  turn[0] /= max(dot(turn[0], turn[0]), 1e-12);
  turn[1] /= max(dot(turn[1], turn[1]), 1e-12);
  turn[2] /= max(dot(turn[2], turn[2]), 1e-12);
  vShapeNormal = mat3(viewMatrix) * (turn * normal);
  vec4 mvPosition = viewMatrix * shape_from_object * vec4(position, 1.0);
  gl_Position = projectionMatrix * mvPosition;
  #include <logdepthbuf_vertex>
}`;

const FRAGMENT = /* glsl */ `
#include <common>
#include <logdepthbuf_pars_fragment>
varying vec3 vShapeNormal;
varying vec4 vShapeColor;
varying vec2 vShapeUv;
uniform float shapeGlow;
uniform vec4 shapeTint;
#ifdef SHAPE_MAP
uniform sampler2D shapeMap;
#endif
void main() {
  #include <logdepthbuf_fragment>
  vec4 color = vShapeColor;
  #ifdef SHAPE_MAP
  color *= texture2D(shapeMap, vShapeUv);
  #endif
  color.rgb = mix(color.rgb, shapeTint.rgb, shapeTint.a);
  #ifdef SHAPE_SOFT
  float along = normalize(vShapeNormal).z;
  color.rgb *= 0.8 + 0.2 * along * along;
  #endif
  #ifdef SHAPE_LIT
  color.rgb *= max(normalize(vShapeNormal).z, 0.0); // a face's back is as dark as it would be seen through
  #endif
  color.rgb += shapeGlow;
  #ifdef OPAQUE
  color.a = 1.0; // whatever the texture says
  #endif
  gl_FragColor = color;
}`;

/** Alpha below which rviz blends and no longer writes depth. */
const OPAQUE = 0.9998;

export interface ShapeMaterialOptions {
  /** `soft`: as rviz shades the spheres of clouds and lists; `flat`: without shading. */
  readonly shading?: "lit" | "soft" | "flat";
  readonly side?: Side;
  /** Each instance has an attribute `instanceRgba`, each vertex `vertexRgba`; they multiply the color. */
  readonly instanceColors?: boolean;
  readonly vertexColors?: boolean;
  readonly map?: Texture | null;
}

export class ShapeMaterial extends ShaderMaterial {
  private readonly rgba = new Vector4(1, 1, 1, 1);
  private readonly tint = new Vector4(0, 0, 0, 0);

  constructor(options: ShapeMaterialOptions = {}) {
    super({ vertexShader: VERTEX, fragmentShader: FRAGMENT, side: options.side ?? FrontSide, toneMapped: false });
    this.uniforms = {
      shapeColor: { value: this.rgba },
      shapeGlow: { value: 0 },
      shapeTint: { value: this.tint },
      shapeMap: { value: options.map ?? null },
    };
    const shading = options.shading ?? "lit";
    if (shading !== "flat") this.defines[shading === "lit" ? "SHAPE_LIT" : "SHAPE_SOFT"] = "";
    if (options.instanceColors ?? false) this.defines["INSTANCE_RGBA"] = "";
    if (options.vertexColors ?? false) this.defines["VERTEX_RGBA"] = "";
    if (options.map) this.defines["SHAPE_MAP"] = "";
  }

  /** Components 0…1, sRGB. */
  setRgba(red: number, green: number, blue: number, alpha: number): void {
    this.rgba.set(red, green, blue, alpha);
    this.setBlended(alpha < OPAQUE);
  }

  /** Set a property's color and alpha. */
  setColor(color: Rgb, alpha = 1): void {
    this.setRgba(color[0] / 255, color[1] / 255, color[2] / 255, alpha);
  }

  /** Set a color blended over texture and color, with weight 0…1. */
  setTint(red: number, green: number, blue: number, share: number): void {
    this.tint.set(red, green, blue, share);
  }

  /** Set the brightening, as rviz shows a hovered object. */
  setGlow(glow: number): void {
    const uniform = this.uniforms["shapeGlow"];
    if (uniform !== undefined) uniform.value = glow;
  }

  setBlended(blended: boolean): void {
    if (blended !== this.transparent) this.needsUpdate = true; // opaque and blended materials have different programs
    this.transparent = blended;
    this.depthWrite = !blended;
  }

  /** The color in use, 0…1. */
  get color(): Vector4 {
    return this.rgba;
  }
}

/** A material without light, as rviz's lines and flat shapes have it. */
export function flatMaterial(options: Omit<ShapeMaterialOptions, "shading"> = {}): ShapeMaterial {
  return new ShapeMaterial({ side: DoubleSide, ...options, shading: "flat" });
}
