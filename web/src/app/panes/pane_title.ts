/** Title of a pane's view, over its picture. */

import { FIXED_FRAME, type Property } from "../../rviz/properties";
import type { ViewController, SixSides } from "../../scene/view_controller";

const KINDS: Readonly<Record<string, string>> = {
  "rviz/FPS": "First person",
  "rviz/FrameAligned": "First person",
  "rviz/ThirdPersonFollower": "Third person",
  "rviz/TopDownOrtho": "Top",
  "trundle/Camera": "Camera",
};
/** Yaw of the eye around the focal point, by the side that is seen [rad]. */
const SIDES: readonly (readonly [SixSides, number])[] = [
  ["front", 0],
  ["left", Math.PI / 2],
  ["back", Math.PI],
  ["right", -Math.PI / 2],
];
const CLOSE = 0.01; // rad

/** Title such as "Top", "Perspective", "First person · base_link". */
export function paneTitle({ className, properties }: ViewController): string {
  const of = (name: string): unknown =>
    properties.find((property: Property<unknown>) => property.name === name)?.value.value;
  const kind =
    KINDS[className] ??
    sideOf(Number(of("Yaw")), Number(of("Pitch"))) ??
    (of("Projection") === "Orthographic" ? "Orthographic" : "Perspective");
  const target = of("Target Frame");
  return typeof target !== "string" || target === FIXED_FRAME || target === ""
    ? kind
    : `${kind} · ${target.slice(target.lastIndexOf(":") + 1)}`;
}

/** Side of an axis-aligned view; null: the view is not axis-aligned. */
function sideOf(yaw: number, pitch: number): string | null {
  if (Math.abs(Math.abs(pitch) - Math.PI / 2) < CLOSE) return pitch > 0 ? "Top" : "Bottom";
  if (Math.abs(pitch) > CLOSE) return null;
  const side = SIDES.find(([, angle]) => Math.abs(Math.cos(yaw - angle) - 1) < CLOSE * CLOSE)?.[0];
  return side === undefined ? null : `${side.slice(0, 1).toUpperCase()}${side.slice(1)}`;
}
