/** A part of the scene with a camera, labels and axes of its own. */

import { computed, effect, signal, type ReadonlySignal } from "@preact/signals";
import { Matrix4, PerspectiveCamera, type OrthographicCamera } from "three";

import { centreOn, freeArea, type Area } from "../free_area";
import { LabelLayer, type LabelSet } from "../label_layer";
import type { PictureSize } from "../picking";
import type { SixSides } from "../view_controller";
import { ViewAxes } from "../view_axes";
import type { PaneArea } from "./pane_layout";

const AXES_GAP = 8;

export class Pane {
  readonly camera = signal<PerspectiveCamera | OrthographicCamera>(new PerspectiveCamera());
  readonly place = signal<PaneArea>({
    area: { left: 0, top: 0, width: 1, height: 1 },
    insets: { left: 0, right: 0, top: 0, bottom: 0 },
  });
  /** The part that no panel covers, within the pane [px]. */
  readonly free: ReadonlySignal<Area> = computed(() => {
    const { area, insets } = this.place.value;
    return freeArea(area.width, area.height, insets);
  });
  readonly labels: LabelLayer;
  /** Called when an end of the view axes is pressed. */
  onSide: (side: SixSides) => void = () => undefined;
  private readonly axes = new ViewAxes((side) => this.onSide(side));
  /** Inverse of the camera's pose in the last picture. */
  private readonly drawn = new Matrix4();
  private readonly stop: () => void;

  constructor(host: HTMLElement, labels: LabelSet) {
    this.labels = new LabelLayer(labels);
    host.append(this.labels.canvas, this.axes.element);
    this.stop = effect(() => this.putElements(this.place.value));
  }

  dispose(): void {
    this.stop();
    for (const element of [this.labels.canvas, this.axes.element]) element.remove();
  }

  get size(): PictureSize {
    return this.place.peek().area;
  }

  set isShown(isShown: boolean) {
    for (const { style } of [this.labels.canvas, this.axes.element]) style.display = isShown ? "" : "none";
  }

  /** Fit the camera to an area. */
  fit({ area: { width, height }, insets }: PaneArea): void {
    const camera = this.camera.peek();
    if ("aspect" in camera) camera.aspect = width / height;
    else Object.assign(camera, { left: (camera.bottom * width) / height, right: (camera.top * width) / height });
    centreOn(freeArea(width, height, insets), camera, width, height);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }

  /** Lay out labels and axes for the picture being drawn. */
  placeOver(size: PictureSize, pixelRatio: number): void {
    const camera = this.camera.peek();
    this.labels.place(camera, size, this.free.peek(), pixelRatio);
    this.drawn.copy(camera.matrixWorldInverse);
  }

  /** Show labels and axes where they were placed. */
  showOver(): void {
    this.labels.show();
    this.axes.show(this.drawn);
  }

  private putElements({ area: { left, top, width, height }, insets }: PaneArea): void {
    const px = (value: number): string => `${value}px`;
    Object.assign(this.labels.canvas.style, { left: px(left), top: px(top), width: px(width), height: px(height) });
    const { size } = ViewAxes;
    Object.assign(this.axes.element.style, {
      left: px(left + width - insets.right - AXES_GAP - size),
      top: px(top + insets.top + AXES_GAP),
    });
  }
}
