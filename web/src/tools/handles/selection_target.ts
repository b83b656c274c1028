/** Handle targets of selections: a model, a light or a joint. */

import { Quaternion, Vector3 } from "three";

import type { Fields, Request } from "../../protocol/connection";
import type { JointInfo, LightInfo } from "../../protocol/generated/page_messages";
import type { Selection } from "../../page/page";
import { allModels, bodiesOf } from "../../page/world_nodes";
import type { HandleTarget } from "./handle_target";
import { partTarget } from "./part_target";
import type { Transform } from "../../frames/transform";
import type { SixNumbers } from "../../scene/simulated_world";
import { fixed } from "../../theme/format";
import type { WorldEditor } from "../../page/world_editor";
import { findJoint, findLink, findModel } from "../../page/selection_lookup";
import { orientationOf, poseFields } from "../../page/request_fields";

/** Handle target of a selection; null: it cannot be moved. */
export function targetOf(editor: WorldEditor, selection: Selection | null): HandleTarget | null {
  switch (selection?.kind) {
    case "model":
      return modelTarget(editor, selection.model, null);
    case "link":
      return modelTarget(editor, selection.model, selection.link);
    case "joint":
      return jointTarget(editor, selection.model, selection.joint);
    case "part":
      return partTarget(editor, selection.part);
    case "light": {
      const light = editor.world.manifest.value?.lights.find(({ name }) => name === selection.light);
      return light === undefined || light.body !== null ? null : lightTarget(light);
    }
    default:
      return null;
  }
}

function modelTarget(editor: WorldEditor, name: string, linkName: string | null): HandleTarget | null {
  const model = findModel(editor, name);
  if (model === null) return null;
  const nested = allModels([model]).find((entry) => entry.model.links.length > 0);
  const scope = nested === undefined ? name : [name, ...nested.name.split("::").slice(1)].join("::");
  const link = linkName === null ? nested?.model.links[0] : findLink(editor, name, linkName);
  if (link === undefined || link === null) return null;
  const fields = (to: Transform): Fields<"pose"> => ({
    model: linkName === null ? scope : name,
    link: link.name,
    ...poseFields(to.position, to.orientation),
  });
  const outermost = allModels(editor.world.manifest.value?.models ?? []).find((entry) =>
    `${name}::`.startsWith(`${entry.name}::`),
  );
  return {
    title: `Pose of ${name}`,
    bodies: bodiesOf(outermost?.model ?? model),
    axis: null,
    pose: () => editor.world.pose(link.body),
    begin: () => ({
      move: (to) => ({ request: "carry", fields: fields(to) }),
      release: { request: "let_go", fields: { model: name } },
      place: (to) => ({ request: "pose", fields: fields(to) }),
    }),
  };
}

function lightTarget(light: LightInfo): HandleTarget {
  const place = (to: Transform): Request => ({
    request: "place_light",
    fields: { light: light.name, ...poseFields(to.position, to.orientation) },
  });
  return {
    title: `Pose of ${light.name}`,
    bodies: [],
    axis: null,
    pose: () => transformOf(light.pose),
    begin: () => ({ move: place, release: null, place }),
  };
}

function jointTarget(editor: WorldEditor, model: string, name: string): HandleTarget | null {
  const joint = findJoint(editor, model, name);
  const [axis] = joint?.axes ?? [];
  const child = joint === null ? null : findLink(editor, model, joint.child);
  if (joint === null || child === null || axis === undefined || joint.index === null) return null;
  const index = joint.index;
  const direction = new Vector3(...axis);
  const turns = joint.type !== "prismatic";
  const pose = (): Transform | null => {
    const body = editor.world.pose(child.body);
    if (body === null) return null;
    const [x, y, z] = joint.pose;
    return {
      position: new Vector3(x, y, z).applyQuaternion(body.orientation).add(body.position),
      orientation: body.orientation,
    };
  };
  return {
    title: `Joint ${name}`,
    bodies: [child.body],
    axis: { direction, turns },
    pose,
    begin: () => {
      const start = pose();
      const from = editor.world.joints.peek().at(index)?.position ?? 0;
      const request = editor.world.state.peek()?.paused === true ? "place_joint" : "joint"; // no motor moves it while paused
      const positionAt = (to: Transform): number => {
        const by = start === null ? 0 : turns ? turnAbout(direction, start, to) : distanceAlong(direction, start, to);
        return within(joint, from + by);
      };
      const place = (to: Transform): Request => ({ request, fields: { model, joint: name, position: positionAt(to) } });
      return {
        move: place,
        release: null,
        place,
        describe: (to) => `${name} ${fixed(positionAt(to), 3)} ${turns ? "rad" : "m"}`,
      };
    },
  };
}

function transformOf([x, y, z, ...angles]: SixNumbers): Transform {
  return { position: new Vector3(x, y, z), orientation: orientationOf(angles) };
}

/** Angle about an axis of the frame, between two poses of it [rad]. */
function turnAbout(axis: Vector3, from: Transform, to: Transform): number {
  const { x, y, z, w } = from.orientation.clone().invert().multiply(to.orientation);
  const angle = 2 * Math.atan2(axis.dot(new Vector3(x, y, z)), w);
  return angle > Math.PI ? angle - 2 * Math.PI : angle <= -Math.PI ? angle + 2 * Math.PI : angle;
}

function distanceAlong(axis: Vector3, from: Transform, to: Transform): number {
  return axis.clone().applyQuaternion(from.orientation).dot(to.position.clone().sub(from.position));
}

function within({ lower, upper }: JointInfo, position: number): number {
  return Math.min(upper ?? Infinity, Math.max(lower ?? -Infinity, position));
}

/** Independent copy. */
export function copyOf({ position, orientation }: Transform): Transform {
  return { position: position.clone(), orientation: new Quaternion().copy(orientation) };
}
