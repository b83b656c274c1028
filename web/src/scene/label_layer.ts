/** Labels of the scene, which each pane draws on a canvas over its picture. */

import { Vector3, type Camera, type Object3D } from "three";

import { BAND, layoutLabels, type LabelBox, type LabelRequest, type PlacedLabel } from "./label_layout";
import { toPicture, type PictureSize } from "./picking";
import type { Label } from "./scene_view";

/** Distance to an anchor at which its label counts as hovered [px]. */
const NEAR = 14;
const SIZE = 12;
const PADDING = 8;

class SceneLabel implements Label {
  detail = "";
  private shown: string;

  constructor(
    readonly anchor: Object3D,
    text: string,
    private readonly set: LabelSet,
    readonly colour?: string,
  ) {
    this.shown = text;
  }

  get text(): string {
    return this.shown;
  }

  set text(text: string) {
    if (text === this.shown) return;
    this.shown = text;
    this.set.onChange();
  }

  remove(): void {
    this.set.remove(this);
  }
}

interface Seen {
  readonly label: SceneLabel;
  readonly request: LabelRequest;
}

export class LabelSet {
  readonly labels = new Set<SceneLabel>();

  /** `onChange`: the picture is to be drawn again. */
  constructor(readonly onChange: () => void) {}

  add(anchor: Object3D, text: string, colour?: string): Label {
    const label = new SceneLabel(anchor, text, this, colour);
    this.labels.add(label);
    this.onChange();
    return label;
  }

  remove(label: SceneLabel): void {
    if (this.labels.delete(label)) this.onChange();
  }
}

export class LabelLayer {
  readonly canvas = document.createElement("canvas");
  private readonly corners = new WeakMap<SceneLabel, number>();
  private readonly point = new Vector3();
  private pointer: { readonly x: number; readonly y: number } | null = null;
  private hovered: SceneLabel | null = null;
  private boxes = new Map<SceneLabel, LabelBox>();

  constructor(private readonly set: LabelSet) {
    Object.assign(this.canvas.style, { position: "absolute", pointerEvents: "none" });
  }

  /** The pointer is at a point of the picture [px], or has left it. */
  hover(at: { readonly x: number; readonly y: number } | null, camera: Camera, size: PictureSize): void {
    this.pointer = at;
    const hovered = this.findHovered(camera, size);
    if (hovered === this.hovered) return;
    this.hovered = hovered;
    this.set.onChange();
  }

  draw(camera: Camera, size: PictureSize, pixelRatio: number): void {
    const context = this.canvas.getContext("2d");
    if (context === null) return;
    const [width, height] = [Math.round(size.width * pixelRatio), Math.round(size.height * pixelRatio)];
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    context.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    context.clearRect(0, 0, size.width, size.height);
    if (this.set.labels.size === 0) return;
    const style = getComputedStyle(this.canvas);
    const font = style.getPropertyValue("--font") || "sans-serif";
    context.font = `${SIZE}px ${font}`;
    const seen = this.findSeen(camera, size, context, font);
    const placed = layoutLabels(seen.map(({ request }) => request), size.width, size.height);
    for (const { label } of seen) this.corners.delete(label);
    this.boxes = new Map();
    for (const place of placed) this.drawLabel(context, style, font, seen, place);
  }

  private drawLabel(
    context: CanvasRenderingContext2D, style: CSSStyleDeclaration, font: string, seen: readonly Seen[], { index, box, corner }: PlacedLabel,
  ): void {
    const entry = seen[index];
    if (entry === undefined) return;
    const { label, request } = entry;
    this.corners.set(label, corner);
    this.boxes.set(label, box);
    const colour = (token: string): string => style.getPropertyValue(token).trim() || "#888";
    drawLeader(context, request, box, colour(label.colour ?? (request.hovered ? "--accent" : "--text-3")));
    context.textBaseline = "middle";
    const middle = box.y + box.height / 2 + 0.5;
    if (label.colour !== undefined) {
      context.fillStyle = colour(label.colour);
      context.beginPath();
      context.roundRect(box.x, box.y + 1, box.width, box.height - 2, 4);
      context.fill();
      context.font = `600 ${SIZE}px ${font}`;
      context.fillStyle = colour("--on-person");
      context.fillText(label.text, box.x + PADDING, middle);
      context.font = `${SIZE}px ${font}`;
      return;
    }
    if (request.hovered) {
      context.fillStyle = colour("--panel");
      context.strokeStyle = colour("--accent");
      context.beginPath();
      context.roundRect(box.x, box.y - 2, box.width, box.height + 4, 4);
      context.fill();
      context.stroke();
      context.font = `600 ${SIZE}px ${font}`;
      context.fillStyle = colour("--text");
      context.fillText(label.text, box.x + PADDING, middle);
      const end = box.x + PADDING + context.measureText(label.text).width + PADDING;
      context.font = `${SIZE}px ${font}`;
      context.fillStyle = colour("--text-2");
      context.fillText(label.detail, end, middle);
      return;
    }
    context.lineWidth = 3;
    context.lineJoin = "round";
    context.strokeStyle = colour("--scene");
    context.strokeText(label.text, box.x + 2, middle);
    context.fillStyle = colour("--text");
    context.fillText(label.text, box.x + 2, middle);
  }

  private findSeen(camera: Camera, size: PictureSize, context: CanvasRenderingContext2D, font: string): Seen[] {
    const seen: Seen[] = [];
    for (const label of this.set.labels) {
      if (!isShown(label.anchor)) continue;
      const at = toPicture(label.anchor.getWorldPosition(this.point), camera, size);
      if (at === null || at.x < 0 || at.y < 0 || at.x > size.width || at.y > size.height) continue;
      const hovered = label === this.hovered;
      const isBoxed = hovered || label.colour !== undefined;
      if (isBoxed) context.font = `600 ${SIZE}px ${font}`;
      let width = context.measureText(label.text).width + 4;
      context.font = `${SIZE}px ${font}`;
      if (isBoxed) width += 2 * PADDING - 4;
      if (hovered) width += 4 + (label.detail === "" ? 0 : context.measureText(label.detail).width + PADDING);
      seen.push({ label, request: { x: at.x, y: at.y, width, distance: at.z, hovered: isBoxed, corner: this.corners.get(label) ?? -1 } });
    }
    return seen;
  }

  private findHovered(camera: Camera, size: PictureSize): SceneLabel | null {
    if (this.pointer === null) return null;
    const { x, y } = this.pointer;
    let best: SceneLabel | null = null;
    let nearest = NEAR;
    for (const label of this.set.labels) {
      const box = this.boxes.get(label);
      if (box !== undefined && x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + BAND) return label;
      if (!isShown(label.anchor)) continue;
      const at = toPicture(label.anchor.getWorldPosition(this.point), camera, size);
      const distance = at === null ? Infinity : Math.hypot(at.x - x, at.y - y);
      if (distance < nearest) [best, nearest] = [label, distance];
    }
    return best;
  }
}

function drawLeader(context: CanvasRenderingContext2D, from: LabelRequest, box: LabelBox, colour: string): void {
  const end = box.x > from.x ? box.x : box.x + box.width;
  context.strokeStyle = colour;
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(end, box.y + box.height / 2);
  context.stroke();
}

function isShown(object: Object3D): boolean {
  for (let at: Object3D | null = object; at !== null; at = at.parent) if (!at.visible) return false;
  return true;
}
