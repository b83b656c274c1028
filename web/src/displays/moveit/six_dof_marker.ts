/** Interactive marker with handles for six degrees of freedom, which the page itself serves. */

import type {
  InteractiveMarker,
  InteractiveMarkerControl,
  Marker,
  Pose,
  Quaternion,
} from "../../protocol/generated/ros_messages";
import type { Rgb } from "../../rviz/properties";
import { InteractionMode, OrientationMode } from "../interactive/control_modes";
import { Type } from "../markers/marker_type";

const HALF = Math.SQRT1_2;
/** Turns of the handles' x axis to x, y, z, as rviz's tools write them. */
const AXES: readonly (readonly [string, Quaternion])[] = [
  ["x", { x: HALF, y: 0, z: 0, w: HALF }],
  ["y", { x: 0, y: 0, z: HALF, w: HALF }],
  ["z", { x: 0, y: HALF, z: 0, w: HALF }],
];
const HERE: Pose = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
const NO_TIME = { sec: 0, nsec: 0 } as const;
/** Name of the control in the middle, and its diameter as a ratio of the marker's size. */
export const BALL = "move_3d";
const BALL_SIZE = 0.3;

/** Marker at a pose of a frame: rings that turn it, arrows that move it, and a ball that moves it in the picture. */
export function sixDofMarker(
  name: string,
  frame: string,
  pose: Pose,
  scale: number,
  [red, green, blue]: Rgb,
): InteractiveMarker {
  const header = { seq: 0, stamp: NO_TIME, frame_id: frame };
  const control = (
    title: string,
    mode: number,
    orientation: Quaternion,
    markers: readonly Marker[],
  ): InteractiveMarkerControl => ({
    name: title,
    orientation,
    orientation_mode: OrientationMode.inherit,
    interaction_mode: mode,
    always_visible: false,
    markers,
    independent_marker_orientation: false,
    description: "",
  });
  const ball: Marker = {
    header: { ...header, frame_id: "" },
    ns: name,
    id: 0,
    type: Type.sphere,
    action: 0,
    pose: HERE,
    scale: { x: BALL_SIZE * scale, y: BALL_SIZE * scale, z: BALL_SIZE * scale },
    color: { r: red / 255, g: green / 255, b: blue / 255, a: 0.6 },
    lifetime: NO_TIME,
    frame_locked: true,
    points: [],
    colors: [],
    text: "",
    mesh_resource: "",
    mesh_use_embedded_materials: false,
  };
  return {
    header,
    pose,
    name,
    description: "",
    scale,
    menu_entries: [],
    controls: [
      ...AXES.flatMap(([axis, turn]) => [
        control(`rotate_${axis}`, InteractionMode.rotateAxis, turn, []),
        control(`move_${axis}`, InteractionMode.moveAxis, turn, []),
      ]),
      control(BALL, InteractionMode.move3D, HERE.orientation, [ball]),
    ],
  };
}
