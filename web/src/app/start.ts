/** First look of a page: displays of the session's file or its kind's defaults, and the robot in the middle. */

import { computed, effect, untracked } from "@preact/signals";
import { Box3, Sphere } from "three";

import type { Rgb, Yaml } from "../rviz/properties";
import type { Area } from "../scene/free_area";
import { differs, firstBox, robotBox, simulatedRobot } from "./views/framing";
import type { Shell } from "./shell";
import { linkedView, showLinkedView } from "./views/view_link";
import { bodiesOf } from "../page/world_nodes";

/** Events by which a person moves the camera, and those of any act on the page. */
const MOVES = ["pointerdown", "wheel", "keydown"] as const;
const ACTS = ["pointerdown", "keydown", "hashchange"] as const;
/** Wall seconds in which more of a robot may appear, and in which one may come into a world. */
const SETTLING = 3;
const COMING = 120;
/** Marker Scale of a robot's frames per radius [1/m]: axes are a sixth of the radius long. */
const AXES_SHARE = 0.8;
/** First view of a robot: from the front right, at a standing person's height [rad]. */
const FIRST_LOOK: Readonly<Record<string, number>> = { Yaw: -1.05, Pitch: 0.4 };
/** The scene's own background, by theme: --scene. */
const BACKGROUNDS: Readonly<Record<"dark" | "light", Rgb>> = { dark: [22, 25, 28], light: [207, 211, 214] };

export function startDisplays(shell: Shell): void {
  const { session, displays, scene, theme, world } = shell.page;
  if (session.rviz !== null) {
    for (const fault of displays.load(session.rviz.text)) shell.notices.report(session.rviz.name, fault, "warn");
  } else {
    if (session.kind === "simulation" || session.kind === "log") {
      disable(shell, "rviz/Grid"); // the world has its own
      loadTf(shell, "Show Names", false); // a person asks for them, or points at a frame
      showRobotsFrames(shell);
    }
    loadTf(shell, "Show Arrows", false);
    disable(shell, "rviz/RobotModel");
    if (session.kind === "graph") showRobot(shell);
    let ours = displays.backgroundColor.value.peek();
    effect(() => {
      const background = BACKGROUNDS[theme.value];
      if (displays.backgroundColor.value.peek() === ours) displays.backgroundColor.value.value = background;
      ours = background;
    });
  }
  if (session.fixed_frame !== null) displays.fixedFrameSetting.value = session.fixed_frame;
  followSession(shell);
  effect(() => {
    const color = displays.backgroundColor.value.value;
    if (world.manifest.value !== null) return; // the world has a background of its own
    scene.background.value = `rgb(${color.join(", ")})`;
    scene.grid.value = false;
    scene.invalidate();
  });
}

/** Follow later changes of the session's file and fixed frame, unless a person has changed the displays. */
function followSession({ page, notices, openedFile }: Shell): void {
  let shown = page.session;
  effect(() => {
    const next = page.session;
    untracked(() => {
      const { displays } = page;
      const { rviz, fixed_frame } = next;
      const isOther =
        rviz !== null &&
        openedFile.value === null &&
        rviz.text !== shown.rviz?.text &&
        displays.changes.value === 0 &&
        displays.save() !== rviz.text;
      if (isOther) for (const fault of displays.load(rviz.text)) notices.report(rviz.name, fault, "warn");
      if (fixed_frame !== null && (isOther || fixed_frame !== shown.fixed_frame))
        displays.fixedFrameSetting.value = fixed_frame;
      shown = next;
    });
  });
}

function disable({ page }: Shell, className: string): void {
  for (const display of page.displays.displays.peek())
    if (display.className === className) display.enabled.decode(false);
}

function loadTf({ page }: Shell, name: string, yaml: Yaml): void {
  const tf = page.displays.displays.peek().find(({ className }) => className === "rviz/TF");
  tf?.properties.find((property) => property.name === name)?.load(yaml);
}

/** Show only the robot's frames of a simulated world, and select the robot. */
function showRobotsFrames(shell: Shell): void {
  const { page } = shell;
  const stop = page.world.manifest.subscribe((manifest) => {
    const robot = simulatedRobot(page);
    if (manifest === null) return;
    queueMicrotask(() => stop()); // also if it is defined already
    if (robot === undefined) return;
    const bodies = new Set(bodiesOf(robot.model));
    const others = manifest.frames.filter(({ body }) => !bodies.has(body));
    loadTf(shell, "Frames", Object.fromEntries(others.map(({ frame }) => [frame, { Value: false }])));
    page.selection.value ??= { kind: "model", model: robot.name };
  });
}

/** Show the robot once its description is published. */
function showRobot({ page }: Shell): void {
  const { connection, displays } = page;
  const described = computed(() => connection.parameters.value.has("/robot_description"));
  const stop = described.subscribe((isDescribed) => {
    if (!isDescribed) return;
    for (const display of displays.displays.peek())
      if (display.className === "rviz/RobotModel") display.enabled.decode(true);
    queueMicrotask(() => stop()); // also if it is defined already
  });
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

/**
 * Frame the robot once it appears, unless a file has a view or a person has moved the camera.
 *
 * Dock, tiles and disc come in any order: it is framed again for the part that they leave free, until a person acts.
 */
export function startView(shell: Shell): void {
  const { page } = shell;
  const { session, world, scene, views } = page;
  if (showLinked(shell) || session.rviz !== null) return;
  for (const property of views.current.peek().properties) {
    const first = FIRST_LOOK[property.name];
    if (first !== undefined) property.decode(first);
  }
  const framed = new Box3();
  let room: Area | null = null; // for which it was framed
  let [isSettled, isTouched] = [false, false];
  let age = 0;
  const isLoading = (): boolean =>
    world.manifest.peek() === null
      ? session.kind === "simulation" || session.kind === "log"
      : world.progress.peek() < 1;
  const stop = scene.onTick((elapsed) => {
    age += elapsed;
    if (!framed.isEmpty() && (age > COMING || (isSettled && isTouched))) leave();
    if (isLoading()) return;
    const isWorld = world.manifest.peek() !== null;
    const hasRobot = simulatedRobot(page) !== undefined;
    const mayGrow = framed.isEmpty() || (!isSettled && (hasRobot || !isWorld));
    const box = mayGrow ? firstBox(page) : framed;
    if (box.isEmpty()) return;
    const free = scene.freePart.peek();
    if (differs(box, framed) || (!isTouched && !isAsLarge(free, room))) {
      room = free;
      views.frameInAll(framed.copy(box));
      const { radius } = robotBox(page).getBoundingSphere(new Sphere());
      loadTf(shell, "Marker Scale", Number((AXES_SHARE * radius).toPrecision(1)));
    }
    isSettled ||= hasRobot || (!isWorld && age > SETTLING);
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

function isAsLarge(area: Area, other: Area | null): boolean {
  return area.width === other?.width && area.height === other.height;
}
