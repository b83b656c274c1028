/** First view of a page: that of its address, or the robot in the middle of each pane, beside what it is compared with. */

import { Box3, Sphere } from "three";

import type { Yaml } from "../../rviz/properties";
import type { Area } from "../../scene/free_area";
import type { ViewPane } from "../../scene/view_controller";
import type { Page } from "../../page/page";
import type { Shell } from "../shell";
import { differs, firstBox, referenceBox, robotBox, shows, simulatedRobot } from "./framing";
import { linkedView, showLinkedView } from "./view_link";

/** Events by which a person moves the camera, and those of any act on the page. */
const MOVES = ["pointerdown", "wheel", "keydown"] as const;
const ACTS = ["pointerdown", "keydown", "hashchange"] as const;
/** Wall seconds in which more of a robot may appear, and in which one may come into a world. */
const SETTLING = 3;
const COMING = 120;
/** Period of the look at a compared recording [s], and the room around what has left the view, per radius. */
const PERIOD = 0.25;
const ROOM = 0.25;
/** Marker Scale of a robot's frames per radius [1/m]: axes are a sixth of the radius long. */
const AXES_SHARE = 0.8;
/** First view of a robot: from the front right, at a standing person's height [rad]. */
const FIRST_LOOK: Readonly<Record<string, number>> = { Yaw: -1.05, Pitch: 0.4 };

/**
 * Frame the robot once it appears, unless a file has a view or a person has moved the camera.
 *
 * Dock, tiles and disc come in any order: it is framed again for the part that they leave free, until a person acts.
 * While a recording is compared, robot and ghost stay in the view, until a person moves the camera.
 */
export function startView(shell: Shell): void {
  const { page } = shell;
  const { session, scene, views } = page;
  if (showLinked(shell) || session.rviz !== null) return;
  for (const property of views.current.peek().properties) {
    const first = FIRST_LOOK[property.name];
    if (first !== undefined) property.decode(first);
  }
  views.active.peek().isChosen.value = false;
  const framed = new Box3();
  /** Parts of the panes for which it was framed. */
  const rooms = new Map<ViewPane, Area>();
  let [isSettled, isTouched] = [false, false];
  let [age, sinceLook] = [0, 0];
  /** Box to frame. */
  const boxNow = (elapsed: number): Box3 => {
    const isWorld = page.world.manifest.peek() !== null;
    const hasRobot = simulatedRobot(page) !== undefined;
    const mayGrow = framed.isEmpty() || (!isSettled && (hasRobot || !isWorld));
    isSettled ||= hasRobot || (!isWorld && age > SETTLING);
    if (mayGrow) return firstBox(page);
    sinceLook += elapsed;
    if (sinceLook < PERIOD) return framed;
    sinceLook = 0;
    return hasReferenceLeft(page, framed) ? withRoom(firstBox(page)) : framed;
  };
  const stop = scene.onTick((elapsed) => {
    age += elapsed;
    if (views.panes.peek().every(({ isChosen }) => isChosen.peek())) leave();
    const isOver = !framed.isEmpty() && (age > COMING || (isSettled && isTouched));
    if (isLoading(page) || (isOver && page.world.reference.peek() === null)) return;
    const box = boxNow(elapsed);
    if (box.isEmpty()) return;
    const isOther = differs(box, framed);
    const fits = (pane: ViewPane): boolean => isTouched || isAsLarge(pane.free.peek(), rooms.get(pane));
    const panes = views.panes.peek().filter((pane) => isOther || !fits(pane));
    if (panes.length === 0) return;
    framed.copy(box);
    for (const pane of panes) {
      rooms.set(pane, pane.free.peek());
      pane.frameFirst(framed);
    }
    scaleFrames(shell);
  });
  const touch = (): void => {
    isTouched = true;
  };
  const leave = (): void => {
    stop();
    for (const kind of MOVES) scene.element.removeEventListener(kind, leave);
    for (const kind of ACTS) removeEventListener(kind, touch, true);
  };
  for (const kind of MOVES) scene.element.addEventListener(kind, leave);
  for (const kind of ACTS) addEventListener(kind, touch, true);
}

/** Set a property of the TF display. */
export function loadTf({ page }: Shell, name: string, yaml: Yaml): void {
  const tf = page.displays.displays.peek().find(({ className }) => className === "rviz/TF");
  tf?.properties.find((property) => property.name === name)?.load(yaml);
}

/** Show the view of the page's address, now and whenever it changes; true: the address has one. */
function showLinked(shell: Shell): boolean {
  const show = (): boolean => {
    const linked = linkedView(location.hash);
    if (linked !== null) showLinkedView(shell.page.views, shell.split, linked);
    return linked !== null;
  };
  addEventListener("hashchange", show);
  return show();
}

function isLoading({ session, world }: Page): boolean {
  return world.manifest.peek() === null
    ? session.kind === "simulation" || session.kind === "log"
    : world.progress.peek() < 1;
}

/** True if the robot or the ghost beside it is not in the view in which a box was framed. */
function hasReferenceLeft(page: Page, framed: Box3): boolean {
  const ghost = referenceBox(page);
  return !ghost.isEmpty() && !shows(framed, ghost.union(robotBox(page)));
}

function withRoom(box: Box3): Box3 {
  return box.expandByScalar((ROOM * box.getBoundingSphere(new Sphere()).radius) / Math.sqrt(3));
}

/** Fit the axes of the robot's frames to its size. */
function scaleFrames(shell: Shell): void {
  const { radius } = robotBox(shell.page).getBoundingSphere(new Sphere());
  loadTf(shell, "Marker Scale", Number((AXES_SHARE * radius).toPrecision(1)));
}

function isAsLarge(area: Area, other: Area | undefined): boolean {
  return area.width === other?.width && area.height === other.height;
}
