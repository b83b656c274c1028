/** MoveIt's PlanningScene: collision objects, attached ones, the octomap, and the robot among them. */

import { signal, untracked } from "@preact/signals";
import { Quaternion, Vector3, type Matrix4 } from "three";

import { NoTransform, type Transform } from "../frames/transform";
import type { PlanningScene } from "../protocol/generated/ros_messages";
import {
  BoolProperty,
  ColorProperty,
  EnumProperty,
  GroupProperty,
  NumberProperty,
  ReadOut,
  StringProperty,
  TopicProperty,
} from "../rviz/properties";
import { KeyedProperty } from "./keyed_property";
import { ArmDisplay, descriptionProperty } from "./moveit/arm_display";
import type { ArmModel, Positions } from "./moveit/arm_model";
import { positionsOf, rootOf } from "./moveit/robot_state";
import type { RobotGhost } from "./moveit/robot_ghost";
import { SceneContents } from "./moveit/scene_contents";
import { SceneDrawing, type SceneLook } from "./moveit/scene_drawing";
import { OCCUPIED, RENDERINGS } from "./octomaps/voxel_boxes";
import { register } from "./registry";
import type { LinkProperty } from "./robot/link_view";

const SCENE = "moveit_msgs/PlanningScene";
/** All of PlanningSceneComponents. */
const ALL_COMPONENTS = 1023;
const HERE: Transform = identity();

export class PlanningSceneDisplay extends ArmDisplay {
  override readonly className: string = "moveit_rviz_plugin/PlanningScene";
  readonly moveGroupNamespace = this.add(
    new StringProperty("Move Group Namespace", "", {
      description: "The name of the ROS namespace in which the move_group node is running.",
    }),
  );
  protected override readonly descriptionName = this.add(descriptionProperty());
  readonly sceneTopic = this.add(
    new TopicProperty("Planning Scene Topic", "move_group/monitored_planning_scene", [SCENE]),
  );
  private readonly geometry = this.add(new GroupProperty("Scene Geometry"));
  private readonly sceneName = this.geometry.add(new ReadOut("Scene Name", "(noname)"));
  private readonly showGeometry = this.geometry.add(new BoolProperty("Show Scene Geometry", true));
  private readonly sceneAlpha = this.geometry.add(new NumberProperty("Scene Alpha", 0.9, { min: 0, max: 1 }));
  private readonly sceneColor = this.geometry.add(new ColorProperty("Scene Color", [50, 230, 50]));
  private readonly voxels = this.geometry.add(new EnumProperty("Voxel Rendering", OCCUPIED, RENDERINGS));
  private readonly voxelColors = this.geometry.add(
    new EnumProperty("Voxel Coloring", "Z-Axis", ["Z-Axis", "Cell Probability"]),
  );
  private readonly displayTime = this.geometry.add(
    new NumberProperty("Scene Display Time", 0.01, { min: 0, unit: "s", description: "Least time between redraws." }),
  );
  private readonly robot = this.add(new GroupProperty("Scene Robot"));
  private readonly showVisual = this.robot.add(new BoolProperty("Show Robot Visual", true));
  private readonly showCollision = this.robot.add(new BoolProperty("Show Robot Collision", false));
  private readonly robotAlpha = this.robot.add(new NumberProperty("Robot Alpha", 1, { min: 0, max: 1 }));
  private readonly attachedColor = this.robot.add(new ColorProperty("Attached Body Color", [150, 50, 150]));
  private readonly links = this.robot.add(new KeyedProperty<LinkProperty>("Links"));

  /** The scene as move_group monitors it. */
  readonly contents = new SceneContents();
  /** Changes when objects or colors of the scene may have changed. */
  readonly revision = signal(0);
  /** Positions of the robot's joints now. */
  readonly current = signal<Positions>(new Map());
  private drawing: SceneDrawing | null = null;
  private ghost: RobotGhost | null = null;
  private isStale = false;
  private sinceDrawn = Infinity;

  override get topic(): string {
    return this.context.names.resolve(this.sceneTopic.value.value);
  }

  /** Global name of a topic or service of move_group's. */
  moveGroupName(name: string): string {
    const namespace = this.moveGroupNamespace.value.value.replace(/\/$/, "");
    return this.context.names.resolve(namespace === "" ? name : `${namespace}/${name}`);
  }

  /** Pose of the root link in the model's frame, of the robot now. */
  get currentRoot(): Matrix4 {
    return this.rootPose;
  }

  protected override onStart(): void {
    super.onStart();
    this.follow(this.sceneTopic, (scene: PlanningScene) => this.receive(scene));
    this.whileEnabled(() => {
      const name = this.moveGroupName("get_planning_scene");
      const isThere = this.context.connection.services.value.has(name);
      untracked(() => void (isThere && this.ask(name)));
    });
    const { showGeometry, sceneAlpha, sceneColor, voxels, voxelColors, attachedColor } = this;
    this.whileShown([showGeometry, sceneAlpha, sceneColor, voxels, voxelColors, attachedColor], () => this.redraw());
    this.whileShown([this.showVisual, this.showCollision, this.robotAlpha, this.links], () => this.paint());
  }

  protected override build(model: ArmModel): void {
    this.drawing = new SceneDrawing();
    this.anchor.add(this.drawing);
    this.ghost = this.ghostFor(model, this.links);
    this.standRobot();
    this.paint();
    this.redraw();
  }

  protected override drop(): void {
    this.drawing?.dispose();
    this.ghost?.dispose();
    this.drawing = this.ghost = null;
  }

  override update(now: bigint, elapsed: number): void {
    super.update(now, elapsed);
    this.sinceDrawn += elapsed;
    if (!this.isStale || this.sinceDrawn < this.displayTime.value.peek()) return;
    this.isStale = false;
    this.sinceDrawn = 0;
    this.draw();
  }

  /** Contents as they are drawn: a display with changes of its own adds them. */
  protected get shownContents(): SceneContents {
    return this.contents;
  }

  /** Draw the scene again with the next frame. */
  protected redraw(): void {
    this.isStale = true;
    this.context.scene.invalidate();
  }

  private async ask(service: string): Promise<void> {
    try {
      const answer = await this.context.connection.callService(service, { components: { components: ALL_COMPONENTS } });
      if (this.enabled.value.peek()) this.receive(answer["scene"] as unknown as PlanningScene);
    } catch (error) {
      this.setStatus("Planning Scene", "warn", `${service}: ${error instanceof Error ? error.message : String(error)}`);
    }
  }

  protected receive(scene: PlanningScene): void {
    const hasChanged = this.contents.apply(scene);
    this.sceneName.value.value = this.contents.name || "(noname)";
    const positions = positionsOf(scene.robot_state.joint_state);
    const { model } = this;
    const root = model === null ? null : rootOf(model, scene.robot_state);
    if (root !== null) this.rootPose = root;
    if (positions.size > 0) this.current.value = new Map([...this.current.peek(), ...positions]);
    if (positions.size > 0 || root !== null) this.standRobot();
    if (!hasChanged) return;
    this.revision.value += 1;
    this.redraw();
  }

  private standRobot(): void {
    if (this.ghost === null) return;
    this.ghost.pose(this.current.peek(), this.rootPose);
    this.drawing?.follow(this.ghost.poses);
    this.context.scene.invalidate();
  }

  private paint(): void {
    this.ghost?.paint({
      visual: this.showVisual.value.peek(),
      collision: this.showCollision.value.peek(),
      alpha: this.robotAlpha.value.peek(),
      color: null,
    });
    this.context.scene.invalidate();
  }

  private draw(): void {
    if (this.drawing === null || this.ghost === null) return;
    const fault = this.drawing.draw(this.shownContents, this.look, this.ghost.poses, (frame) => this.inModel(frame));
    if (fault === "") this.clearStatus("Octomap");
    else this.setStatus("Octomap", "error", fault);
    this.context.scene.invalidate();
  }

  private get look(): SceneLook {
    return {
      isShown: this.showGeometry.value.peek(),
      alpha: this.sceneAlpha.value.peek(),
      color: this.sceneColor.value.peek(),
      attachedColor: this.attachedColor.value.peek(),
      rendering: this.voxels.value.peek(),
      coloring: this.voxelColors.value.peek(),
    };
  }

  /** Pose of a frame in the model's frame: of a link by the robot's state, of others by tf. */
  private inModel(name: string): Transform | NoTransform {
    const { model, ghost } = this;
    const frame = name.replace(/^\//, "");
    if (model === null || ghost === null || frame === "" || frame === model.frame) return HERE;
    const link = ghost.poses.get(frame);
    if (link === undefined) return this.context.frames.lookup(model.frame, frame, 0n);
    const pose = identity();
    link.decompose(pose.position, pose.orientation, pose.scale);
    return pose;
  }
}

function identity(): Transform & { readonly scale: Vector3 } {
  return { position: new Vector3(), orientation: new Quaternion(), scale: new Vector3(1, 1, 1) };
}

register({
  className: "moveit_rviz_plugin/PlanningScene",
  aliases: [],
  types: [SCENE],
  create: (context) => new PlanningSceneDisplay(context),
});
