/** Framing of a selection by the camera. */

import { Box3, Quaternion, Sphere, Vector3, type Mesh, type Object3D } from "three";

import { isEnabled, withMembers } from "../../displays/group";
import { NoTransform, type Transform } from "../../frames/transform";
import type { Page, Selection } from "../../page/page";
import { bodiesOf, robotOf, type ScopedModel } from "../../page/world_nodes";
import { findLink, placed, selectedBodies } from "../../page/selection_lookup";

/** Frame a selection; with none the robot, otherwise everything. */
export function frameSelection(page: Page, selection: Selection | null): void {
  if (selection?.kind === "frame") {
    const pose = page.frames.lookup(page.displays.fixedFrame.peek(), selection.frame, 0n);
    if (!(pose instanceof NoTransform)) page.views.focus(pose.position);
    return;
  }
  const chosen = selectedBodies(page, selection);
  page.views.frame(chosen.length > 0 ? page.world.bounds(chosen) : robotBox(page));
}

/**
 * Box that is framed at first: the robot stands in the lower third of the view, at a distance that depends on its size
 * alone, or all else is in the middle; the ghost of a compared recording is beside it. Empty: nothing to see yet.
 */
export function firstBox(page: Page): Box3 {
  const box = firstBoxOfRobot(page);
  const ghost = referenceBox(page);
  if (box.isEmpty() || ghost.isEmpty()) return box;
  const hasRobot = simulatedRobot(page) !== undefined || page.world.manifest.peek() === null;
  return box.union(hasRobot ? standing(ghost, ghost.getCenter(new Vector3())) : ghost);
}

function firstBoxOfRobot(page: Page): Box3 {
  const robot = simulatedRobot(page);
  const box = robotBox(page);
  if (page.world.manifest.peek() === null) return box.isEmpty() ? box : standing(box, box.getCenter(new Vector3()));
  const [root] = robot === undefined ? [] : bodiesOf(robot.model);
  const object = root === undefined ? null : page.world.object(root);
  if (robot === undefined || root === undefined || object === null) return box;
  const own = page.world.extent(bodiesOf(robot.model), root);
  return own.isEmpty() ? own : standing(own, object.localToWorld(own.getCenter(new Vector3())));
}

/** Half the height of the view, per height of a robot that stands in it, and per radius on the ground. */
const PER_HEIGHT = 0.75;
const PER_RADIUS = 3;
/** Share of half the view by which the robot's feet are below the middle. */
const BELOW = 0.5;

/** Cube around a robot of an extent whose centre is at a point, with room above it and around. */
function standing(extent: Box3, centre: Vector3): Box3 {
  const { x, y, z: height } = extent.getSize(new Vector3());
  const half = Math.max(PER_HEIGHT * height, (PER_RADIUS * Math.hypot(x, y)) / 2, SMALLEST);
  const middle = centre.clone().setZ(centre.z - height / 2 + BELOW * half);
  return new Box3().setFromCenterAndSize(middle, new Vector3().setScalar((2 * FRAMED * half) / Math.sqrt(3)));
}

/** Radius of a framed sphere per half of the view's height. */
const FRAMED = 0.9;
/** Smallest half of the view [m]. */
const SMALLEST = 0.1;
const AXES = ["x", "y", "z"] as const;

/** The simulated world's robot. */
export function simulatedRobot(page: Page): ScopedModel | undefined {
  return robotOf(page.world.manifest.peek());
}

/** Extent of the robot, the whole world or all frames, in the fixed frame; empty: nothing to see yet. */
export function robotBox(page: Page): Box3 {
  const manifest = page.world.manifest.peek();
  if (manifest === null) return drawnBox(page);
  const robot = simulatedRobot(page);
  const bodies = robot === undefined ? manifest.models.flatMap(bodiesOf) : bodiesOf(robot.model);
  return bodies.length > 0 ? page.world.bounds(bodies) : new Box3(new Vector3(-2, -2, 0), new Vector3(2, 2, 1));
}

/** Extent of the robot's ghost, or of everything's, while a recording is compared; otherwise empty. */
export function referenceBox({ world }: Page): Box3 {
  if (world.reference.peek() === null) return new Box3();
  return world.referenceBounds(robotOf(world.manifest.peek())?.name ?? null);
}

/** True if the view in which a box was framed shows all of another one. */
export function shows(framed: Box3, box: Box3): boolean {
  const { center, radius } = framed.getBoundingSphere(new Sphere());
  const [low, high] = [box.min.clone().sub(center), box.max.clone().sub(center)];
  const farthest = new Vector3(...AXES.map((axis) => Math.max(-low[axis], high[axis])));
  return farthest.length() <= radius / FRAMED;
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

/** True if two boxes differ so much that the camera must move. */
export function differs(box: Box3, other: Box3): boolean {
  const [a, b] = [box, other].map((bounds) => bounds.getBoundingSphere(new Sphere()));
  if (a === undefined || b === undefined || other.isEmpty()) return true;
  return Math.abs(a.radius - b.radius) > 0.1 * b.radius || a.center.distanceTo(b.center) > 0.25 * b.radius;
}

/** Pose in the fixed frame of a frame or a body (`model::link`); null: there is none. */
export function targetPose(page: Page, target: string): Transform | null {
  const at = target.lastIndexOf("::");
  if (at < 0) {
    const transform = page.frames.lookup(page.displays.fixedFrame.peek(), target, 0n);
    return transform instanceof NoTransform ? null : transform;
  }
  const link = findLink(page, target.slice(0, at), target.slice(at + 2));
  const object = link === null ? null : page.world.object(link.body);
  if (object === null) return null;
  object.updateWorldMatrix(true, false);
  const pose = { position: new Vector3(), orientation: new Quaternion() };
  object.matrixWorld.decompose(pose.position, pose.orientation, new Vector3());
  return pose;
}

/** Bodies with an outline: broad for the selected link, thin for its model and the hovered object. */
export function outlinedBodies(page: Page): { readonly thin: readonly number[]; readonly broad: readonly number[] } {
  const selection = placed(page.selection.value);
  if (selection?.kind === "part" && selection.part.length > 0)
    return { thin: selectedBodies(page, page.hovered.value), broad: selectedBodies(page, selection) };
  const isPart = selection?.kind === "link" || selection?.kind === "joint";
  const whole = isPart
    ? selectedBodies(page, { kind: "model", model: selection.model })
    : selectedBodies(page, selection);
  return {
    thin: [...whole, ...selectedBodies(page, page.hovered.value)],
    broad: isPart ? selectedBodies(page, selection) : [],
  };
}
