/** Pictures of the part of the view that no panel covers, for a video in wall time. */

import { freeArea } from "../../scene/free_area";
import type { SceneView } from "../../scene/scene_view";
import type { Recording } from "./recording";
import { RATE } from "./video_file";

/** Hand the pictures to a recording; returns a function that stops. */
export function recordView(scene: SceneView, recording: Recording): () => void {
  const period = 1000 / RATE;
  const draw = (): void => scene.invalidate(); // also draws while nothing moves
  let next = performance.now();
  let timer = setTimeout(draw, period);
  const removeStep = scene.addStep({
    after: () => {
      const now = performance.now();
      if (now < next) return;
      next = Math.max(next + period, now);
      clearTimeout(timer);
      timer = setTimeout(draw, period); // not before: a slow machine needs time for the rest of the page
      const { element } = scene;
      const { width, height } = scene.size.peek();
      const area = freeArea(width, height, scene.freeArea.peek());
      const scale = element.width / width;
      const [left, top] = [area.left * scale, area.top * scale];
      recording.add(element, { left, top, width: area.width * scale, height: area.height * scale }, now / 1000);
    },
  });
  return () => {
    clearTimeout(timer);
    removeStep();
  };
}
