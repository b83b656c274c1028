/** Axes of all frames and arrows to their parents: five draw calls, however many frames. */

import { Group, Matrix4, Quaternion, Vector3 } from "three";

import type { Selectable } from "../../scene/scene_view";
import type { AxisColors } from "../../shapes/axes";
import { Instances } from "../../shapes/instances";
import { SHAFT, HEAD } from "../../shapes/solids";
import type { FrameView } from "./frame_row";

/** rviz's axes of a frame at scale 1 [m]. */
const AXES = { length: 0.2, radius: 0.02 } as const;
const ARROW = { shaft: 0.01, head: 0.04, headLength: 0.1 } as const;
const SHAFT_COLOR = [0.8, 0.8, 0.3] as const;
const HEAD_COLOR = [1, 0.1, 0.6] as const;
const GREY = 0.7;
/** Arrows shorter than this are not drawn [m]. */
const SHORTEST = 0.001;

const X = new Vector3(1, 0, 0);
const TURNS = [
  new Quaternion(),
  new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), Math.PI / 2),
  new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), -Math.PI / 2),
] as const;

const matrix = new Matrix4();
const position = new Vector3();
const scale = new Vector3();
const turn = new Quaternion();

export interface TfStyle {
  readonly axes: boolean;
  readonly arrows: boolean;
  readonly scale: number;
  readonly alpha: number;
  readonly colors: AxisColors;
}

export class TfShapes extends Group {
  private readonly axes = TURNS.map(() => new Instances(SHAFT));
  private readonly shafts = new Instances(SHAFT);
  private readonly heads = new Instances(HEAD);
  private shown: FrameView[] = [];

  constructor() {
    super();
    super.add(...this.axes, this.shafts, this.heads);
    const selectable: Selectable = { describe: (index) => this.describe(index) };
    this.name = "Frame";
    this.userData["selectable"] = selectable;
  }

  draw(frames: ReadonlyMap<string, FrameView>, style: TfStyle): void {
    this.shown.length = 0;
    for (const frame of frames.values()) if (frame.isShown) this.shown.push(frame);
    this.drawAxes(style);
    this.drawArrows(frames, style);
  }

  override dispose(): void {
    for (const part of [...this.axes, this.shafts, this.heads]) part.dispose();
  }

  private drawAxes(style: TfStyle): void {
    const count = style.axes ? this.shown.length : 0;
    scale.set(AXES.length, AXES.radius, AXES.radius).multiplyScalar(style.scale);
    this.axes.forEach((axis, k) => {
      const [red, green, blue] = style.colors[k] ?? [255, 255, 255];
      axis.begin(count);
      for (let index = 0; index < count; index++) {
        const frame = this.shown[index];
        if (frame === undefined) continue;
        turn.copy(frame.anchor.quaternion).multiply(TURNS[k] ?? TURNS[0]);
        axis.setMatrixAt(index, matrix.compose(frame.anchor.position, turn, scale));
        setFaded(axis, index, red / 255, green / 255, blue / 255, frame, style.alpha);
      }
      axis.finish();
    });
  }

  private drawArrows(frames: ReadonlyMap<string, FrameView>, style: TfStyle): void {
    this.shafts.begin(this.shown.length);
    this.heads.begin(this.shown.length);
    let count = 0;
    for (const frame of style.arrows ? this.shown : []) {
      const parent = frame.parent === null ? undefined : frames.get(frame.parent);
      if (parent === undefined || !parent.isPlaced) continue;
      frame.toParent.subVectors(parent.anchor.position, frame.anchor.position);
      const distance = frame.toParent.length();
      if (distance < SHORTEST) continue;
      this.drawArrow(count++, frame, distance, style);
    }
    for (const part of [this.shafts, this.heads]) {
      part.resize(count);
      part.finish();
    }
  }

  private drawArrow(index: number, frame: FrameView, distance: number, style: TfStyle): void {
    const size = style.scale;
    const headLength =
      distance < ARROW.headLength * size ? ARROW.headLength * size * distance : ARROW.headLength * size;
    const shaftLength = distance - headLength;
    turn.setFromUnitVectors(X, frame.toParent.divideScalar(distance));
    scale.set(shaftLength, ARROW.shaft * size, ARROW.shaft * size);
    this.shafts.setMatrixAt(index, matrix.compose(frame.anchor.position, turn, scale));
    position.copy(frame.anchor.position).addScaledVector(frame.toParent, shaftLength);
    scale.set(headLength, ARROW.head * size, ARROW.head * size);
    this.heads.setMatrixAt(index, matrix.compose(position, turn, scale));
    setFaded(this.shafts, index, ...SHAFT_COLOR, frame, style.alpha);
    setFaded(this.heads, index, ...HEAD_COLOR, frame, style.alpha);
  }

  private describe(index: number | null): Readonly<Record<string, unknown>> {
    const frame = index === null ? undefined : this.shown[index];
    if (frame === undefined) return {};
    return {
      Frame: frame.name,
      Parent: frame.parent ?? "",
      Position: frame.anchor.position.toArray(),
      Orientation: frame.anchor.quaternion.toArray(),
    };
  }
}

function setFaded(
  part: Instances,
  index: number,
  red: number,
  green: number,
  blue: number,
  { fade }: FrameView,
  alpha: number,
): void {
  const saturation = 1 - fade.grey;
  const grey = GREY * fade.grey;
  part.setRgbaAt(
    index,
    red * saturation + grey,
    green * saturation + grey,
    blue * saturation + grey,
    alpha * fade.alpha,
  );
}
