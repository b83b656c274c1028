/** Follows the selection, or the robot, with the view. */

import { FIXED_FRAME } from "../../rviz/properties";
import { simulatedRobot } from "./framing";
import type { Page, Selection } from "../../page/page";
import { findJoint, findModel, placed } from "../../page/selection_lookup";

const TARGET = "Target Frame";

/** True while the view follows something. */
export function isFollowing({ views }: Page): boolean {
  const target = views.current.value.properties.find(({ name }) => name === TARGET);
  return target !== undefined && target.value.value !== FIXED_FRAME;
}

/** Follow the selection, otherwise the robot; a view that follows already stops. */
export function toggleFollowing(page: Page): void {
  if (isFollowing(page)) page.views.follow(null);
  else {
    const target = targetOf(page, page.selection.peek()) ?? robotTarget(page);
    if (target !== null) page.views.follow(target);
  }
}

/** Frame or body (`model::link`) of a selection; null: it has none. */
export function targetOf(page: Page, selected: Selection | null): string | null {
  const selection = placed(selected);
  switch (selection?.kind) {
    case "frame":
      return selection.frame;
    case "link":
      return `${selection.model}::${selection.link}`;
    case "joint":
      return `${selection.model}::${findJoint(page, selection.model, selection.joint)?.child ?? ""}`;
    case "model":
      return firstLink(page, selection.model);
    default:
      return null;
  }
}

function firstLink(page: Page, model: string): string | null {
  const link = findModel(page, model)?.links[0]?.name;
  return link === undefined ? null : `${model}::${link}`;
}

/** The simulated robot, else the frame of the graph that is a robot's root by its name in REP 105. */
export function robotTarget(page: Page): string | null {
  const robot = simulatedRobot(page);
  if (robot !== undefined) return firstLink(page, robot.name);
  return ["base_footprint", "base_link"].find((frame) => page.frames.frames.peek().includes(frame)) ?? null;
}
