/**
 * Outlines of this person's and other people's selections: thin around a model, broad around a link; visible through
 * other objects.
 */

import { effect } from "@preact/signals";
import {
  Box2,
  Box3,
  BufferGeometry,
  Color,
  DoubleSide,
  Float32BufferAttribute,
  Mesh,
  MeshBasicMaterial,
  OrthographicCamera,
  Scene,
  ShaderMaterial,
  Vector2,
  Vector3,
  Vector4,
  WebGLRenderTarget,
  type Camera,
  type Object3D,
  type WebGLRenderer,
} from "three";

import type { SimulatedWorld } from "../simulated_world";
import type { ThreeScene } from "../three_scene";

/** Layer of the first outline's thin part; its broad part has the next one, and each further outline two more. */
const FIRST_LAYER = 2;
/** three.js has 32 layers. */
const MAX_OUTLINED = 15;
/** [px] */
const WIDTHS = [1, 2];
/** Margin of an outline around its object [device px]. */
const MARGIN = 6;

const VERTEX = /* glsl */ `
varying vec2 at;
void main() {
  at = 0.5 * position.xy + 0.5;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

/** Fragment shader: red pixels have a thin outline, green ones a broad outline, just outside. */
const FRAGMENT = /* glsl */ `
varying vec2 at;
uniform sampler2D mask;
uniform vec2 pixel;
uniform vec2 widths;
uniform vec3 color;
void main() {
  vec2 center = texture2D(mask, at).rg;
  vec2 maxima = vec2(0.0);
  for (int i = 0; i < 12; i++) {
    float angle = 6.2831853 * float(i) / 12.0;
    vec2 offset = vec2(cos(angle), sin(angle)) * pixel;
    maxima.r = max(maxima.r, texture2D(mask, at + offset * widths.x).r);
    maxima.g = max(maxima.g, max(texture2D(mask, at + offset * widths.y).g, texture2D(mask, at + 0.5 * offset * widths.y).g));
  }
  vec2 edge = clamp(maxima - center, 0.0, 1.0);
  gl_FragColor = vec4(color, max(edge.r, edge.g));
}`;

/** Bodies with outlines of one color. */
export interface Outlined {
  readonly thin: readonly number[];
  readonly broad: readonly number[];
  /** Token of the color. */
  readonly color: `--${string}`;
}

/** Objects that have outlines of one color. */
interface Marked {
  readonly objects: readonly Object3D[];
  readonly color: string;
  /** Layer of the thin parts. */
  readonly layer: number;
}

const THIN = 0xff0000;
const BROAD = 0xffff00;

export class SelectionOutline {
  private readonly target;
  private readonly fill = new MeshBasicMaterial({ side: DoubleSide, depthTest: false, depthWrite: false });
  private readonly quad = new Scene();
  private readonly quadCamera = new OrthographicCamera();
  private readonly material: ShaderMaterial;
  /** Current viewport: x, y from below, width, height [device px]. */
  private readonly viewport = new Vector4();
  private readonly scissor = new Vector4();
  /** Rectangle of the viewport that holds the outlines being drawn: x, y from below, width, height [device px]. */
  private readonly bounds = new Vector4();
  private readonly clear = new Color();
  private readonly box = new Box3();
  private readonly rectangle = new Box2();
  private readonly whole = new Box2();
  private readonly corner = new Vector3();
  private readonly at = new Vector2();
  /** Live style of the element. */
  private readonly style: CSSStyleDeclaration;
  private marked: readonly Marked[] = [];
  private readonly stops: (() => void)[];

  /** `outlined` is called again when a signal that it reads changes; the last outline lies on top. */
  constructor(
    private readonly scene: ThreeScene,
    world: SimulatedWorld,
    outlined: () => readonly Outlined[],
  ) {
    this.style = getComputedStyle(scene.element);
    this.target = new WebGLRenderTarget(1, 1, { samples: scene.quality.samples });
    const uniforms = {
      mask: { value: this.target.texture },
      pixel: { value: new Vector2() },
      widths: { value: new Vector2() },
      color: { value: new Color() },
    };
    this.material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms,
      transparent: true,
      depthTest: false,
      depthWrite: false,
    });
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
    const triangle = new Mesh(geometry, this.material);
    triangle.frustumCulled = false;
    this.quad.add(triangle);
    this.stops = [
      scene.addStep({ afterPane: (renderer, camera) => this.draw(renderer, camera) }),
      effect(() => {
        world.progress.value; // eslint-disable-line @typescript-eslint/no-unused-expressions -- also outlines models that are loaded later
        this.mark(world, outlined());
      }),
    ];
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    this.target.dispose();
    this.material.dispose();
  }

  private mark(world: SimulatedWorld, outlined: readonly Outlined[]): void {
    const everywhere = (object: Object3D, act: (part: Object3D) => void): void => {
      object.traverse(act);
      this.scene.invalidate();
    };
    for (const { objects, layer } of this.marked) {
      for (const object of objects) {
        everywhere(object, ({ layers }) => {
          layers.disable(layer);
          layers.disable(layer + 1);
        });
      }
    }
    const marked = outlined.slice(-MAX_OUTLINED).map(({ thin, broad, color }, index): Marked => {
      const layer = FIRST_LAYER + 2 * index;
      const objects: Object3D[] = [];
      for (const [bodies, part] of [
        [thin, layer],
        [broad, layer + 1],
      ] as const) {
        for (const body of bodies) {
          const object = world.object(body);
          if (object === null) continue;
          everywhere(object, ({ layers }) => layers.enable(part));
          objects.push(object);
        }
      }
      return { objects, color, layer };
    });
    this.marked = marked.filter(({ objects }) => objects.length > 0);
  }

  private draw(renderer: WebGLRenderer, camera: Camera): void {
    if (this.marked.length === 0) return;
    const { z: width, w: height } = renderer.getCurrentViewport(this.viewport);
    const { samples } = this.scene.quality;
    if (this.target.samples !== samples) {
      this.target.samples = samples;
      this.target.dispose();
    }
    if (this.target.width !== width || this.target.height !== height) this.target.setSize(width, height);
    renderer.getScissor(this.scissor);
    const isScissored = renderer.getScissorTest();
    const { mask: layers } = camera.layers;
    const alpha = renderer.getClearAlpha();
    renderer.getClearColor(this.clear);
    this.target.scissorTest = true;
    for (const marked of this.marked) {
      this.findBounds(camera, marked.objects);
      renderer.setClearColor(0x000000, 0);
      this.drawMask(renderer, camera, marked.layer);
      camera.layers.mask = layers;
      renderer.setClearColor(this.clear, alpha);
      this.drawEdges(renderer, marked.color);
      renderer.setScissor(this.scissor);
      renderer.setScissorTest(isScissored);
    }
  }

  /** Draw the outlined objects into the mask. */
  private drawMask(renderer: WebGLRenderer, camera: Camera, layer: number): void {
    const { bounds } = this;
    this.target.scissor.set(bounds.x - MARGIN, bounds.y - MARGIN, bounds.z + 2 * MARGIN, bounds.w + 2 * MARGIN);
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.autoClear = false;
    this.scene.scene.overrideMaterial = this.fill;
    this.drawPart(renderer, camera, layer, THIN);
    this.drawPart(renderer, camera, layer + 1, BROAD);
    this.scene.scene.overrideMaterial = null;
    renderer.setRenderTarget(null);
  }

  private drawPart(renderer: WebGLRenderer, camera: Camera, layer: number, color: number): void {
    camera.layers.set(layer);
    this.fill.color.set(color);
    renderer.render(this.scene.scene, camera);
  }

  /** Draw the outlines of the mask over the picture. */
  private drawEdges(renderer: WebGLRenderer, token: string): void {
    const { bounds } = this;
    const ratio = renderer.getPixelRatio();
    this.setUniforms(ratio, token);
    bounds.x += this.viewport.x;
    bounds.y += this.viewport.y;
    renderer.setScissor(bounds.divideScalar(ratio));
    renderer.setScissorTest(true);
    renderer.render(this.quad, this.quadCamera);
    renderer.autoClear = true;
  }

  /** Find the rectangle of the viewport that holds the outlines. */
  private findBounds(camera: Camera, objects: readonly Object3D[]): void {
    const { bounds, box, corner, rectangle } = this;
    box.makeEmpty();
    for (const object of objects) box.expandByObject(object);
    const { z: width, w: height } = this.viewport;
    rectangle.makeEmpty();
    for (let i = 0; i < 8 && !box.isEmpty(); i += 1) {
      corner.set(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z);
      if (corner.applyMatrix4(camera.matrixWorldInverse).z > -1e-3) {
        bounds.set(0, 0, width, height); // a corner is beside or behind the camera
        return;
      }
      corner.applyMatrix4(camera.projectionMatrix);
      rectangle.expandByPoint(this.at.set((0.5 + corner.x / 2) * width, (0.5 + corner.y / 2) * height));
    }
    this.whole.min.set(0, 0);
    this.whole.max.set(width, height);
    rectangle.expandByScalar(MARGIN).intersect(this.whole);
    const { min, max } = rectangle;
    if (rectangle.isEmpty()) bounds.set(0, 0, 0, 0);
    else bounds.set(Math.floor(min.x), Math.floor(min.y), Math.ceil(max.x - min.x) + 1, Math.ceil(max.y - min.y) + 1);
  }

  private setUniforms(ratio: number, token: string): void {
    const { pixel, widths, color } = this.material.uniforms;
    (pixel?.value as Vector2).set(1 / this.viewport.z, 1 / this.viewport.w);
    (widths?.value as Vector2).fromArray(WIDTHS).multiplyScalar(ratio);
    const shown = this.style.getPropertyValue(token).trim() || "#3fbed0";
    (color?.value as Color).set(shown).convertLinearToSRGB();
  }
}
