/** rviz/Path: a line through poses, and the poses. */

import { computed } from "@preact/signals";
import { Group, type Object3D } from "three";

import type { Path, Pose } from "../protocol/generated/ros_messages";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { ColorProperty, EnumProperty, IntProperty, NumberProperty, VectorProperty } from "../rviz/properties";
import { register } from "./registry";
import { BillboardLines } from "../shapes/billboard_lines";
import { PixelLine } from "../shapes/lines";
import { arrowsAt, axesAt } from "../shapes/pose_instances";
import { INVALID_FLOATS, isFinitePose } from "../frames/valid";

const TYPES = ["nav_msgs/Path"];

class PathDisplay extends HistoryDisplay<Path> {
  readonly className = "rviz/Path";
  private readonly style = this.add(new EnumProperty("Line Style", "Lines", ["Lines", "Billboards"]));
  private readonly width = this.add(
    new NumberProperty("Line Width", 0.03, {
      min: 0.001,
      unit: "m",
      visible: computed(() => this.style.value.value === "Billboards"),
    }),
  );
  private readonly color = this.add(new ColorProperty("Color", [25, 255, 0]));
  private readonly alpha = this.add(new NumberProperty("Alpha", 1, { min: 0, max: 1 }));
  private readonly bufferLength = this.add(
    new IntProperty("Buffer Length", 1, { min: 1, description: "Number of paths to display." }),
  );
  private readonly offset = this.add(new VectorProperty("Offset", [0, 0, 0]));
  private readonly poseStyle = this.add(new EnumProperty("Pose Style", "None", ["None", "Axes", "Arrows"]));
  private readonly axesLength = this.length("Length", 0.3, "Axes");
  private readonly axesRadius = this.length("Radius", 0.03, "Axes");
  private readonly poseColor = this.add(
    new ColorProperty("Pose Color", [255, 85, 255], {
      visible: computed(() => this.poseStyle.value.value === "Arrows"),
    }),
  );
  private readonly shaftLength = this.length("Shaft Length", 0.1, "Arrows");
  private readonly headLength = this.length("Head Length", 0.2, "Arrows");
  private readonly shaftDiameter = this.length("Shaft Diameter", 0.1, "Arrows");
  private readonly headDiameter = this.length("Head Diameter", 0.3, "Arrows");

  constructor(context: DisplayContext) {
    super(context, TYPES);
  }

  protected override onStart(): void {
    super.onStart();
    this.whileEnabled(() => {
      this.root.position.set(...this.offset.value.value);
      this.context.scene.invalidate();
    });
  }

  protected override capacity(): number {
    return this.bufferLength.value.peek();
  }

  protected override fault({ poses }: Path): string | null {
    return poses.every(({ pose }) => isFinitePose(pose)) ? null : INVALID_FLOATS;
  }

  protected draw(path: Path): Object3D {
    const poses = path.poses.map(({ pose }) => pose);
    const group = new Group();
    if (poses.length > 1) group.add(this.drawLine(poses));
    const style = this.poseStyle.value.peek();
    if (style === "Axes") group.add(axesAt(poses, this.axesLength.value.peek(), this.axesRadius.value.peek()));
    if (style === "Arrows") group.add(arrowsAt(poses, this.proportions(), this.poseColor.value.peek()));
    return group;
  }

  protected override describe({ poses }: Path): Readonly<Record<string, unknown>> {
    return { Poses: poses.length };
  }

  private drawLine(poses: readonly Pose[]): Object3D {
    const points = Float32Array.from(poses.flatMap(({ position }) => [position.x, position.y, position.z]));
    const [color, alpha] = [this.color.value.peek(), this.alpha.value.peek()];
    if (this.style.value.peek() === "Lines") return new PixelLine(points, color, alpha);
    const lines = new BillboardLines(this.width.value.peek());
    lines.begin();
    lines.addPolyline(points, [...color.map((part) => part / 255), alpha]);
    lines.finish();
    return lines;
  }

  private proportions(): { shaftLength: number; shaftDiameter: number; headLength: number; headDiameter: number } {
    return {
      shaftLength: this.shaftLength.value.peek(),
      shaftDiameter: this.shaftDiameter.value.peek(),
      headLength: this.headLength.value.peek(),
      headDiameter: this.headDiameter.value.peek(),
    };
  }

  private length(name: string, initial: number, style: string): NumberProperty {
    return this.add(
      new NumberProperty(name, initial, { unit: "m", visible: computed(() => this.poseStyle.value.value === style) }),
    );
  }
}

register({ className: "rviz/Path", aliases: [], types: TYPES, create: (context) => new PathDisplay(context) });
