/** Waits for the first picture, which a person waits for; everything else loads after it. */

import { effect } from "@preact/signals";

import type { Page } from "../page/page";

/** Longest wait for it [ms]: a large world takes longer to load. */
const PATIENCE = 2000;

/** Wait until the simulated world is drawn, or, where there is none, the scene. */
export function firstPicture({ session, scene, world }: Page): Promise<void> {
  return new Promise((resolve) => {
    const isWorld = session.kind === "simulation" || session.kind === "log";
    if (scene.status.peek().kind === "unsupported") resolve();
    else if (isWorld)
      effect(() => {
        if (world.isDrawn.value) setTimeout(resolve);
      });
    else {
      const stop = scene.addStep({
        after: () => {
          stop();
          setTimeout(resolve);
        },
      });
    }
    setTimeout(resolve, PATIENCE);
  });
}
