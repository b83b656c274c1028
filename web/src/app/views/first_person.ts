/** Views from objects of the world: first person from a model or link, and through a simulated camera. */

import type { CameraInfo } from "../../protocol/generated/page_messages";
import { isFollowing, robotTarget, targetOf } from "./following";
import type { Command, Page } from "../../page/page";
import { allModels } from "../../page/world_nodes";
import { selectedBodies } from "../../page/selection_lookup";

/** Height of the first person's eye over the body [m]. */
const OVER = 0.05;

/** Look ahead from above the selection, otherwise the robot; a second call returns to an orbit. */
export function toggleFirstPerson(page: Page): void {
  const { views, selection, world } = page;
  if (views.current.peek().className === "rviz/FrameAligned" && isFollowing(page)) {
    views.use("rviz/Orbit");
    views.follow(null);
    return;
  }
  const target = targetOf(page, selection.peek()) ?? robotTarget(page);
  if (target === null) return;
  const at = target.lastIndexOf("::");
  const link = { kind: "link", model: target.slice(0, Math.max(0, at)), link: target.slice(at + 2) } as const;
  const [body] = selectedBodies(page, link);
  const height =
    body === undefined
      ? 0
      : world.bounds(selectedBodies(page, { kind: "model", model: link.model })).max.z -
        (world.object(body)?.position.z ?? 0);
  views.ride(target, [0, 0, height + OVER]);
}

export function lookThrough({ views, world }: Page, camera: CameraInfo): void {
  for (const { name, model } of allModels(world.manifest.peek()?.models ?? [])) {
    const link = model.links.find(({ body }) => body === camera.body);
    if (link !== undefined) views.lookThrough(camera, `${name}::${link.name}`);
  }
}

/** A command for each simulated camera. */
export function cameraCommands(page: Page): readonly Command[] {
  const cameras = page.world.manifest.value?.cameras ?? [];
  return cameras.map((camera) => ({
    id: `through.${camera.topic}`,
    title: `Look through ${camera.name}`,
    group: "View",
    run: () => lookThrough(page, camera),
  }));
}
