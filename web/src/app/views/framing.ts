/** What a selection is in the world, and how the camera frames it. */

import { Box3, Quaternion, Sphere, Vector3, type Mesh, type Object3D } from "three";

import { isEnabled, withMembers } from "../../displays/group";
import { bodiesOfPart } from "../../editor/model_editor";
import { NoTransform, type Transform } from "../../frames/transform";
import type { JointInfo, LinkInfo, ModelInfo, PluginInfo, SensorInfo } from "../../scene/simulated_world";
import type { Page, PluginOwner, Selection } from "../page";
import { allModels, bodiesOf, robotOf, type ScopedModel } from "../world/nodes";

export function findModel(page: Pick<Page, "world">, name: string): ModelInfo | null {
  return allModels(page.world.manifest.value?.models ?? []).find((each) => each.name === name)?.model ?? null;
}

export function findLink(page: Pick<Page, "world">, model: string, link: string): LinkInfo | null {
  const scoped = `${model}::${link}`; // a joint's child may be in a nested model, `inner::link`
  const at = scoped.lastIndexOf("::");
  return findModel(page, scoped.slice(0, at))?.links.find((each) => each.name === scoped.slice(at + 2)) ?? null;
}

export function findJoint(page: Pick<Page, "world">, model: string, joint: string): JointInfo | null {
  return findModel(page, model)?.joints.find((each) => each.name === joint) ?? null;
}

export function findSensor(page: Pick<Page, "world">, model: string, link: string, sensor: string): SensorInfo | null {
  return findLink(page, model, link)?.sensors.find((each) => each.name === sensor) ?? null;
}

export function findPlugin(page: Pick<Page, "world">, owner: PluginOwner, plugin: string): PluginInfo | null {
  const of = (): { readonly plugins: readonly PluginInfo[] } | null => {
    if (owner.kind === "world") return page.world.manifest.value;
    return owner.kind === "model" ? findModel(page, owner.model) : findSensor(page, owner.model, owner.link, owner.sensor);
  };
  return of()?.plugins.find(({ name }) => name === plugin) ?? null;
}

/** What has a place in the world: a sensor's link, a plugin's owner. */
export function placed(selection: Selection | null): Exclude<Selection, { readonly kind: "sensor" | "plugin" }> | null {
  if (selection?.kind === "plugin") return placed(selection.of);
  return selection?.kind === "sensor" ? { kind: "link", model: selection.model, link: selection.link } : selection;
}

/** Bodies of a selection; none for what is not simulated. */
export function selectedBodies(page: Page, selected: Selection | null): readonly number[] {
  const selection = placed(selected);
  if (selection === null) return [];
  if (selection.kind === "model") {
    const model = findModel(page, selection.model);
    return model === null ? [] : bodiesOf(model);
  }
  if (selection.kind === "link") {
    const link = findLink(page, selection.model, selection.link);
    return link === null ? [] : [link.body];
  }
  if (selection.kind === "part") return bodiesOfPart(page.world.manifest.value?.draft ?? null, selection.part);
  if (selection.kind !== "joint") return [];
  const child = findJoint(page, selection.model, selection.joint)?.child ?? "";
  const link = findLink(page, selection.model, child);
  return link === null ? [] : [link.body];
}

/** Frame a selection; with none the robot, else all there is. */
export function frameSelection(page: Page, selection: Selection | null): void {
  if (selection?.kind === "frame") {
    const pose = page.frames.lookup(page.displays.fixedFrame.peek(), selection.frame, 0n);
    if (!(pose instanceof NoTransform)) page.views.focus(pose.position);
    return;
  }
  const chosen = selectedBodies(page, selection);
  page.views.frame(chosen.length > 0 ? page.world.bounds(chosen) : robotBox(page));
}

/** The simulated world's robot. */
export function simulatedRobot(page: Page): ScopedModel | undefined {
  return robotOf(page.world.manifest.peek());
}

/** The robot's extent in the fixed frame, or that of the whole world or of all frames; empty: there is nothing to see yet. */
export function robotBox(page: Page): Box3 {
  const manifest = page.world.manifest.peek();
  if (manifest === null) return drawnBox(page);
  const robot = simulatedRobot(page);
  const bodies = robot === undefined ? manifest.models.flatMap(bodiesOf) : bodiesOf(robot.model);
  return bodies.length > 0 ? page.world.bounds(bodies) : new Box3(new Vector3(-2, -2, 0), new Vector3(2, 2, 1));
}

/** Extent of the robot models that are drawn, else of the frames. */
function drawnBox({ displays, frames }: Page): Box3 {
  const box = new Box3();
  const shown = withMembers(displays.displays.peek(), isEnabled);
  for (const { className, root } of shown) if (className === "rviz/RobotModel") addVisible(box, root);
  if (!box.isEmpty()) return box;
  for (const frame of frames.frames.peek()) {
    const pose = frames.lookup(displays.fixedFrame.peek(), frame, 0n);
    if (!(pose instanceof NoTransform)) box.expandByPoint(pose.position);
  }
  return box.isEmpty() ? box : box.expandByScalar(0.3);
}

function addVisible(box: Box3, root: Object3D): void {
  root.updateWorldMatrix(true, true);
  root.traverseVisible((object) => {
    const { geometry } = object as Partial<Mesh>;
    if (geometry === undefined) return;
    if (geometry.boundingBox === null) geometry.computeBoundingBox();
    if (geometry.boundingBox !== null) box.union(geometry.boundingBox.clone().applyMatrix4(object.matrixWorld));
  });
}

/** True where a box shows so much else than another that the picture must change. */
export function differs(box: Box3, other: Box3): boolean {
  const [a, b] = [box, other].map((each) => each.getBoundingSphere(new Sphere()));
  if (a === undefined || b === undefined || other.isEmpty()) return true;
  return Math.abs(a.radius - b.radius) > 0.1 * b.radius || a.center.distanceTo(b.center) > 0.25 * b.radius;
}

/** Pose in the fixed frame of a frame or a body (`model::link`); null: there is none. */
export function targetPose(page: Page, target: string): Transform | null {
  const at = target.lastIndexOf("::");
  if (at < 0) {
    const found = page.frames.lookup(page.displays.fixedFrame.peek(), target, 0n);
    return found instanceof NoTransform ? null : found;
  }
  const link = findLink(page, target.slice(0, at), target.slice(at + 2));
  const object = link === null ? null : page.world.object(link.body);
  if (object === null) return null;
  object.updateWorldMatrix(true, false);
  const pose = { position: new Vector3(), orientation: new Quaternion() };
  object.matrixWorld.decompose(pose.position, pose.orientation, new Vector3());
  return pose;
}

/** Bodies with an outline: the selected link's is broad, its model's thin, and what is hovered thin. */
export function outlinedBodies(page: Page): { readonly thin: readonly number[]; readonly broad: readonly number[] } {
  const selection = placed(page.selection.value);
  if (selection?.kind === "part" && selection.part.length > 0) return { thin: selectedBodies(page, page.hovered.value), broad: selectedBodies(page, selection) };
  const isPart = selection?.kind === "link" || selection?.kind === "joint";
  const whole = isPart ? selectedBodies(page, { kind: "model", model: selection.model }) : selectedBodies(page, selection);
  return { thin: [...whole, ...selectedBodies(page, page.hovered.value)], broad: isPart ? selectedBodies(page, selection) : [] };
}
