/** Base of displays of a linear and an angular vector: wrenches, twists and accelerations; rviz's ScrewDisplay. */

import { Group, Quaternion, Vector3, type Object3D } from "three";

import type { Vector3 as Xyz } from "../protocol/generated/ros_messages";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { BoolProperty, ColorProperty, IntProperty, NumberProperty, type Rgb } from "../rviz/properties";
import { Arrow } from "../shapes/arrow";
import { BillboardLines } from "../shapes/billboard_lines";
import type { Stamped } from "./topic_display";
import { INVALID_FLOATS, isFiniteXyz, vector } from "../frames/valid";

const X = new Vector3(1, 0, 0);
const Z = new Vector3(0, 0, 1);
/** The circle around the angular arrow begins at an eighth of a turn, in steps of 1/32. */
const CIRCLE_STEPS = 32;
const CIRCLE_BEGIN = 4;

export interface Screw {
  readonly linear: Xyz;
  readonly angular: Xyz;
}

export abstract class ScrewDisplay<M extends Stamped> extends HistoryDisplay<M> {
  private readonly linearColor: ColorProperty;
  private readonly angularColor: ColorProperty;
  private readonly alpha: NumberProperty;
  private readonly linearScale: NumberProperty;
  private readonly angularScale: NumberProperty;
  private readonly width: NumberProperty;
  private readonly historyLength: IntProperty;
  private readonly hideSmall: BoolProperty;

  constructor(
    context: DisplayContext,
    types: readonly string[],
    private readonly linearName: string,
    private readonly angularName: string,
  ) {
    super(context, types);
    this.linearColor = this.add(new ColorProperty(`${linearName} Color`, [204, 51, 51]));
    this.angularColor = this.add(new ColorProperty(`${angularName} Color`, [204, 204, 51]));
    this.alpha = this.add(new NumberProperty("Alpha", 1, { min: 0, max: 1 }));
    this.linearScale = this.add(new NumberProperty(`${linearName} Arrow Scale`, 2));
    this.angularScale = this.add(new NumberProperty(`${angularName} Arrow Scale`, 2));
    this.width = this.add(new NumberProperty("Arrow Width", 0.5));
    this.historyLength = this.add(
      new IntProperty("History Length", 1, {
        min: 1,
        max: 100000,
        description: "Number of prior measurements to display.",
      }),
    );
    this.hideSmall = this.add(
      new BoolProperty("Hide Small Values", true, { description: "Hide arrows shorter than they are wide." }),
    );
  }

  protected abstract screw(message: M): Screw;

  protected override capacity(): number {
    return this.historyLength.value.peek();
  }

  protected override fault(message: M): string | null {
    const { linear, angular } = this.screw(message);
    return isFiniteXyz(linear) && isFiniteXyz(angular) ? null : INVALID_FLOATS;
  }

  protected draw(message: M): Object3D {
    const { linear, angular } = this.screw(message);
    const group = new Group();
    const length = vector(linear).length() * this.linearScale.value.peek();
    if (this.isShown(length)) group.add(this.arrow(linear, length, this.linearColor.value.peek()));
    const turn = vector(angular).length() * this.angularScale.value.peek();
    if (this.isShown(turn)) {
      const color = this.angularColor.value.peek();
      group.add(this.arrow(angular, turn, color), this.circle(angular, turn, color));
    }
    return group;
  }

  protected override describe(message: M): Readonly<Record<string, unknown>> {
    const { linear, angular } = this.screw(message);
    return { [this.linearName]: linear, [this.angularName]: angular };
  }

  private isShown(length: number): boolean {
    return length > 0 && (length > this.width.value.peek() || !this.hideSmall.value.peek());
  }

  /** rviz's arrow of 1 m and a head of 0.3 m, stretched. */
  private arrow(direction: Xyz, length: number, color: Rgb): Object3D {
    const arrow = new Arrow();
    const width = this.width.value.peek();
    arrow.scale.set(length, width, width);
    arrow.quaternion.setFromUnitVectors(X, vector(direction).normalize());
    arrow.setColor(color, this.alpha.value.peek());
    return arrow;
  }

  /** An open circle around the middle of the angular arrow with a head in the sense of the turn. */
  private circle(axis: Xyz, length: number, color: Rgb): Object3D {
    const width = this.width.value.peek();
    const alpha = this.alpha.value.peek();
    const points: number[] = [];
    for (let step = CIRCLE_BEGIN; step <= CIRCLE_STEPS; step++) {
      const angle = (2 * Math.PI * step) / CIRCLE_STEPS;
      points.push((length / 4) * Math.cos(angle), (length / 4) * Math.sin(angle), length / 2);
    }
    const line = new BillboardLines(0.05 * width);
    line.begin();
    line.addPolyline(points, [...color.map((part) => part / 255), alpha]);
    line.finish();
    const head = new Arrow({
      shaftLength: 0,
      shaftDiameter: 0.1 * width,
      headLength: 0.1 * width,
      headDiameter: 0.2 * width,
    });
    head.setColor(color, alpha);
    head.position.set(length / 4, 0, length / 2);
    head.rotation.set(0, 0, Math.PI / 2);
    const group = new Group().add(line, head);
    group.quaternion.copy(new Quaternion().setFromUnitVectors(Z, vector(axis).normalize()));
    return group;
  }
}
