/** MoveIt's MotionPlanning: the planning scene, a query's start and goal, and the planned path. */

import { computed, signal, untracked } from "@preact/signals";
import { Matrix4 } from "three";

import type { CollisionObject, DisplayTrajectory, Pose } from "../protocol/generated/ros_messages";
import { GroupProperty } from "../rviz/properties";
import type { Transform } from "../frames/transform";
import { KeyedProperty } from "./keyed_property";
import { poseMatrix } from "./markers/marker_scene";
import type { ArmGroup, ArmModel } from "./moveit/arm_model";
import { nearestPose } from "./moveit/nearest_pose";
import { PathProperties, PathView } from "./moveit/path_view";
import { Query } from "./moveit/query";
import { QueryChecks } from "./moveit/query_checks";
import { QueryView, type QueryLook } from "./moveit/query_view";
import { ObjectHandle } from "./moveit/object_handle";
import { addMetrics, PlannerSettings, RequestProperties } from "./moveit/request_properties";
import { SceneContents } from "./moveit/scene_contents";
import { SceneDraft } from "./moveit/scene_draft";
import { WorkspaceBox } from "./moveit/workspace_box";
import { PlanningSceneDisplay } from "./planning_scene";
import { register } from "./registry";
import type { LinkProperty } from "./robot/link_view";

/** What belongs to one query of one group. */
interface Shown {
  readonly view: QueryView;
  readonly checks: QueryChecks;
}

export class MotionPlanningDisplay extends PlanningSceneDisplay {
  override readonly className = "moveit_rviz_plugin/MotionPlanning";
  readonly request = new RequestProperties((property) => this.add(property));
  readonly metrics = addMetrics((property) => this.add(property));
  private readonly pathHeading = this.add(new GroupProperty("Planned Path"));
  readonly path = new PathProperties((property) => this.pathHeading.add(property));
  readonly settings = new PlannerSettings((property) => this.add(property));

  readonly startQuery = new Query("start");
  readonly goalQuery = new Query("goal");
  /** The planned path's animation; null before there is a model. */
  readonly pathView = signal<PathView | null>(null);
  /** The group that is planned for. */
  readonly group = computed((): ArmGroup | null => {
    const model = this.described.value.model;
    const chosen = model?.group(this.request.group.value.value);
    return chosen ?? model?.groups.find(({ tips }) => tips.length > 0) ?? model?.groups[0] ?? null;
  });
  /** Changes of the scene that are drawn and not published yet. */
  readonly draft = new SceneDraft();
  /** The scene with them. */
  readonly drafted = computed((): SceneContents => {
    const contents = this.revision.value < 0 ? new SceneContents() : this.contents.copy();
    this.draft.apply(contents);
    return contents;
  });
  private readonly handle = new ObjectHandle(this.draft);
  private shown: readonly Shown[] = [];
  private anchorPose: Transform | null = null;
  private readonly workspace = new WorkspaceBox();

  protected override onStart(): void {
    super.onStart();
    this.follow(this.path.topic, (message: DisplayTrajectory) => this.showPath(message), true);
    this.whileEnabled(() => {
      const current = this.current.value;
      untracked(() => {
        for (const query of [this.startQuery, this.goalQuery]) query.follow(current);
      });
    });
    this.whileEnabled(() => {
      const group = this.group.value;
      untracked(() => this.showGroup(group));
    });
    for (const [index, query] of [this.startQuery, this.goalQuery].entries())
      this.whileEnabled(() => {
        const isKnown = query.positions.value.size > 0 && this.revision.value >= 0;
        const isThere = this.context.connection.services.value.has(this.moveGroupName("check_state_validity"));
        untracked(() => isKnown && isThere && this.check(index));
      });
    this.whileEnabled(() => {
      this.drafted.value; // eslint-disable-line @typescript-eslint/no-unused-expressions -- draws each change
      untracked(() => this.redraw());
    });
    this.whileEnabled(() => {
      const id = this.draft.selected.value;
      const object = this.drafted.value.objects.get(id ?? "") ?? null;
      untracked(() => this.showHandle(object));
    });
    const { workspaceCenter, workspaceSize } = this.settings;
    this.whileShown([this.request.showWorkspace, workspaceCenter, workspaceSize], () => {
      this.workspace.visible = this.request.showWorkspace.value.peek();
      this.workspace.set(workspaceCenter.value.peek(), workspaceSize.value.peek());
      this.context.scene.invalidate();
    });
  }

  protected override build(model: ArmModel): void {
    super.build(model);
    this.request.group.choices.value = model.groups.map(({ name }) => name);
    this.anchor.add(this.workspace);
    this.pathView.value = new PathView(
      model,
      this.path,
      (of, rows) => this.ghostFor(of, rows),
      () => this.context.scene.invalidate(),
    );
    this.showGroup(this.group.peek());
  }

  protected override drop(): void {
    super.drop();
    this.showGroup(null);
    this.workspace.removeFromParent();
    this.pathView.peek()?.dispose();
    this.pathView.value = null;
  }

  protected override onStop(): void {
    super.onStop();
    this.showGroup(null);
    this.showHandle(null);
  }

  override update(now: bigint, elapsed: number): void {
    super.update(now, elapsed);
    this.pathView.peek()?.update(now, elapsed);
    this.handle.update(elapsed);
    this.anchorPose = this.model === null ? null : this.findAnchor(this.model);
    for (const { view, checks } of this.shown) {
      view.update(elapsed);
      checks.tick(elapsed);
    }
  }

  /** The query that a finger or a mouse moves: start or goal. */
  query(name: "start" | "goal"): Query {
    return name === "start" ? this.startQuery : this.goalQuery;
  }

  /** Show a path, as one on the trajectory topic. */
  showPath(message: DisplayTrajectory): void {
    this.pathView.peek()?.receive(message, this.current.peek(), this.currentRoot);
  }

  protected override get shownContents(): SceneContents {
    return this.drafted.peek();
  }

  private showHandle(object: CollisionObject | null): void {
    const { model, context, root } = this;
    const isOwn = object !== null && ["", model?.frame].includes(object.header.frame_id.replace(/^\//, ""));
    const parts = model === null ? null : { context, root, frame: model.frame, anchor: () => this.anchorPose };
    this.handle.show(isOwn ? object : null, parts);
  }

  private check(index: number): void {
    const group = this.group.peek();
    const shown = this.shown[index];
    const isShown = [this.request.queryStart, this.request.queryGoal][index]?.value.peek() === true;
    if (group !== null && shown !== undefined && isShown) shown.checks.check(group);
  }

  private showGroup(group: ArmGroup | null): void {
    for (const { view } of this.shown) view.dispose();
    const { model } = this;
    this.shown = [];
    if (group === null || model === null) return;
    const { request } = this;
    const looks: readonly (readonly [Query, Pick<QueryLook, "shown" | "color" | "alpha">])[] = [
      [this.startQuery, { shown: request.queryStart, color: request.startColor, alpha: request.startAlpha }],
      [this.goalQuery, { shown: request.queryGoal, color: request.goalColor, alpha: request.goalAlpha }],
    ];
    this.shown = looks.map(([query, look]) => this.showQuery(model, group, query, look));
  }

  private showQuery(
    model: ArmModel,
    group: ArmGroup,
    query: Query,
    look: Pick<QueryLook, "shown" | "color" | "alpha">,
  ): Shown {
    const { collidingColor: colliding, violationColor: violation, markerSize } = this.request;
    const checks = new QueryChecks(query, this.context.connection, model, (name) => this.moveGroupName(name));
    const onDrag = (tip: string, pose: Pose): void => {
      const solver = solverOf(model, group, tip);
      const { collisionAwareIk, approximateIk } = this.settings;
      const [target, root] = [poseMatrix(pose, new Matrix4()), this.currentRoot];
      checks.reach({
        group: solver,
        tip,
        pose,
        avoidCollisions: collisionAwareIk.value.peek(),
        nearest: approximateIk.value.peek()
          ? (seed) => nearestPose({ model, group: solver, tip, target, seed, root })
          : null,
      });
    };
    const view = new QueryView(query, group, this.ghostFor(model, new KeyedProperty<LinkProperty>("Links")), {
      context: this.context,
      root: this.root,
      anchor: () => this.anchorPose,
      rootPose: () => this.currentRoot,
      look: { ...look, colliding, violation, markerSize },
      onDrag,
      onRelease: () => checks.release(),
    });
    return { view, checks };
  }
}

/** The group that is solved for a tip: of several tips, the smallest group of its own that has it alone. */
function solverOf(model: ArmModel, group: ArmGroup, tip: string): ArmGroup {
  if (group.tips.length < 2) return group;
  const names = new Set(group.joints.map(({ name }) => name));
  const inner = model.groups.filter(
    ({ tips, joints }) => tips.length === 1 && tips[0] === tip && joints.every(({ name }) => names.has(name)),
  );
  return inner.sort((a, b) => a.joints.length - b.joints.length)[0] ?? group;
}

register({
  className: "moveit_rviz_plugin/MotionPlanning",
  aliases: [],
  types: [],
  create: (context) => new MotionPlanningDisplay(context),
});
