/** The 3D view by three.js: a canvas that is drawn when something changed. */

import "./conventions";

import { effect, signal } from "@preact/signals";
import {
  AmbientLight, Color, DirectionalLight, Group, PerspectiveCamera, Scene, WebGLRenderer, type Object3D, type OrthographicCamera, type Ray,
  type Vector3,
} from "three";

import { drawsOnCpu } from "./draws_on_cpu";
import { centreOn, freeArea, NO_INSETS } from "./free_area";
import { GroundGrid } from "./ground_grid";
import { LabelLayer } from "./label_layer";
import { pickBox } from "./box_picking";
import { Picker, type PictureSize } from "./picking";
import type { DrawStep, Insets, Label, Pick, PictureBox, SceneStatus, SceneView } from "./scene_view";
import { ViewAxes } from "./view_axes";
import type { SixSides } from "./view_controller";

/** Most device pixels per pixel, and in the whole picture. */
const MAX_PIXEL_RATIO = 2;
const MAX_PIXELS = 5e6;
/** Most device pixels where the CPU draws. */
const MAX_SLOW_PIXELS = 1e6;
const AXES_GAP = 8;

const NO_WEBGL = "This browser has no WebGL 2, so there is no 3D view. Turn on hardware acceleration, or use another browser.";

export class ThreeScene implements SceneView {
  readonly status = signal<SceneStatus>({ kind: "drawing" });
  readonly displays = new Group();
  readonly world = new Group();
  readonly camera = signal<PerspectiveCamera | OrthographicCamera>(new PerspectiveCamera());
  readonly element = document.createElement("canvas");
  readonly size = signal({ width: 1, height: 1 });
  readonly freeArea = signal<Insets>(NO_INSETS);
  readonly background = signal("#16191c");
  readonly grid = signal(false);
  /** A side of the view axes was pressed. */
  onSide: (side: SixSides) => void = () => undefined;

  readonly scene = new Scene();
  private readonly renderer: WebGLRenderer | null;
  private readonly ground = new GroundGrid();
  private readonly headlight = new DirectionalLight(0xffffff, 0.65 * Math.PI);
  private readonly picker = new Picker();
  private readonly labels = new LabelLayer(() => this.invalidate());
  private readonly axes = new ViewAxes((side) => this.onSide(side));
  private readonly ticks = new Set<(elapsed: number) => void>();
  private readonly steps = new Set<DrawStep>();
  private readonly stops: (() => void)[] = [];
  private isChanged = true;
  /** False until its element has a size. */
  private isPlaced = false;
  private last = performance.now();
  private frame = 0;
  private pixelRatio = 1;
  /** True where the browser draws on the CPU: edges are not smoothed then. */
  readonly isSlow = drawsOnCpu();

  /** Fills `host`, which is positioned. */
  constructor(private readonly host: HTMLElement) {
    this.renderer = this.createRenderer();
    this.element.tabIndex = 0;
    this.element.setAttribute("aria-label", "3D view");
    Object.assign(this.element.style, { position: "absolute", inset: "0", width: "100%", height: "100%", touchAction: "none", outline: "none" });
    host.append(this.element, this.labels.canvas, this.axes.element);
    this.scene.add(this.world, this.displays, this.ground, new AmbientLight(0xffffff, 0.35 * Math.PI), this.headlight, this.headlight.target);
    this.listen();
    this.frame = requestAnimationFrame((now) => this.tick(now));
  }

  invalidate(): void {
    this.isChanged = true;
  }

  onTick(callback: (elapsed: number) => void): () => void {
    this.ticks.add(callback);
    return () => this.ticks.delete(callback);
  }

  addStep(step: DrawStep): () => void {
    this.steps.add(step);
    this.invalidate();
    return () => {
      this.steps.delete(step);
      this.invalidate();
    };
  }

  pick(x: number, y: number): Pick | null {
    return this.picker.pick([this.displays, this.world], this.camera.peek(), this.size.peek(), x, y);
  }

  pickBox(box: PictureBox, limit: number): readonly Pick[] {
    return pickBox([this.displays, this.world], this.camera.peek(), this.size.peek(), box, limit);
  }

  ray(x: number, y: number): Ray {
    return this.picker.ray(this.camera.peek(), this.size.peek(), x, y);
  }

  pickGround(x: number, y: number): Vector3 | null {
    return this.picker.pickGround(this.camera.peek(), this.size.peek(), x, y);
  }

  addLabel(anchor: Object3D, text: string, colour?: `--${string}`): Label {
    return this.labels.add(anchor, text, colour);
  }

  picture(width: number, height: number): HTMLCanvasElement {
    const picture = Object.assign(document.createElement("canvas"), { width, height });
    const context = picture.getContext("2d");
    if (this.renderer === null || this.status.peek().kind !== "drawing" || context === null) throw new Error("Nothing can be drawn now.");
    const ratio = height / this.size.peek().height;
    this.draw({ width: width / ratio, height: height / ratio }, ratio, NO_INSETS);
    const { drawingBufferWidth, drawingBufferHeight } = this.renderer.getContext();
    for (const canvas of [this.element, this.labels.canvas]) context.drawImage(canvas, 0, 0, width, height);
    this.invalidate();
    if (drawingBufferWidth < width - 1 || drawingBufferHeight < height - 1) {
      throw new Error(`This browser draws at most ${drawingBufferWidth} × ${drawingBufferHeight} pixels of it.`);
    }
    return picture;
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    for (const stop of this.stops) stop();
    this.renderer?.dispose();
    for (const element of [this.element, this.labels.canvas, this.axes.element]) element.remove();
  }

  private createRenderer(): WebGLRenderer | null {
    const context = this.element.getContext("webgl2", { powerPreference: "high-performance", antialias: !this.isSlow });
    if (context === null) {
      this.status.value = { kind: "unsupported", reason: NO_WEBGL };
      return null;
    }
    const renderer = new WebGLRenderer({ canvas: this.element, context });
    renderer.debug.checkShaderErrors = import.meta.env.DEV; // asking for them waits until each program is linked
    return renderer;
  }

  private listen(): void {
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(this.host);
    const on = (name: string, act: (event: Event) => void): void => {
      this.element.addEventListener(name, act);
      this.stops.push(() => this.element.removeEventListener(name, act));
    };
    on("webglcontextlost", (event) => {
      event.preventDefault();
      this.status.value = { kind: "lost" };
    });
    on("webglcontextrestored", () => {
      this.status.value = { kind: "drawing" };
      this.invalidate();
    });
    on("pointermove", (event) => {
      if (!(event instanceof PointerEvent)) return;
      const at = event.buttons === 0 ? { x: event.offsetX, y: event.offsetY } : null;
      this.labels.hover(at, this.camera.peek(), this.size.peek());
    });
    on("pointerleave", () => this.labels.hover(null, this.camera.peek(), this.size.peek()));
    this.stops.push(
      () => observer.disconnect(),
      effect(() => {
        const { right, top } = this.freeArea.value;
        Object.assign(this.axes.element.style, { right: `${right + AXES_GAP}px`, top: `${top + AXES_GAP}px` });
        this.ground.visible = this.grid.value;
        const background = new Color(this.background.value);
        this.ground.setBackground(background);
        this.renderer?.setClearColor(background);
        this.invalidate();
      }),
      this.camera.subscribe(() => this.invalidate()),
    );
    this.resize();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.isPlaced = true;
    this.size.value = { width, height };
    this.invalidate();
  }

  private tick(now: number): void {
    this.frame = requestAnimationFrame((next) => this.tick(next));
    const elapsed = Math.min(0.25, (now - this.last) / 1000);
    this.last = now;
    for (const callback of this.ticks) callback(elapsed);
    if (!this.isChanged || !this.isPlaced || this.status.peek().kind === "lost") return;
    this.isChanged = false;
    this.draw(this.size.peek(), this.ratio, this.freeArea.peek());
  }

  /** Device pixels per pixel of the element. */
  private get ratio(): number {
    const { width, height } = this.size.peek();
    const most = this.isSlow ? MAX_SLOW_PIXELS : MAX_PIXELS;
    return Math.min(window.devicePixelRatio, MAX_PIXEL_RATIO, Math.sqrt(most / (width * height)));
  }

  /** Fit canvas and camera to a size [px]. */
  private fit({ width, height }: PictureSize, ratio: number, insets: Insets): void {
    const isSame = ratio === this.pixelRatio && this.element.width === Math.floor(width * ratio) && this.element.height === Math.floor(height * ratio);
    if (!isSame && this.renderer !== null) {
      this.renderer.setDrawingBufferSize(width, height, ratio); // at once: each new size waits for the graphics processor
    }
    this.pixelRatio = ratio;
    const camera = this.camera.peek();
    if ("aspect" in camera) camera.aspect = width / height;
    else Object.assign(camera, { left: (camera.bottom * width) / height, right: (camera.top * width) / height });
    centreOn(freeArea(width, height, insets), camera, width, height);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }

  private draw(size: PictureSize, ratio: number, insets: Insets): void {
    this.fit(size, ratio, insets);
    const camera = this.camera.peek();
    this.ground.follow(camera);
    this.headlight.position.copy(camera.position);
    camera.getWorldDirection(this.headlight.target.position).add(camera.position);
    if (this.renderer !== null) {
      for (const step of this.steps) step.before?.(this.renderer, camera);
      this.renderer.render(this.scene, camera);
      for (const step of this.steps) step.after?.(this.renderer, camera);
    }
    this.labels.draw(camera, size, ratio);
    this.axes.draw(camera);
  }
}
