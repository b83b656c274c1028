/** Lines with a width in metres that face the viewer, as rviz's billboards: one draw call for all segments. */

import {
  BufferAttribute,
  DoubleSide,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Matrix4,
  Mesh,
  Ray,
  ShaderMaterial,
  Vector3,
  type Intersection,
  type Raycaster,
} from "three";

const VERTEX = /* glsl */ `
#include <common>
#include <logdepthbuf_pars_vertex>
attribute vec3 segmentStart;
attribute vec3 segmentEnd;
attribute vec3 startTangent;
attribute vec3 endTangent;
attribute vec4 startRgba;
attribute vec4 endRgba;
uniform float lineWidth;
varying vec4 vLineColor;
void main() {
  vec4 start = modelViewMatrix * vec4(segmentStart, 1.0);
  vec4 end = modelViewMatrix * vec4(segmentEnd, 1.0);
  // at a corner the edge is square to the line from the point before to the one after, as Ogre's chains have it
  vec3 along = mat3(modelViewMatrix) * (position.x < 0.5 ? startTangent : endTangent);
  vec4 mvPosition = mix(start, end, position.x);
  vec3 view = isOrthographic ? vec3(0.0, 0.0, -1.0) : mvPosition.xyz;
  vec3 side = cross(along, view);
  float length2 = dot(side, side);
  if (length2 > 1e-20) mvPosition.xyz += side * (inversesqrt(length2) * lineWidth * position.y);
  vLineColor = mix(startRgba, endRgba, position.x);
  gl_Position = projectionMatrix * mvPosition;
  #include <logdepthbuf_vertex>
}`;

const FRAGMENT = /* glsl */ `
#include <common>
#include <logdepthbuf_pars_fragment>
varying vec4 vLineColor;
void main() {
  #include <logdepthbuf_fragment>
  gl_FragColor = vLineColor;
}`;

const START = new Vector3();
const END = new Vector3();
const ON_LINE = new Vector3();
const ON_RAY = new Vector3();
const LOCAL = new Ray();
const INVERSE = new Matrix4();

export class BillboardLines extends Mesh<InstancedBufferGeometry, ShaderMaterial> {
  private capacity = 0;
  private starts = new Float32Array();
  private ends = new Float32Array();
  private startTangents = new Float32Array();
  private endTangents = new Float32Array();
  private startColors = new Float32Array();
  private endColors = new Float32Array();
  private blended = false;

  constructor(width = 0.03) {
    super(
      new InstancedBufferGeometry(),
      new ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        side: DoubleSide,
        toneMapped: false,
        uniforms: { lineWidth: { value: width } },
      }),
    );
    const corners = new Float32Array([0, -0.5, 0, 1, -0.5, 0, 1, 0.5, 0, 0, 0.5, 0]);
    this.geometry.setAttribute("position", new BufferAttribute(corners, 3)).setIndex([0, 1, 2, 0, 2, 3]);
    this.geometry.instanceCount = 0;
    this.frustumCulled = false;
    this.reserve(16);
  }

  get segments(): number {
    return this.geometry.instanceCount;
  }

  setWidth(metres: number): void {
    const uniform = this.material.uniforms["lineWidth"];
    if (uniform !== undefined) uniform.value = metres;
  }

  get width(): number {
    const width: unknown = this.material.uniforms["lineWidth"]?.value;
    return typeof width === "number" ? width : 0;
  }

  /** Start new lines; then `addSegment` or `addPolyline`, then `finish`. */
  begin(): void {
    this.geometry.instanceCount = 0;
    this.blended = false;
  }

  /** Points three numbers each [m]; colors four each, 0…1. */
  addSegment(
    a: ArrayLike<number>,
    aAt: number,
    b: ArrayLike<number>,
    bAt: number,
    colorA: ArrayLike<number>,
    colorB: ArrayLike<number>,
  ): void {
    const index = this.geometry.instanceCount++;
    if (index >= this.capacity) this.reserve(2 * this.capacity);
    for (let k = 0; k < 3; k++) {
      const [from, to] = [a[aAt + k] ?? 0, b[bAt + k] ?? 0];
      this.starts[3 * index + k] = from;
      this.ends[3 * index + k] = to;
      this.startTangents[3 * index + k] = this.endTangents[3 * index + k] = to - from;
    }
    for (let k = 0; k < 4; k++) {
      this.startColors[4 * index + k] = colorA[k] ?? 1;
      this.endColors[4 * index + k] = colorB[k] ?? 1;
    }
    this.blended ||= (colorA[3] ?? 1) < 0.9998 || (colorB[3] ?? 1) < 0.9998;
  }

  /** Points x y z one after another, in one color or one each; closed: the last is joined to the first. */
  addPolyline(
    points: ArrayLike<number>,
    rgba: ArrayLike<number> | ((point: number) => ArrayLike<number>),
    closed = false,
  ): void {
    const count = Math.floor(points.length / 3);
    const color = typeof rgba === "function" ? rgba : (): ArrayLike<number> => rgba;
    const first = this.geometry.instanceCount;
    for (let k = 0; k + 1 < count; k++) this.addSegment(points, 3 * k, points, 3 * k + 3, color(k), color(k + 1));
    if (closed && count > 2) this.addSegment(points, 3 * (count - 1), points, 0, color(count - 1), color(0));
    const last = this.geometry.instanceCount - 1;
    for (let index = first; index < last; index++) this.joinCorner(index, index + 1);
    if (closed && last > first) this.joinCorner(last, first);
  }

  /** Give the end of a segment and the beginning of the next one edge. */
  private joinCorner(segment: number, next: number): void {
    for (let k = 0; k < 3; k++) {
      const tangent = (this.ends[3 * next + k] ?? 0) - (this.starts[3 * segment + k] ?? 0);
      this.endTangents[3 * segment + k] = this.startTangents[3 * next + k] = tangent;
    }
  }

  finish(): void {
    for (const name of ["segmentStart", "segmentEnd", "startTangent", "endTangent", "startRgba", "endRgba"]) {
      this.geometry.getAttribute(name).needsUpdate = true;
    }
    this.material.transparent = this.blended;
    this.material.depthWrite = !this.blended;
  }

  /** Points of the ray within half the width of a segment. */
  override raycast(raycaster: Raycaster, intersects: Intersection[]): void {
    LOCAL.copy(raycaster.ray).applyMatrix4(INVERSE.copy(this.matrixWorld).invert());
    const reach = (this.width / 2) ** 2;
    for (let index = 0; index < this.segments; index++) {
      const squared = LOCAL.distanceSqToSegment(
        START.fromArray(this.starts, 3 * index),
        END.fromArray(this.ends, 3 * index),
        ON_RAY,
        ON_LINE,
      );
      if (squared > reach) continue;
      const point = ON_RAY.clone().applyMatrix4(this.matrixWorld);
      const distance = raycaster.ray.origin.distanceTo(point);
      if (distance < raycaster.near || distance > raycaster.far) continue;
      intersects.push({ distance, point, object: this, instanceId: index });
    }
  }

  override dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
  }

  private reserve(capacity: number): void {
    const grown = (old: Float32Array, size: number): Float32Array<ArrayBuffer> => {
      const array = new Float32Array(capacity * size);
      array.set(old);
      return array;
    };
    this.geometry.dispose();
    this.starts = grown(this.starts, 3);
    this.ends = grown(this.ends, 3);
    this.startTangents = grown(this.startTangents, 3);
    this.endTangents = grown(this.endTangents, 3);
    this.startColors = grown(this.startColors, 4);
    this.endColors = grown(this.endColors, 4);
    const put = (name: string, array: Float32Array, size: number): void => {
      this.geometry.setAttribute(name, new InstancedBufferAttribute(array, size).setUsage(DynamicDrawUsage));
    };
    put("segmentStart", this.starts, 3);
    put("segmentEnd", this.ends, 3);
    put("startTangent", this.startTangents, 3);
    put("endTangent", this.endTangents, 3);
    put("startRgba", this.startColors, 4);
    put("endRgba", this.endColors, 4);
    this.capacity = capacity;
  }
}
