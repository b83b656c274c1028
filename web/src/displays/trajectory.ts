/** MoveIt's Trajectory: an animated robot along a planned path. */

import type { DisplayTrajectory } from "../protocol/generated/ros_messages";
import { ArmDisplay, descriptionProperty } from "./moveit/arm_display";
import type { ArmModel } from "./moveit/arm_model";
import { PathProperties, PathView, TRAJECTORY } from "./moveit/path_view";
import { register } from "./registry";

class TrajectoryDisplay extends ArmDisplay {
  readonly className = "moveit_rviz_plugin/Trajectory";
  protected override readonly descriptionName = this.add(descriptionProperty());
  private readonly path = new PathProperties((property) => this.add(property));
  private view: PathView | null = null;
  private message: DisplayTrajectory | null = null;

  override get topic(): string {
    return this.context.names.resolve(this.path.topic.value.value);
  }

  protected override onStart(): void {
    super.onStart();
    this.follow(
      this.path.topic,
      (message: DisplayTrajectory) => {
        this.message = message;
        this.view?.receive(message, new Map(), this.rootPose);
      },
      true,
    );
  }

  protected override onStop(): void {
    super.onStop();
    this.message = null;
  }

  override update(now: bigint, elapsed: number): void {
    super.update(now, elapsed);
    this.view?.update(now, elapsed);
  }

  protected override build(model: ArmModel): void {
    this.view = new PathView(
      model,
      this.path,
      (of, rows) => this.ghostFor(of, rows),
      () => this.context.scene.invalidate(),
    );
    if (this.message !== null) this.view.receive(this.message, new Map(), this.rootPose);
  }

  protected override drop(): void {
    this.view?.dispose();
    this.view = null;
  }
}

register({
  className: "moveit_rviz_plugin/Trajectory",
  aliases: [],
  types: [TRAJECTORY],
  create: (context) => new TrajectoryDisplay(context),
});
