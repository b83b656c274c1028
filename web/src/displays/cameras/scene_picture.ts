/** Pictures of the displays by another camera, on a transparent background. */

import {
  Color,
  PerspectiveCamera,
  WebGLRenderTarget,
  type Light,
  type Matrix4,
  type Object3D,
  type WebGLRenderer,
} from "three";

import type { Transform } from "../../frames/transform";
import type { Size } from "./camera_projection";

export class ScenePicture {
  /** Last picture. */
  readonly canvas = document.createElement("canvas");
  private readonly target = new WebGLRenderTarget(1, 1, { samples: 4 });
  private readonly camera = new PerspectiveCamera();
  private readonly clearColor = new Color();

  /** Draw `displays` except `without`; the simulated world and the ground are left out, as the picture shows them. */
  draw(
    renderer: WebGLRenderer,
    displays: Object3D,
    size: Size,
    matrix: Matrix4,
    pose: Transform,
    without: readonly Object3D[],
  ): void {
    const scene = displays.parent;
    if (scene === null) return;
    this.camera.position.copy(pose.position);
    this.camera.quaternion.copy(pose.orientation);
    this.camera.projectionMatrix.copy(matrix);
    this.camera.projectionMatrixInverse.copy(matrix).invert();
    this.camera.updateMatrixWorld();
    this.target.setSize(size.width, size.height);
    const others = scene.children.filter((child) => child !== displays && !isLight(child));
    const hidden = [...others, ...without].filter((object) => object.visible);
    for (const child of hidden) child.visible = false;
    const [target, alpha] = [renderer.getRenderTarget(), renderer.getClearAlpha()];
    renderer.getClearColor(this.clearColor);
    try {
      renderer.setRenderTarget(this.target);
      renderer.setClearColor(0, 0);
      renderer.clear();
      renderer.render(scene, this.camera);
      this.read(renderer, size);
    } finally {
      renderer.setRenderTarget(target);
      renderer.setClearColor(this.clearColor, alpha);
      for (const child of hidden) child.visible = true;
    }
  }

  dispose(): void {
    this.target.dispose();
  }

  private read(renderer: WebGLRenderer, { width, height }: Size): void {
    const bytes = new Uint8Array(width * height * 4);
    renderer.readRenderTargetPixels(this.target, 0, 0, width, height, bytes);
    Object.assign(this.canvas, { width, height });
    this.canvas.getContext("2d")?.putImageData(new ImageData(upright(bytes, width, height), width, height), 0, 0);
  }
}

function isLight(object: Object3D): boolean {
  return (object as Partial<Light>).isLight === true;
}

/** Pixels for a canvas: rows from the top, and colors that are not premultiplied by alpha. */
export function upright(bytes: Uint8Array, width: number, height: number): Uint8ClampedArray<ArrayBuffer> {
  const turned = new Uint8ClampedArray(bytes.length);
  for (let y = 0; y < height; y++)
    turned.set(bytes.subarray((height - 1 - y) * width * 4, (height - y) * width * 4), y * width * 4);
  for (let at = 3; at < turned.length; at += 4) {
    const alpha = turned[at] ?? 0;
    if (alpha === 0 || alpha === 255) continue;
    for (let part = at - 3; part < at; part++) turned[part] = ((turned[part] ?? 0) * 255) / alpha;
  }
  return turned;
}
