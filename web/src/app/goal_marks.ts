/** Arrows with numbers in the scene, at the goals of the queue. */

import { effect, untracked } from "@preact/signals";

import { looksSame, NoTransform } from "../frames/transform";
import { quaternion, vector } from "../frames/valid";
import type { QueuedGoal } from "../page/goal_queue";
import type { Page } from "../page/page";
import { NOT_PICKED } from "../scene/picking";
import { Arrow } from "../shapes/arrow";

/** [m] */
const PROPORTIONS = { shaftLength: 0.3, shaftDiameter: 0.05, headLength: 0.15, headDiameter: 0.14 };
const COLOR = [255, 0, 255] as const; // the color of rviz's 2D Nav Goal
const PAST_ALPHA = 0.3;

interface GoalMark {
  readonly arrow: Arrow;
  /** Put the arrow at its goal's pose in the fixed frame; it is hidden without a transform. */
  place(): void;
  remove(): void;
}

/** Keep a mark at each goal of the queue. */
export function markGoals(page: Page): void {
  effect(() => {
    const goals = page.goals.goals.value;
    const marks = untracked(() => goals.map((goal) => markOf(page, goal)));
    const place = (): void => marks.forEach((mark) => mark.place());
    place();
    page.scene.invalidate();
    const stop = marks.length > 0 ? page.scene.onTick(place) : null;
    return () => {
      stop?.();
      marks.forEach((mark) => mark.remove());
      page.scene.invalidate();
    };
  });
}

function markOf({ scene, frames, displays }: Page, { number, frame, pose, state }: QueuedGoal): GoalMark {
  const arrow = new Arrow(PROPORTIONS);
  const isPast = state === "reached" || state === "failed" || state === "canceled";
  arrow.setColor(COLOR, isPast ? PAST_ALPHA : 1);
  arrow.userData[NOT_PICKED] = true;
  const label = scene.addLabel(arrow, String(number));
  scene.displays.add(arrow);
  const position = vector(pose.position);
  const orientation = quaternion(pose.orientation);
  return {
    arrow,
    place() {
      const transform = frames.lookup(displays.fixedFrame.peek(), frame, 0n);
      const isHidden = transform instanceof NoTransform;
      if (!isHidden) {
        const at = {
          position: position.clone().applyQuaternion(transform.orientation).add(transform.position),
          orientation: transform.orientation.clone().multiply(orientation),
        };
        if (arrow.visible && looksSame(arrow.position, arrow.quaternion, at)) return;
        arrow.position.copy(at.position);
        arrow.quaternion.copy(at.orientation);
      } else if (!arrow.visible) return;
      arrow.visible = !isHidden;
      scene.invalidate();
    },
    remove() {
      label.remove();
      arrow.removeFromParent();
      arrow.dispose();
    },
  };
}
