/** Gazebo's sky as Trundle's renderer draws it: from the horizon's color to the zenith's (cpp/render/kernel.cc). */

import { BufferGeometry, Float32BufferAttribute, Mesh, ShaderMaterial, Vector3 } from "three";

import { NOT_PICKED } from "../picking";

const HORIZON = new Vector3(0.86, 0.91, 0.96);
const ZENITH = new Vector3(0.3, 0.52, 0.82);

const VERTEX = /* glsl */ `
varying vec3 ray;
void main() {
  vec4 far = inverse(projectionMatrix) * vec4(position.xy, 1.0, 1.0);
  ray = transpose(mat3(viewMatrix)) * (isOrthographic ? vec3(0.0, 0.0, -1.0) : far.xyz / far.w);
  gl_Position = vec4(position.xy, 1.0, 1.0);
}`;

const FRAGMENT = /* glsl */ `
varying vec3 ray;
uniform vec3 horizon;
uniform vec3 zenith;
uniform vec3 up;
void main() {
  gl_FragColor = vec4(mix(horizon, zenith, sqrt(max(dot(normalize(ray), up), 0.0))), 1.0);
}`;

/** A triangle that covers the picture, behind everything. */
export class Sky extends Mesh<BufferGeometry, ShaderMaterial> {
  constructor() {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
    const uniforms = { horizon: { value: HORIZON }, zenith: { value: ZENITH }, up: { value: new Vector3(0, 0, 1) } };
    super(
      geometry,
      new ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        uniforms,
        depthTest: false,
        depthWrite: false,
      }),
    );
    this.userData[NOT_PICKED] = true;
    this.frustumCulled = false;
    this.renderOrder = -1000;
    this.onBeforeRender = () => {
      (this.material.uniforms["up"]?.value as Vector3).setFromMatrixColumn(this.matrixWorld, 2).normalize();
    };
  }
}
