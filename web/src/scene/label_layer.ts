/** Labels of the scene, which each pane draws on a canvas over its picture. */

import { Vector3, type Camera, type Object3D } from "three";

import type { Area } from "./free_area";
import { BAND, layoutLabels, type LabelRequest } from "./label_layout";
import { toPicture, type PictureSize } from "./picking";
import type { Label } from "./scene_view";

/** Distance to an anchor at which its label counts as hovered [px]. */
const NEAR = 14;
const SIZE = 12;
const PADDING = 8;

/** Pause between two checks whether an anchor is covered [ms]. */
const LOOK_AGAIN = 300;

class SceneLabel implements Label {
  detail = "";
  full = "";
  rank: number | null = null;
  isQuiet = false;
  reach = 0;
  private shown: string;

  constructor(
    readonly anchor: Object3D,
    text: string,
    private readonly set: LabelSet,
    readonly color?: string,
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

/** Label with its layout in a layer. */
interface VisibleLabel extends LabelRequest {
  readonly label: SceneLabel;
  /** Text and detail of the measured width. */
  measured: string;
  measuredDetail: string;
  isMeasuredBoxed: boolean;
  /** Result of the last check: true if a surface covered the label's anchor; and the time of that check [ms]. */
  isCovered: boolean;
  lookedAt: number;
}

/** True if a surface covers a point, nearer to the camera than the point by more than a distance [m]. */
export type IsCovered = (point: Vector3, camera: Camera, reach: number) => boolean;

export class LabelSet {
  readonly labels = new Set<SceneLabel>();

  /** `onChange`: the picture is to be drawn again. */
  constructor(
    readonly onChange: () => void,
    readonly isCovered: IsCovered = () => false,
  ) {}

  add(anchor: Object3D, text: string, color?: string): Label {
    const label = new SceneLabel(anchor, text, this, color);
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
  private readonly context = this.canvas.getContext("2d");
  /** Live style of the canvas. */
  private readonly style = getComputedStyle(this.canvas);
  private readonly entries = new WeakMap<SceneLabel, VisibleLabel>();
  /** Labels in the picture, by priority. */
  private readonly visible: VisibleLabel[] = [];
  private readonly point = new Vector3();
  private pointer: { readonly x: number; readonly y: number } | null = null;
  private hovered: SceneLabel | null = null;
  private font = "";
  private size: PictureSize = { width: 0, height: 0 };
  private pixelRatio = 1;
  /** True if neither the last picture nor this one has a label. */
  private isEmpty = true;

  constructor(private readonly set: LabelSet) {
    Object.assign(this.canvas.style, { position: "absolute", pointerEvents: "none" });
  }

  /** Set the pointer's position in the picture [px]; null: outside. */
  hover(at: { readonly x: number; readonly y: number } | null, camera: Camera, size: PictureSize): void {
    this.pointer = at;
    const hovered = this.findHovered(camera, size);
    if (hovered === this.hovered) return;
    this.hovered = hovered;
    this.set.onChange();
  }

  /** Lay out the labels for a picture of a size [px], within its free part. */
  place(camera: Camera, size: PictureSize, free: Area, pixelRatio: number): void {
    this.isEmpty = this.set.labels.size === 0 && this.visible.length === 0;
    this.size = size;
    this.pixelRatio = pixelRatio;
    this.font = this.style.getPropertyValue("--font") || "sans-serif";
    this.findVisible(camera, size, free);
    layoutLabels(this.visible, free, (entry) => this.isCovered(entry, camera));
  }

  /** Draw the labels where they were placed. */
  show(): void {
    const { context, size, pixelRatio } = this;
    if (context === null) return;
    const width = Math.round(size.width * pixelRatio);
    const height = Math.round(size.height * pixelRatio);
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    else if (this.isEmpty) return;
    context.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    context.clearRect(0, 0, size.width, size.height);
    for (const label of this.visible) if (label.corner >= 0) this.drawLabel(context, label);
  }

  private drawLabel(context: CanvasRenderingContext2D, entry: VisibleLabel): void {
    const { label, box } = entry;
    drawLeader(context, entry, this.color(label.color ?? (entry.hovered ? "--accent" : "--text-3")));
    context.textBaseline = "middle";
    this.setFont(context, entry.hovered);
    const middle = box.y + BAND / 2 + 0.5;
    if (label.color !== undefined) {
      context.fillStyle = this.color(label.color);
      context.beginPath();
      context.roundRect(box.x, box.y + 1, box.width, BAND - 2, 4);
      context.fill();
      context.fillStyle = this.color("--on-person");
      context.fillText(label.text, box.x + PADDING, middle);
    } else if (entry.hovered) {
      context.fillStyle = this.color("--panel");
      context.strokeStyle = this.color("--accent");
      context.beginPath();
      context.roundRect(box.x, box.y - 2, box.width, BAND + 4, 4);
      context.fill();
      context.stroke();
      context.fillStyle = this.color("--text");
      const text = textOf(label, true);
      context.fillText(text, box.x + PADDING, middle);
      const end = box.x + PADDING + context.measureText(text).width + PADDING;
      this.setFont(context, false);
      context.fillStyle = this.color("--text-2");
      context.fillText(label.detail, end, middle);
    } else {
      context.lineWidth = 3;
      context.lineJoin = "round";
      context.strokeStyle = this.color("--scene");
      context.strokeText(label.text, box.x + 2, middle);
      context.fillStyle = this.color("--text");
      context.fillText(label.text, box.x + 2, middle);
    }
  }

  private color(token: string): string {
    return this.style.getPropertyValue(token).trim() || "#888";
  }

  private setFont(context: CanvasRenderingContext2D, isBold: boolean): void {
    context.font = isBold ? `600 ${SIZE}px ${this.font}` : `${SIZE}px ${this.font}`;
  }

  private findVisible(camera: Camera, size: PictureSize, { left, top, width, height }: Area): void {
    this.visible.length = 0;
    for (const label of this.set.labels) {
      if (!isShown(label.anchor) || (label.isQuiet && label !== this.hovered)) continue;
      const at = toPicture(label.anchor.getWorldPosition(this.point), camera, size);
      if (at === null || at.x < left || at.y < top || at.x > left + width || at.y > top + height) continue;
      const entry = this.entryOf(label);
      entry.rank = label.rank;
      entry.x = at.x;
      entry.y = at.y;
      entry.distance = at.z;
      entry.hovered = label === this.hovered || label.color !== undefined;
      if (this.context !== null) this.measure(this.context, entry);
      this.visible.push(entry);
    }
  }

  /** True if a surface covers a frame's anchor; it is checked again only after a while. */
  private isCovered(entry: VisibleLabel, camera: Camera): boolean {
    const { anchor, reach } = entry.label;
    const now = performance.now();
    if (now - entry.lookedAt > LOOK_AGAIN) {
      entry.lookedAt = now;
      entry.isCovered = this.set.isCovered(anchor.getWorldPosition(this.point), camera, reach);
    }
    return entry.isCovered;
  }

  private entryOf(label: SceneLabel): VisibleLabel {
    let entry = this.entries.get(label);
    if (entry === undefined) {
      const box = { x: 0, y: 0, width: 0 };
      entry = {
        label,
        box,
        x: 0,
        y: 0,
        width: 0,
        distance: 0,
        hovered: false,
        rank: null,
        isCovered: false,
        lookedAt: -Infinity,
        corner: -1,
        measured: "",
        measuredDetail: "",
        isMeasuredBoxed: false,
      };
      this.entries.set(label, entry);
    }
    return entry;
  }

  /** Measure the width of a label, if its text or style changed. */
  private measure(context: CanvasRenderingContext2D, entry: VisibleLabel): void {
    const { label, hovered: isBoxed } = entry;
    const detail = label === this.hovered ? label.detail : "";
    const text = textOf(label, isBoxed);
    if (
      entry.width > 0 &&
      entry.measured === text &&
      entry.measuredDetail === detail &&
      entry.isMeasuredBoxed === isBoxed
    )
      return;
    entry.measured = text;
    entry.measuredDetail = detail;
    entry.isMeasuredBoxed = isBoxed;
    this.setFont(context, isBoxed);
    entry.width = context.measureText(text).width + (isBoxed ? 2 * PADDING : 4);
    this.setFont(context, false);
    if (detail !== "") entry.width += 4 + context.measureText(detail).width + PADDING;
  }

  private findHovered(camera: Camera, size: PictureSize): SceneLabel | null {
    if (this.pointer === null) return null;
    const { x, y } = this.pointer;
    for (const { label, box, corner } of this.visible) {
      if (
        corner >= 0 &&
        this.set.labels.has(label) &&
        x >= box.x &&
        x <= box.x + box.width &&
        y >= box.y &&
        y <= box.y + BAND
      )
        return label;
    }
    let best: SceneLabel | null = null;
    let nearest = NEAR;
    for (const label of this.set.labels) {
      if (!isShown(label.anchor)) continue;
      const at = toPicture(label.anchor.getWorldPosition(this.point), camera, size);
      const distance = at === null ? Infinity : Math.hypot(at.x - x, at.y - y);
      if (distance < nearest) [best, nearest] = [label, distance];
    }
    return best;
  }
}

/** Text of a label; only the box of a hovered frame has the frame's full name. */
function textOf({ text, full, color }: SceneLabel, isBoxed: boolean): string {
  return isBoxed && full !== "" && color === undefined ? full : text;
}

function drawLeader(context: CanvasRenderingContext2D, { x, y, box }: LabelRequest, color: string): void {
  const end = box.x > x ? box.x : box.x + box.width;
  context.strokeStyle = color;
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(end, box.y + BAND / 2);
  context.stroke();
}

function isShown(object: Object3D): boolean {
  for (let at: Object3D | null = object; at !== null; at = at.parent) if (!at.visible) return false;
  return true;
}
