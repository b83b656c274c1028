/**
 * Offers to follow the robot when it has left a view that nobody moves, or drives behind the controls over it; whoever
 * drives it there has no hand free, and the view follows if nobody has chosen it.
 */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect } from "preact/hooks";
import { Matrix4, Vector3 } from "three";

import { toPicture } from "../../scene/picking";
import { Button } from "../../theme/button";
import type { Page } from "../../page/page";
import type { Shell } from "../shell";
import { isFollowing, robotTarget } from "./following";
import { robotBox, simulatedRobot, targetPose } from "./framing";

/** Period of the check [s]. */
const PERIOD = 0.25;
/** Elements that cover the scene, and elements that cover it only for a moment. */
const CONTROLS = ".panel, .scene-overlay :is(.float, .disc, .tile)";
const PASSING = ".menu, .notice";

type Place = "seen" | "covered" | "left";
const TEXTS: Readonly<Record<Exclude<Place, "seen">, string>> = {
  covered: "is behind the controls",
  left: "has left the view",
};

/** Why the robot is not visible, and its frame or `model::link`. */
interface Unseen {
  readonly place: keyof typeof TEXTS;
  readonly target: string;
}

export function FollowOffer({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const { page } = shell;
  const unseen = useSignal<Unseen | null>(null);
  useEffect(
    () =>
      watchRobot(page, (now, isNew) => {
        if (now !== null && isNew && isDriven(page)) page.views.follow(now.target);
        else if (isNew || unseen.value !== null) unseen.value = now;
      }),
    [page],
  );
  if (unseen.value === null || isFollowing(page)) return null;
  const { place, target } = unseen.value;
  const close = (): void => {
    unseen.value = null;
  };
  return (
    <div class="notice float" role="status">
      <span class="said">
        {shell.robot.value ?? "The robot"} {TEXTS[place]}
      </span>
      <Button
        class="lk"
        onClick={() => {
          page.views.follow(target);
          close();
        }}
      >
        Follow
      </Button>
      <Button icon="close" label="Do not follow" onClick={close} />
    </div>
  );
}

/** True while the person here drives, in a view that nobody has chosen. */
function isDriven({ drive, views }: Page): boolean {
  return drive.command.peek() !== null && !views.active.peek().isChosen.peek();
}

/** Tell where the robot is if it is not seen, at first and while it stays so, and when it is seen again (null). */
function watchRobot(page: Page, tell: (unseen: Unseen | null, isNew: boolean) => void): () => void {
  const camera = new Matrix4();
  let since = 0;
  let wasSeen = false;
  return page.scene.onTick((elapsed) => {
    since += elapsed;
    if (since < PERIOD) return;
    since = 0;
    const target = robotTarget(page);
    const place = target === null ? null : placeOf(page, target);
    const { matrixWorld } = page.scene.camera.peek();
    const isStill = camera.equals(matrixWorld);
    camera.copy(matrixWorld);
    if (target === null || place === null || place === "seen") tell(null, false);
    else tell({ place, target }, wasSeen && isStill);
    wasSeen = place === "seen";
  });
}

/** Place of the robot's middle, or without an extent, of its frame's origin. */
function placeOf(page: Page, target: string): Place {
  const { element, camera, paneSize } = page.scene;
  const middle =
    simulatedRobot(page) === undefined
      ? targetPose(page, target)?.position.clone()
      : robotBox(page).getCenter(new Vector3());
  const { width, height } = paneSize.peek();
  const at = middle === undefined ? null : toPicture(middle, camera.peek(), { width, height });
  if (at === null || at.x < 0 || at.x > width || at.y < 0 || at.y > height) return "left";
  const { left, top } = element.getBoundingClientRect();
  const over = document.elementFromPoint(left + at.x, top + at.y);
  return over?.closest(CONTROLS) != null && over.closest(PASSING) === null ? "covered" : "seen";
}
