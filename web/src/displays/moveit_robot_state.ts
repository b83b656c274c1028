/** MoveIt's RobotState: a robot posed by a message. */

import { Matrix4 } from "three";

import type { DisplayRobotState } from "../protocol/generated/ros_messages";
import { BoolProperty, ColorProperty, NumberProperty, ReadOut, TopicProperty, type Rgb } from "../rviz/properties";
import { KeyedProperty } from "./keyed_property";
import { ArmDisplay, descriptionProperty } from "./moveit/arm_display";
import type { ArmModel } from "./moveit/arm_model";
import type { RobotGhost } from "./moveit/robot_ghost";
import { positionsOf, rootOf } from "./moveit/robot_state";
import { SceneContents } from "./moveit/scene_contents";
import { SceneDrawing } from "./moveit/scene_drawing";
import { register } from "./registry";
import type { LinkProperty } from "./robot/link_view";

const STATE = "moveit_msgs/DisplayRobotState";

class RobotStateDisplay extends ArmDisplay {
  readonly className = "moveit_rviz_plugin/RobotState";
  protected override readonly descriptionName = this.add(descriptionProperty());
  private readonly stateTopic = this.add(new TopicProperty("Robot State Topic", "display_robot_state", [STATE]));
  private readonly rootLink = this.add(new ReadOut("Robot Root Link"));
  private readonly alpha = this.add(new NumberProperty("Robot Alpha", 1, { min: 0, max: 1 }));
  private readonly attachedColor = this.add(new ColorProperty("Attached Body Color", [150, 50, 150]));
  private readonly showHighlights = this.add(new BoolProperty("Show Highlights", true));
  private readonly visual = this.add(new BoolProperty("Visual Enabled", true));
  private readonly collision = this.add(new BoolProperty("Collision Enabled", false));
  private readonly allLinks = this.add(new BoolProperty("Show All Links", true));
  private readonly links = this.add(new KeyedProperty<LinkProperty>("Links"));

  private ghost: RobotGhost | null = null;
  private drawing: SceneDrawing | null = null;
  private message: DisplayRobotState | null = null;

  override get topic(): string {
    return this.context.names.resolve(this.stateTopic.value.value);
  }

  protected override onStart(): void {
    super.onStart();
    this.follow(this.stateTopic, (message: DisplayRobotState) => {
      this.message = message;
      this.draw();
    });
    const { alpha, attachedColor, showHighlights, visual, collision, links, allLinks } = this;
    this.whileShown([alpha, attachedColor, showHighlights, visual, collision, links], () => this.draw());
    let were = allLinks.value.peek();
    this.whileShown([allLinks], () => {
      const enabled = allLinks.value.peek();
      if (enabled === were) return;
      were = enabled;
      for (const [, row] of links.entries()) if (row instanceof BoolProperty) row.value.value = enabled;
    });
  }

  protected override onStop(): void {
    super.onStop();
    this.message = null;
  }

  protected override build(model: ArmModel): void {
    this.rootLink.value.value = model.rootLink;
    this.ghost = this.ghostFor(model, this.links);
    this.drawing = new SceneDrawing();
    this.anchor.add(this.drawing);
    this.draw();
  }

  protected override drop(): void {
    this.ghost?.dispose();
    this.drawing?.dispose();
    this.ghost = this.drawing = null;
    this.rootLink.value.value = "";
  }

  private draw(): void {
    const { ghost, drawing, message } = this;
    if (ghost === null || drawing === null) return;
    ghost.visible = drawing.visible = message !== null && !message.hide;
    if (message === null || message.hide) return;
    const { state, highlight_links: highlights } = message;
    this.rootPose = rootOf(ghost.model, state) ?? new Matrix4();
    ghost.pose(positionsOf(state.joint_state), this.rootPose);
    const colors = highlights.map(({ id, color }): [string, Rgb] => [
      id,
      [255 * color.r, 255 * color.g, 255 * color.b],
    ]);
    ghost.paint({
      visual: this.visual.value.peek(),
      collision: this.collision.value.peek(),
      alpha: this.alpha.value.peek(),
      color: null,
      links: new Map(this.showHighlights.value.peek() ? colors : []),
    });
    const attached = new SceneContents();
    for (const body of state.attached_collision_objects) attached.attached.set(body.object.id, body);
    const look = { isShown: true, alpha: this.alpha.value.peek(), attachedColor: this.attachedColor.value.peek() };
    const unused = { color: [0, 0, 0], rendering: "", coloring: "" } as const;
    const nowhere = { position: ghost.position, orientation: ghost.quaternion };
    drawing.draw(attached, { ...look, ...unused }, ghost.poses, () => nowhere);
    this.context.scene.invalidate();
  }
}

register({
  className: "moveit_rviz_plugin/RobotState",
  aliases: [],
  types: [STATE],
  create: (context) => new RobotStateDisplay(context),
});
