/** Axes: three axes at the origin of a frame. */

import { effect } from "@preact/signals";

import { Display } from "./display";
import { BoolProperty, FIXED_FRAME, FrameProperty, NumberProperty } from "../rviz/properties";
import { register } from "./registry";
import { Axes } from "../shapes/axes";
import { Trail } from "../shapes/trail";
import { watch } from "./watch";

export class AxesDisplay extends Display {
  readonly className = "rviz/Axes";
  private readonly frame = this.add(new FrameProperty("Reference Frame", FIXED_FRAME));
  private readonly length = this.add(new NumberProperty("Length", 1, { min: 0.0001, unit: "m" }));
  private readonly radius = this.add(new NumberProperty("Radius", 0.1, { min: 0.0001, unit: "m" }));
  private readonly trail = this.add(new BoolProperty("Show Trail", false));
  private readonly alpha = this.add(new NumberProperty("Alpha", 1, { min: 0, max: 1 }));

  private axes: Axes | null = null;
  private path: Trail | null = null;
  private stops: (() => void)[] = [];

  protected onStart(): void {
    const axes = new Axes();
    this.axes = axes;
    this.root.add(axes);
    this.stops = [
      watch(this.properties, () => {
        axes.setSize(this.length.value.peek(), this.radius.value.peek());
        this.setTrail(this.trail.value.peek());
        this.context.scene.invalidate();
      }),
      effect(() => {
        axes.setColors(this.context.axisColors.value, this.alpha.value.value);
        this.context.scene.invalidate();
      }),
    ];
  }

  protected onStop(): void {
    for (const stop of this.stops) stop();
    this.root.clear();
    this.setTrail(false);
    this.axes?.dispose();
    this.axes = null;
  }

  private setTrail(shown: boolean): void {
    if (shown === (this.path !== null)) return;
    this.path?.removeFromParent();
    this.path?.dispose();
    this.path = shown ? new Trail() : null;
    if (this.path !== null) this.root.add(this.path);
  }

  override update(): void {
    const name = this.frame.value.peek();
    const pose = this.transform(name === FIXED_FRAME ? this.context.fixedFrame.peek() : name, 0n);
    if (this.axes !== null) this.stand(this.axes, pose);
    if (this.path !== null) this.path.visible = pose !== null;
    if (pose !== null) this.path?.follow(pose.position);
  }
}

register({ className: "rviz/Axes", aliases: [], types: [], create: (context) => new AxesDisplay(context) });
