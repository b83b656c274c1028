/** A map in the scene: textures of bytes that a shader looks up in a palette. */

import {
  CustomBlending,
  DataTexture,
  DoubleSide,
  Group,
  Mesh,
  OneFactor,
  OneMinusSrcAlphaFactor,
  PlaneGeometry,
  RedFormat,
  ShaderMaterial,
  SrcAlphaFactor,
  Vector2,
  type WebGLRenderer,
} from "three";

import { cut, overlap, tilesOf, type OccupancyMap, type Region } from "./occupancy_map";
import { palette, type ColorScheme } from "./palette";

/** Side of a texture [cells]. */
const TILE = 4096;

const VERTEX = /* glsl */ `
#include <common>
#include <logdepthbuf_pars_vertex>
varying vec2 vUv;
void main() {
  vUv = uv;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  #include <logdepthbuf_vertex>
}`;

const FRAGMENT = /* glsl */ `
#include <common>
#include <logdepthbuf_pars_fragment>
uniform sampler2D cells;
uniform sampler2D colors;
uniform float alpha;
varying vec2 vUv;
void main() {
  #include <logdepthbuf_fragment>
  float value = texture2D(cells, vUv).r;
  vec4 color = texelFetch(colors, ivec2(int(value * 255.0 + 0.5), 0), 0);
  gl_FragColor = vec4(color.rgb, color.a * alpha);
}`;

/** A unit square from its corner. */
const SQUARE = new PlaneGeometry(1, 1).translate(0.5, 0.5, 0);

interface Tile {
  readonly region: Region;
  readonly texture: DataTexture;
  readonly mesh: Mesh<PlaneGeometry, ShaderMaterial>;
  readonly updates: Region[];
}

export class MapObject extends Group {
  private readonly tiles: Tile[];
  private readonly colors = { value: paletteTexture("map") };
  private readonly alpha = { value: 1 };
  private scheme: ColorScheme = "map";

  constructor(private map: OccupancyMap) {
    super();
    this.tiles = tilesOf(map, TILE).map((region) => this.makeTile(region));
  }

  /** True if another map can take this one's place. */
  fits({ width, height, resolution }: OccupancyMap): boolean {
    return this.map.width === width && this.map.height === height && this.map.resolution === resolution;
  }

  setMap(map: OccupancyMap): void {
    this.map = map;
    for (const tile of this.tiles) {
      tile.updates.length = 0;
      tile.texture.image.data = cut(map, tile.region);
      tile.texture.needsUpdate = true;
    }
  }

  /** Copy a region of changed cells to the GPU. */
  refresh(region: Region): void {
    for (const tile of this.tiles) {
      const part = overlap(tile.region, region);
      if (part !== null) tile.updates.push(part);
    }
  }

  setLook(scheme: ColorScheme, alpha: number, isBehind: boolean): void {
    if (scheme !== this.scheme) {
      this.colors.value.dispose();
      this.colors.value = paletteTexture(scheme);
      this.scheme = scheme;
    }
    this.alpha.value = alpha;
    const isBlended = alpha < 0.9998 || scheme !== "map";
    for (const { mesh } of this.tiles) {
      mesh.renderOrder = isBehind ? -1000 : 0;
      mesh.material.transparent = isBlended && !isBehind; // behind: blended before all that is opaque is drawn
      mesh.material.blending = CustomBlending;
      mesh.material.depthWrite = !isBlended && !isBehind;
    }
  }

  override dispose(): void {
    this.colors.value.dispose();
    for (const { texture, mesh } of this.tiles) {
      texture.dispose();
      mesh.material.dispose();
    }
  }

  private makeTile(region: Region): Tile {
    const texture = bytesTexture(cut(this.map, region), region);
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: DoubleSide,
      polygonOffset: true, // objects in the map's plane are drawn over it, by rviz's bias
      polygonOffsetUnits: 16,
      blendSrc: SrcAlphaFactor,
      blendDst: OneMinusSrcAlphaFactor,
      blendSrcAlpha: OneFactor, // the canvas stays opaque
      blendDstAlpha: OneMinusSrcAlphaFactor,
    });
    material.uniforms = { cells: { value: texture }, colors: this.colors, alpha: this.alpha };
    const mesh = new Mesh(SQUARE, material);
    const { resolution } = this.map;
    mesh.position.set(region.x * resolution, region.y * resolution, 0);
    mesh.scale.set(region.width * resolution, region.height * resolution, 1);
    const tile: Tile = { region, texture, mesh, updates: [] };
    mesh.onBeforeRender = (renderer) => this.upload(tile, renderer);
    this.add(mesh);
    return tile;
  }

  /** Copy changed regions into the texture that the GPU has. */
  private upload({ region, texture, updates }: Tile, renderer: WebGLRenderer): void {
    for (const part of updates.splice(0)) {
      const patch = bytesTexture(cut(this.map, part), part);
      renderer.copyTextureToTexture(patch, texture, null, new Vector2(part.x - region.x, part.y - region.y));
      patch.dispose();
    }
  }
}

function bytesTexture(
  bytes: Uint8Array<ArrayBuffer>,
  { width, height }: { readonly width: number; readonly height: number },
): DataTexture {
  const texture = new DataTexture(bytes, width, height, RedFormat);
  texture.needsUpdate = true;
  return texture;
}

function paletteTexture(scheme: ColorScheme): DataTexture {
  const texture = new DataTexture(palette(scheme), 256, 1);
  texture.needsUpdate = true;
  return texture;
}
