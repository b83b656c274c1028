/** The ground's grid: thin lines each metre, stronger ones each ten, that fade with the distance. */

import { Color, Mesh, PlaneGeometry, ShaderMaterial, Vector2, type Camera } from "three";

import { NOT_PICKED } from "./picking";

const VERTEX = /* glsl */ `
varying vec2 ground;
void main() {
  vec4 at = modelMatrix * vec4(position, 1.0);
  ground = at.xy;
  gl_Position = projectionMatrix * viewMatrix * at;
}`;

const FRAGMENT = /* glsl */ `
varying vec2 ground;
uniform vec3 color;
uniform float opacity;
uniform vec2 centre;
uniform float reach;
float line(float spacing) {
  vec2 cell = ground / spacing;
  vec2 width = fwidth(cell);
  vec2 off = abs(fract(cell - 0.5) - 0.5) / max(width, vec2(1e-6));
  vec2 dense = clamp(1.5 - 3.0 * width, 0.0, 1.0);
  vec2 share = clamp(1.0 - off, 0.0, 1.0) * dense;
  return max(share.x, share.y);
}
void main() {
  float fade = clamp(1.0 - length(ground - centre) / reach, 0.0, 1.0);
  float share = max(0.55 * line(1.0), line(10.0));
  gl_FragColor = vec4(color, share * fade * opacity);
}`;

export class GroundGrid extends Mesh<PlaneGeometry, ShaderMaterial> {
  private readonly reach = { value: 100 };
  private readonly centre = new Vector2();

  constructor() {
    const uniforms: Record<string, { value: unknown }> = { color: { value: new Color() }, opacity: { value: 0.2 } };
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms,
      transparent: true,
      depthWrite: false,
      side: 2,
      polygonOffset: true,
      polygonOffsetFactor: -1,
      polygonOffsetUnits: -2,
    });
    super(new PlaneGeometry(1, 1), material);
    Object.assign(uniforms, { centre: { value: this.centre }, reach: this.reach });
    this.userData[NOT_PICKED] = true;
    this.renderOrder = -1;
    this.frustumCulled = false;
  }

  /** White lines on a dark background, black ones on a bright one. */
  setBackground(background: Color): void {
    const isDark = 0.2126 * background.r + 0.7152 * background.g + 0.0722 * background.b < 0.2;
    (this.material.uniforms["color"]?.value as Color).set(isDark ? 0xffffff : 0x000000);
  }

  /** Center the grid at the camera, as far as its lines are visible. */
  follow(camera: Camera): void {
    const isOrthographic = "isOrthographicCamera" in camera;
    const reach = isOrthographic ? 1e4 : Math.max(40, 20 * Math.abs(camera.position.z));
    this.position.set(Math.round(camera.position.x), Math.round(camera.position.y), 0);
    this.scale.set(2 * reach, 2 * reach, 1);
    this.centre.set(this.position.x, this.position.y);
    this.reach.value = reach;
  }
}
