/** Handle targets of the edited model: a link, or the whole model. */

import { Matrix4, Quaternion, Vector3, type Object3D } from "three";

import type { Transform } from "../../frames/transform";
import type { SixNumbers } from "../../scene/simulated_world";
import type { Request } from "../../protocol/connection";
import type { Drawn, HandleTarget } from "./handle_target";
import type { WorldEditor } from "../../page/world_editor";
import { findPart, linkAround, type PartPath, bodiesOfPart } from "../../scene/draft";
import { orientationOf, poseFields } from "../../page/request_fields";

/** Handle target of a part's link, or of the model; null: the part cannot be moved. */
export function partTarget(editor: WorldEditor, path: PartPath): HandleTarget | null {
  const { world } = editor;
  const draft = world.manifest.value?.draft ?? null;
  const part = path.length === 0 ? path : linkAround(path);
  if (draft === null || part === null || part.length > 2 || findPart(draft, part) === null) return null;
  const bodies = bodiesOfPart(draft, part);
  const [first] = bodies;
  world.progress.value; // eslint-disable-line @typescript-eslint/no-unused-expressions -- its objects come later
  return {
    title: `Pose of ${part.at(-1) ?? draft.name}`,
    bodies,
    axis: null,
    isRemembered: true,
    pose: () => {
      if (part.length === 0) return transformOf(draft.pose);
      const object = first === undefined ? null : world.object(first);
      return object === null ? null : { position: object.position.clone(), orientation: object.quaternion.clone() };
    },
    begin: () =>
      drag(
        bodies.flatMap((body) => world.object(body) ?? []),
        part,
        part.length === 0 ? transformOf(draft.pose) : null,
      ),
  };
}

/** Drag of objects with the pointer; the server is sent the last pose. */
function drag(objects: readonly Object3D[], part: PartPath, whole: Transform | null): Drawn {
  const [first] = objects;
  const from = whole ?? {
    position: first?.position.clone() ?? new Vector3(),
    orientation: first?.quaternion.clone() ?? new Quaternion(),
  };
  const starts = objects.map((object) => matrixOf({ position: object.position, orientation: object.quaternion }));
  const place = (to: Transform): Request => ({
    request: "draft_place",
    fields: { part, ...poseFields(to.position, to.orientation) },
  });
  return {
    move: (to) => {
      const change = matrixOf(to).multiply(matrixOf(from).invert());
      objects.forEach((object, i) => {
        const start = starts[i];
        if (start !== undefined)
          change.clone().multiply(start).decompose(object.position, object.quaternion, new Vector3());
      });
      return null;
    },
    release: null,
    place,
  };
}

function matrixOf({ position, orientation }: Transform): Matrix4 {
  return new Matrix4().compose(position, orientation, new Vector3(1, 1, 1));
}

function transformOf([x, y, z, ...angles]: SixNumbers): Transform {
  return { position: new Vector3(x, y, z), orientation: orientationOf(angles) };
}
