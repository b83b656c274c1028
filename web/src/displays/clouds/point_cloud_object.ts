/** A cloud in the scene, drawn from the message's own words. */

import {
  BufferAttribute,
  BufferGeometry,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  Mesh,
  MeshBasicMaterial,
  Points,
  type Intersection,
  type Object3D,
  type Raycaster,
  type WebGLRenderer,
  Vector4,
} from "three";

import type { Channel, Cloud } from "./cloud";
import { CloudMaterial, type Style } from "./cloud_material";
import { nearestPoint } from "./pick_point";

/**
 * Larger clouds are drawn as GL's points, a vertex each, for renderers without a GPU, which take some 20 µs
 * for an instance. GL limits the size of its points, and drops a point whose middle is out of sight.
 */
const MAX_INSTANCES = 1000;

/** Lightness of a box's sides in rviz without geometry shaders, −x +x −y +y −z +z. */
const SIDES: readonly (readonly [axis: 0 | 1 | 2, sign: 1 | -1, lightness: number])[] = [
  [0, -1, 0.6],
  [0, 1, 0.6],
  [1, -1, 1.0],
  [1, 1, 0.4],
  [2, -1, 0.5],
  [2, 1, 0.9],
];

const VIEWPORT = new Vector4();

export interface CloudObject {
  readonly object: Object3D;
  readonly material: CloudMaterial;
  /** Set which words of a point its color is computed from; at most three. */
  setChannels(words: readonly number[]): void;
  dispose(): void;
}

/** Create the object of a cloud; `dispose` frees it. */
export function cloudObject(cloud: Cloud, style: Style): CloudObject {
  const isSprite = style !== "Boxes" && style !== "Tiles" && cloud.count > MAX_INSTANCES;
  const geometry = isSprite ? new BufferGeometry() : shapeGeometry(style, cloud.count);
  if (isSprite) geometry.setDrawRange(0, cloud.count);
  const buffer = isSprite
    ? new InterleavedBuffer(cloud.words, cloud.stride)
    : new InstancedInterleavedBuffer(cloud.words, cloud.stride);
  const setWord = (name: string, word: number): void => {
    geometry.setAttribute(name, new InterleavedBufferAttribute(buffer, 1, word));
  };
  for (const axis of ["x", "y", "z"]) setWord(`p${axis}`, wordOf(cloud.channel(axis)));
  for (const name of ["c0", "c1", "c2"]) setWord(name, 0);
  const material = new CloudMaterial(style, isSprite);
  const drawn = isSprite ? new Points(geometry, material) : new Mesh(geometry, material);
  drawn.frustumCulled = false;
  drawn.userData["notPicked"] = true;
  drawn.onBeforeRender = (renderer) => followPicture(material, renderer);
  const object = new CloudPicker(cloud, geometry, material);
  object.add(drawn);
  return {
    object,
    material,
    setChannels: (channels) => channels.forEach((word, index) => setWord(`c${index}`, word)),
    dispose: () => object.dispose(),
  };
}

export function wordOf(channel: Channel | undefined): number {
  return channel === undefined ? 0 : channel.offset >> 2;
}

function followPicture({ uniforms, style }: CloudMaterial, renderer: WebGLRenderer): void {
  if (style === "Boxes" || style === "Tiles") return;
  renderer.getCurrentViewport(VIEWPORT);
  uniforms.viewport.value.set(VIEWPORT.z, VIEWPORT.w);
  uniforms.pixelRatio.value = renderer.getRenderTarget() === null ? renderer.getPixelRatio() : 1;
}

function shapeGeometry(style: Style, count: number): InstancedBufferGeometry {
  const positions: number[] = [];
  const lightness: number[] = [];
  const corners: number[] = [];
  const index: number[] = [];
  const sides = style === "Boxes" ? SIDES : ([[2, 1, 1]] as const);
  for (const [axis, sign, light] of sides) {
    const first = positions.length / 3;
    for (const [u, v] of [
      [-0.5, -0.5],
      [0.5, -0.5],
      [-0.5, 0.5],
      [0.5, 0.5],
    ] as const) {
      const corner = [0, 0, 0];
      corner[axis] = style === "Boxes" ? sign / 2 : 0;
      corner[(axis + 1) % 3] = u;
      corner[(axis + 2) % 3] = v;
      positions.push(...corner);
      lightness.push(light, 0, 0);
      corners.push(u, v);
    }
    index.push(first, first + 1, first + 2, first + 2, first + 1, first + 3);
  }
  const geometry = new InstancedBufferGeometry();
  geometry.instanceCount = count;
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("normal", new BufferAttribute(new Float32Array(lightness), 3));
  geometry.setAttribute("uv", new BufferAttribute(new Float32Array(corners), 2));
  geometry.setIndex(index);
  return geometry;
}

const NOTHING = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(0), 3));
const UNSEEN = new MeshBasicMaterial({ visible: false });

/** Encloses the drawn points and finds the one under the pointer; draws nothing itself. */
class CloudPicker extends Mesh {
  constructor(
    private readonly cloud: Cloud,
    private readonly drawn: BufferGeometry,
    private readonly look: CloudMaterial,
  ) {
    super(NOTHING, UNSEEN);
    this.frustumCulled = false;
  }

  override dispose(): void {
    this.drawn.dispose();
    this.look.dispose();
  }

  override raycast(raycaster: Raycaster, intersections: Intersection[]): void {
    const radius = this.look.style === "Points" ? 0 : this.look.uniforms.pointSize.value.x / 2;
    const nearest = nearestPoint(this.cloud, radius, this.matrixWorld, raycaster);
    if (nearest !== null) intersections.push({ ...nearest, object: this, instanceId: nearest.index });
  }
}
