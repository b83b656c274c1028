/** Squares in metres that face the viewer: one draw call for all. */

import {
  BufferAttribute,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Matrix4,
  Mesh,
  Ray,
  ShaderMaterial,
  Vector2,
  Vector3,
  type Intersection,
  type Raycaster,
} from "three";

const VERTEX = /* glsl */ `
#include <common>
#include <logdepthbuf_pars_vertex>
attribute vec3 center;
attribute vec4 centerRgba;
uniform vec2 pointSize;
varying vec4 vPointColor;
void main() {
  vec4 mvPosition = modelViewMatrix * vec4(center, 1.0);
  // rviz's squares face the viewer with an edge along the frame's y axis
  vec3 back = isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(-mvPosition.xyz);
  vec3 up = modelViewMatrix[1].xyz;
  up = normalize(up - back * dot(up, back));
  mvPosition.xyz += cross(up, back) * (position.x * pointSize.x) + up * (position.y * pointSize.y);
  vPointColor = centerRgba;
  gl_Position = projectionMatrix * mvPosition;
  #include <logdepthbuf_vertex>
}`;

const FRAGMENT = /* glsl */ `
#include <common>
#include <logdepthbuf_pars_fragment>
varying vec4 vPointColor;
void main() {
  #include <logdepthbuf_fragment>
  gl_FragColor = vPointColor;
}`;

const CENTER = new Vector3();
const LOCAL = new Ray();
const INVERSE = new Matrix4();

export class BillboardPoints extends Mesh<InstancedBufferGeometry, ShaderMaterial> {
  private readonly size: Vector2;

  /** Centres x y z one after another [m], colors r g b a 0…1; width and height [m]. */
  constructor(
    private readonly centers: Float32Array<ArrayBuffer>,
    rgba: Float32Array<ArrayBuffer>,
    width: number,
    height: number,
  ) {
    const size = new Vector2(width, height);
    let blended = false;
    for (let alpha = 3; alpha < rgba.length; alpha += 4) blended ||= (rgba[alpha] ?? 1) < 0.9998;
    super(
      new InstancedBufferGeometry(),
      new ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        toneMapped: false,
        transparent: blended,
        depthWrite: !blended,
        uniforms: { pointSize: { value: size } },
      }),
    );
    this.size = size;
    const corners = new Float32Array([-0.5, -0.5, 0, 0.5, -0.5, 0, 0.5, 0.5, 0, -0.5, 0.5, 0]);
    this.geometry.setAttribute("position", new BufferAttribute(corners, 3)).setIndex([0, 1, 2, 0, 2, 3]);
    this.geometry.setAttribute("center", new InstancedBufferAttribute(centers, 3));
    this.geometry.setAttribute("centerRgba", new InstancedBufferAttribute(rgba, 4));
    this.geometry.instanceCount = centers.length / 3;
    this.frustumCulled = false;
  }

  override raycast(raycaster: Raycaster, intersects: Intersection[]): void {
    LOCAL.copy(raycaster.ray).applyMatrix4(INVERSE.copy(this.matrixWorld).invert());
    const reach = (Math.max(this.size.x, this.size.y) / 2) ** 2;
    for (let index = 0; index < this.geometry.instanceCount; index++) {
      CENTER.fromArray(this.centers, 3 * index);
      if (LOCAL.distanceSqToPoint(CENTER) > reach) continue;
      const point = CENTER.clone().applyMatrix4(this.matrixWorld);
      const distance = raycaster.ray.origin.distanceTo(point);
      if (distance >= raycaster.near && distance <= raycaster.far)
        intersects.push({ distance, point, object: this, instanceId: index });
    }
  }

  override dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
  }
}
