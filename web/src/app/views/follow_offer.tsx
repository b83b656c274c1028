/** Offers to follow the robot when it has left a view that nobody moves. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect } from "preact/hooks";
import { Matrix4 } from "three";

import { toPicture } from "../../scene/picking";
import { Button } from "../../theme/button";
import type { Page } from "../../page/page";
import type { Shell } from "../shell";
import { isFollowing, robotTarget } from "./following";
import { targetPose } from "./framing";

/** Period of the look [s]. */
const PERIOD = 0.25;

export function FollowOffer({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const { page } = shell;
  const target = useSignal<string | null>(null);
  useEffect(
    () =>
      watchLeaving(page, (left) => {
        target.value = left;
      }),
    [page],
  );
  const left = target.value;
  if (left === null || isFollowing(page)) return null;
  const close = (): void => {
    target.value = null;
  };
  return (
    <div class="notice float" role="status">
      <span class="said">{shell.robot.value ?? "The robot"} has left the view</span>
      <Button
        class="lk"
        onClick={() => {
          page.views.follow(left);
          close();
        }}
      >
        Follow
      </Button>
      <Button icon="close" label="Do not follow" onClick={close} />
    </div>
  );
}

/** Tell when the robot leaves the view (its frame or `model::link`), and when it is back (null). */
function watchLeaving(page: Page, tell: (target: string | null) => void): () => void {
  const camera = new Matrix4();
  let since = 0;
  let wasInside = false;
  return page.scene.onTick((elapsed) => {
    since += elapsed;
    if (since < PERIOD) return;
    since = 0;
    const target = robotTarget(page);
    const isInside = target !== null && isInView(page, target);
    const { matrixWorld } = page.scene.camera.peek();
    const isStill = camera.equals(matrixWorld);
    camera.copy(matrixWorld);
    if (isInside) tell(null);
    else if (wasInside && isStill) tell(target);
    wasInside = isInside;
  });
}

function isInView(page: Page, target: string): boolean {
  const { scene } = page;
  const position = targetPose(page, target)?.position;
  if (position === undefined) return false;
  const at = toPicture(position.clone(), scene.camera.peek(), scene.paneSize.peek());
  const { left, top, width, height } = scene.freePart.peek();
  return at !== null && at.x >= left && at.x <= left + width && at.y >= top && at.y <= top + height;
}
