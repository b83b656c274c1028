/** Grid: lines in a plane of a frame. */

import { BufferAttribute, BufferGeometry, Group, LineSegments } from "three";

import { Display } from "./display";
import {
  ColorProperty,
  EnumProperty,
  FIXED_FRAME,
  FrameProperty,
  IntProperty,
  NumberProperty,
  VectorProperty,
} from "../rviz/properties";
import { register } from "./registry";
import { BillboardLines } from "../shapes/billboard_lines";
import { flatMaterial } from "../shapes/shape_material";
import { watch } from "./watch";

/** Indices of the plane's two axes and its normal. */
const PLANES: Readonly<Record<string, readonly [number, number, number]>> = {
  XY: [0, 1, 2],
  XZ: [0, 2, 1],
  YZ: [1, 2, 0],
};

/** Points of pairs [m]: `cells` squares a side about the origin, and `layers` of them above and below. */
export function gridLines(cells: number, layers: number, size: number, plane: string): Float32Array<ArrayBuffer> {
  const [u, v, w] = PLANES[plane] ?? [0, 1, 2];
  const reach = (cells * size) / 2;
  const points: number[] = [];
  const line = (from: readonly number[], to: readonly number[]): void => {
    for (const end of [from, to]) {
      const point = [0, 0, 0];
      [u, v, w].forEach((axis, k) => (point[axis] = end[k] ?? 0));
      points.push(...point);
    }
  };
  const ticks = Array.from({ length: cells + 1 }, (_, k) => -reach + k * size);
  const heights = Array.from({ length: layers + 1 }, (_, k) => (layers / 2 - k) * size);
  for (const height of heights) {
    for (const at of ticks) {
      line([at, -reach, height], [at, reach, height]);
      line([-reach, at, height], [reach, at, height]);
    }
  }
  const top = (layers / 2) * size;
  if (layers > 0) for (const x of ticks) for (const y of ticks) line([x, y, -top], [x, y, top]);
  return new Float32Array(points);
}

export class Grid extends Display {
  readonly className = "rviz/Grid";
  private readonly frame = this.add(new FrameProperty("Reference Frame", FIXED_FRAME));
  private readonly cells = this.add(new IntProperty("Plane Cell Count", 10, { min: 1, max: 1000 }));
  private readonly layers = this.add(new IntProperty("Normal Cell Count", 0, { min: 0, max: 100 }));
  private readonly size = this.add(new NumberProperty("Cell Size", 1, { min: 0.0001, unit: "m" }));
  private readonly style = this.add(new EnumProperty("Line Style", "Lines", ["Lines", "Billboards"]));
  private readonly width = this.style.add(new NumberProperty("Line Width", 0.03, { min: 0.001, unit: "m" }));
  private readonly color = this.add(new ColorProperty("Color", [160, 160, 164]));
  private readonly alpha = this.add(new NumberProperty("Alpha", 0.5, { min: 0, max: 1 }));
  private readonly plane = this.add(new EnumProperty("Plane", "XY", ["XY", "XZ", "YZ"]));
  private readonly offset = this.add(new VectorProperty("Offset", [0, 0, 0]));

  private readonly place = new Group();
  private readonly material = flatMaterial();
  private readonly lines = new LineSegments(new BufferGeometry(), this.material);
  private readonly broad = new BillboardLines();
  private unwatch = (): void => undefined;

  protected onStart(): void {
    this.place.add(this.lines, this.broad);
    this.root.add(this.place);
    this.unwatch = watch(this.properties, () => this.draw());
  }

  protected onStop(): void {
    this.unwatch();
    this.root.clear();
    this.lines.geometry.dispose();
    this.broad.dispose();
  }

  override update(): void {
    const name = this.frame.value.peek();
    this.stand(this.root, this.transform(name === FIXED_FRAME ? this.context.fixedFrame.peek() : name, 0n));
  }

  private draw(): void {
    const points = gridLines(
      this.cells.value.value,
      this.layers.value.value,
      this.size.value.value,
      this.plane.value.value,
    );
    const broad = this.style.value.value === "Billboards";
    const [red, green, blue] = this.color.value.value;
    const alpha = this.alpha.value.value;
    this.place.position.fromArray(this.offset.value.value);
    this.lines.visible = !broad;
    this.broad.visible = broad;
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(points, 3));
    this.material.setColor([red, green, blue], alpha);
    const rgba = [red / 255, green / 255, blue / 255, alpha];
    this.broad.begin();
    for (let k = 0; broad && k < points.length; k += 6) this.broad.addSegment(points, k, points, k + 3, rgba, rgba);
    this.broad.setWidth(this.width.value.value);
    this.broad.finish();
    this.context.scene.invalidate();
  }
}

register({ className: "rviz/Grid", aliases: [], types: [], create: (context) => new Grid(context) });
