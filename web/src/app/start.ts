/** First displays of a page: those of the session's file, or its kind's defaults. */

import { computed, effect, untracked } from "@preact/signals";

import type { Rgb } from "../rviz/properties";
import { simulatedRobot } from "./views/framing";
import { loadTf } from "./views/first_view";
import type { Shell } from "./shell";
import { bodiesOf } from "../page/world_nodes";

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
