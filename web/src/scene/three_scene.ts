/** The 3D view by three.js: a canvas of one or more panes, drawn when something changed. */

import "./conventions";

import { computed, effect, signal } from "@preact/signals";
import {
  AmbientLight,
  Color,
  DirectionalLight,
  Group,
  Scene,
  WebGLRenderer,
  type Object3D,
  type Ray,
  type Vector3,
} from "three";

import { drawingCanvas } from "./drawing_canvas";
import { NO_INSETS, type Area, type Insets } from "./free_area";
import { GroundGrid } from "./ground_grid";
import { LabelSet } from "./label_layer";
import { OffscreenPicture } from "./offscreen_picture";
import { pickBox } from "./box_picking";
import type { Pane } from "./panes/pane";
import { paneAreas, type PaneArea } from "./panes/pane_layout";
import { ScenePanes } from "./panes/scene_panes";
import { Picker, type PictureSize } from "./picking";
import { PictureQuality } from "./picture_quality";
import type { DrawStep, Label, Pick, PictureBox, SceneStatus, SceneView } from "./scene_view";

const NO_WEBGL =
  "This browser has no WebGL 2, so there is no 3D view. Turn on hardware acceleration, or use another browser.";

export class ThreeScene implements SceneView {
  readonly status = signal<SceneStatus>({ kind: "drawing" });
  readonly displays = new Group();
  readonly world = new Group();
  readonly element: HTMLCanvasElement;
  readonly size = signal({ width: 1, height: 1 });
  readonly freeArea = signal<Insets>(NO_INSETS);
  readonly background = signal("#16191c");
  readonly grid = signal(false);

  readonly scene = new Scene();
  private readonly renderer: WebGLRenderer | null;
  private readonly ground = new GroundGrid();
  private readonly headlight = new DirectionalLight(0xffffff, 0.65 * Math.PI);
  private readonly picker = new Picker();
  private readonly labels = new LabelSet(
    () => this.invalidate(),
    (point, camera, reach) => this.picker.isCovered([this.displays, this.world], camera, point, reach),
  );
  readonly panes: ScenePanes;
  readonly camera = computed(() => this.panes.pointed.value.camera.value);
  readonly paneSize = computed(() => this.panes.pointed.value.place.value.area);
  readonly freePart = computed<Area>(() => {
    const { free, place } = this.panes.active.value;
    const { left, top } = place.value.area;
    return { ...free.value, left: left + free.value.left, top: top + free.value.top };
  });
  private readonly ticks = new Set<(elapsed: number) => void>();
  private readonly steps = new Set<DrawStep>();
  private readonly stops: (() => void)[] = [];
  private isChanged = true;
  /** False until the element has a size. */
  private isPlaced = false;
  private last = performance.now();
  private frame = 0;
  /** Pixel ratio of the last picture; 0 before the first. */
  private pixelRatio = 0;
  readonly isSlow: boolean;
  readonly quality: PictureQuality;
  /** Null where drawing does not block the page. */
  private readonly offscreen: OffscreenPicture | null;
  /** Canvas whose size the renderer sets. */
  private readonly sized: HTMLCanvasElement | OffscreenCanvas;

  /** `host`: positioned element that the canvas fills. */
  constructor(private readonly host: HTMLElement) {
    const { element, context, isSlow } = drawingCanvas();
    this.element = element;
    this.isSlow = isSlow;
    this.quality = new PictureQuality(isSlow);
    this.offscreen = isSlow && context !== null ? new OffscreenPicture(context) : null;
    this.sized = this.offscreen?.canvas ?? element;
    this.renderer = this.createRenderer(context);
    this.element.tabIndex = 0;
    this.element.setAttribute("role", "application"); // the 3D view handles keys itself
    this.element.setAttribute("aria-label", "3D view");
    Object.assign(this.element.style, {
      position: "absolute",
      inset: "0",
      width: "100%",
      height: "100%",
      touchAction: "none",
      outline: "none",
    });
    host.append(this.element);
    this.panes = new ScenePanes(host, this.labels, this.size, this.freeArea);
    this.scene.add(
      this.world,
      this.displays,
      this.ground,
      new AmbientLight(0xffffff, 0.35 * Math.PI),
      this.headlight,
      this.headlight.target,
    );
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
    const { pane, left, top } = this.from(x, y);
    return this.picker.pick([this.displays, this.world], pane.camera.peek(), pane.size, x - left, y - top);
  }

  pickBox(box: PictureBox, limit: number): readonly Pick[] {
    const { pane, left, top } = this.from(box.left, box.top);
    const inPane = { left: box.left - left, right: box.right - left, top: box.top - top, bottom: box.bottom - top };
    return pickBox([this.displays, this.world], pane.camera.peek(), pane.size, inPane, limit);
  }

  ray(x: number, y: number): Ray {
    const { pane, left, top } = this.from(x, y);
    return this.picker.ray(pane.camera.peek(), pane.size, x - left, y - top);
  }

  pickGround(x: number, y: number): Vector3 | null {
    const { pane, left, top } = this.from(x, y);
    return this.picker.pickGround(pane.camera.peek(), pane.size, x - left, y - top);
  }

  /** The pane at a point [px], and its corner. */
  private from(x: number, y: number): { readonly pane: Pane; readonly left: number; readonly top: number } {
    const pane = this.panes.at(x, y);
    const { left, top } = pane.place.peek().area;
    return { pane, left, top };
  }

  addLabel(anchor: Object3D, text: string, color?: `--${string}`): Label {
    return this.labels.add(anchor, text, color);
  }

  picture(width: number, height: number): HTMLCanvasElement {
    const picture = Object.assign(document.createElement("canvas"), { width, height });
    const context = picture.getContext("2d");
    if (this.renderer === null || this.status.peek().kind !== "drawing" || context === null)
      throw new Error("Nothing can be drawn now.");
    const ratio = height / this.size.peek().height;
    const size = { width: width / ratio, height: height / ratio };
    const areas = paneAreas(this.panes.layout.peek(), size, NO_INSETS, 0);
    this.quality.isSharp = true;
    this.draw(size, ratio, areas);
    this.show();
    const { drawingBufferWidth, drawingBufferHeight } = this.renderer.getContext();
    context.drawImage(this.element, 0, 0, width, height);
    this.panes.shown.peek().forEach(({ labels }, index) => {
      const area = areas[index]?.area;
      if (area !== undefined)
        context.drawImage(labels.canvas, area.left * ratio, area.top * ratio, area.width * ratio, area.height * ratio);
    });
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
    this.panes.dispose();
    this.element.remove();
  }

  private createRenderer(context: WebGL2RenderingContext | null): WebGLRenderer | null {
    if (context === null) {
      this.status.value = { kind: "unsupported", reason: NO_WEBGL };
      return null;
    }
    const renderer = new WebGLRenderer({ canvas: this.sized, context });
    renderer.debug.checkShaderErrors = import.meta.env.DEV; // reading errors waits until each program is linked
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
      this.hoverLabels(event.buttons === 0 ? this.panes.point(event.offsetX, event.offsetY) : null, event);
    });
    on("pointerleave", () => this.hoverLabels(null));
    this.stops.push(
      () => observer.disconnect(),
      effect(() => {
        this.panes.shown.value; // eslint-disable-line @typescript-eslint/no-unused-expressions -- draws again when the panes change
        this.panes.areas.value; // eslint-disable-line @typescript-eslint/no-unused-expressions -- or their areas
        this.ground.visible = this.grid.value;
        const background = new Color(this.background.value);
        this.ground.setBackground(background);
        this.renderer?.setClearColor(background);
        this.invalidate();
      }),
    );
    this.resize();
  }

  /** Update the hovered label of each pane; `over`: pane under the pointer, or null. */
  private hoverLabels(over: Pane | null, at?: PointerEvent): void {
    for (const pane of this.panes.shown.peek()) {
      const { left, top } = pane.place.peek().area;
      pane.labels.hover(
        pane === over && at !== undefined ? { x: at.offsetX - left, y: at.offsetY - top } : null,
        pane.camera.peek(),
        pane.size,
      );
    }
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
    const { offscreen } = this;
    if (offscreen?.isBegun === true) {
      const isDone = offscreen.isDone();
      if (isDone) this.show();
      if (isDone || !this.quality.isSharp) return; // a change replaces an unfinished sharp picture
    }
    const elapsed = Math.min(1, (now - this.last) / 1000); // no jump after a hidden tab
    this.last = now;
    for (const callback of this.ticks) callback(elapsed);
    if (!this.isPlaced || this.status.peek().kind === "lost") return;
    if (!this.quality.choose(this.isChanged, now)) return;
    this.isChanged = false;
    const size = this.size.peek();
    this.draw(size, this.quality.ratio(size), this.panes.areas.peek());
    if (offscreen === null) this.show();
    else offscreen.begin();
  }

  /** Fit the canvas to a size [px]. */
  private fit({ width, height }: PictureSize, ratio: number): void {
    const { sized } = this;
    const isSame =
      ratio === this.pixelRatio &&
      sized.width === Math.floor(width * ratio) &&
      sized.height === Math.floor(height * ratio);
    if (!isSame && this.renderer !== null) {
      this.renderer.setDrawingBufferSize(width, height, ratio); // one call: each new size waits for the graphics processor
    }
    this.offscreen?.fit(this.quality.samples);
    this.pixelRatio = ratio;
  }

  /** Draw a picture, which `show` displays. */
  private draw(size: PictureSize, ratio: number, areas: readonly PaneArea[]): void {
    this.fit(size, ratio);
    const { renderer } = this;
    const shown = this.panes.shown.peek();
    if (renderer !== null) for (const step of this.steps) step.before?.(renderer);
    for (let i = 0; i < shown.length; i += 1) {
      const pane = shown[i];
      const place = areas[i];
      if (pane !== undefined && place !== undefined) this.drawPane(pane, place, ratio, shown.length > 1 ? size : null);
    }
    if (renderer !== null && shown.length > 1) {
      renderer.setScissorTest(false);
      renderer.setViewport(0, 0, size.width, size.height);
    }
  }

  /** Show the drawn picture, with its labels and axes. */
  private show(): void {
    this.offscreen?.show();
    for (const pane of this.panes.shown.peek()) pane.showOver();
    if (this.renderer !== null) for (const step of this.steps) step.after?.(this.renderer);
  }

  /** Draw a pane, which is a part of a picture of this size; null: it is the whole picture. */
  private drawPane(pane: Pane, place: PaneArea, ratio: number, whole: PictureSize | null): void {
    const { renderer } = this;
    const { area } = place;
    pane.fit(place);
    const camera = pane.camera.peek();
    this.ground.follow(camera);
    this.headlight.position.copy(camera.position);
    camera.getWorldDirection(this.headlight.target.position).add(camera.position);
    if (renderer !== null) {
      if (whole !== null) {
        const bottom = whole.height - area.top - area.height;
        renderer.setViewport(area.left, bottom, area.width, area.height);
        renderer.setScissor(area.left, bottom, area.width, area.height);
        renderer.setScissorTest(true);
      }
      for (const step of this.steps) step.beforePane?.(camera, area.height);
      renderer.render(this.scene, camera);
      for (const step of this.steps) step.afterPane?.(renderer, camera);
    }
    pane.placeOver(area, Math.max(ratio, window.devicePixelRatio)); // names stay sharp where the picture is coarse
  }
}
