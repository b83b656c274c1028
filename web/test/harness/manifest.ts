/** The world of the design's pictures. */

import type { JointInfo, LinkInfo, Manifest, ModelInfo, SensorInfo } from "../../src/protocol/generated/page_messages";

let body = 0;

function link(name: string, mass: number, ...sensors: SensorInfo[]): LinkInfo {
  body += 1;
  return {
    name,
    mass,
    body,
    sensors,
    inertia: [0.0428, 0.0453, 0.08, 0, 0, 0],
    inertial_pose: [0, 0, 0, 0, 0, 0],
    friction: [1, 1],
    source: "rp2w/model.sdf:8",
  };
}

function joint(
  name: string,
  type: string,
  index: number | null,
  limit: number | null,
  parent: string,
  child: string,
): JointInfo {
  return {
    name,
    type,
    parent,
    child,
    lower: limit === null ? null : -limit,
    upper: limit,
    pose: [0, 0, 0, 0, 0, 0],
    axes: [[0, 0, 1]],
    index,
    source: "rp2w/model.sdf:80",
  };
}

function model(name: string, links: LinkInfo[], isStatic: boolean, extra: Partial<ModelInfo> = {}): ModelInfo {
  return { name, static: isStatic, held: false, source: null, links, joints: [], plugins: [], models: [], ...extra };
}

const camera = (name: string): SensorInfo => ({
  name,
  type: "camera",
  rate: 30,
  series: [],
  topic: `/${name}/image_raw`,
  source: "rp2w/model.sdf:50",
  plugins: [],
});

const robot = model(
  "rp2w",
  [
    link("chassis", 3),
    link("body", 1.5, camera("netbook_webcam")),
    link("camera_base", 0.1),
    link("camera", 0.1, camera("my_sensor")),
    link("right_wheel", 0.5),
    link("left_wheel", 0.5),
    link("front_wheel", 0.5),
  ],
  false,
  {
    joints: [
      joint("chassis_body", "fixed", null, null, "chassis", "body"),
      joint("body_camera_base", "revolute", 0, 3, "body", "camera_base"),
      joint("camera_base_camera", "revolute", 1, 1.57, "camera_base", "camera"),
      joint("chassis_right_wheel", "continuous", 2, null, "chassis", "right_wheel"),
      joint("chassis_left_wheel", "continuous", 3, null, "chassis", "left_wheel"),
      joint("body_front_wheel_y", "continuous", 4, null, "body", "front_wheel"),
    ],
    plugins: [{ name: "rp2w", filename: "librp2w.so", source: "rp2w/model.sdf:210", parameters: [["speed", "0.5"]] }],
  },
);

export const MANIFEST: Manifest = {
  file: null,
  generation: 1,
  name: "rp2w_at_home",
  files: [],
  collisions: null,
  scene: { ambient: [0.4, 0.4, 0.4], background: [0.7, 0.7, 0.7], sky: false, shadows: true, grid: true, fog: null },
  physics: { gravity: [0, 0, -9.8], wind: [0, 0, 0], step: 0.001 },
  robot: 1,
  models: [
    robot,
    model("living_room", [link("walls", 0), link("sofa", 0)], true),
    model("ball", [link("link", 0.3)], false),
    model("ground_plane", [link("link", 0)], true),
  ],
  plugins: [],
  lights: [
    {
      name: "sun",
      type: "directional",
      body: null,
      pose: [0, 0, 5, 0, 0, 0],
      direction: [0, 0, -1],
      diffuse: [1, 1, 1],
      intensity: 1,
    },
    {
      name: "lamp",
      type: "point",
      body: null,
      pose: [1, 0, 2, 0, 0, 0],
      direction: [0, 0, -1],
      diffuse: [1, 0.9, 0.8],
      intensity: 1,
    },
  ],
  cameras: ["netbook_webcam", "my_sensor"].map((name) => ({
    name,
    topic: `/${name}/image_raw`,
    body: 2,
    pose: [0, 0, 0, 0, 0, 0],
    horizontal_fov: 1,
    near: 0.1,
    far: 8,
    width: 320,
    height: 240,
    rate: 30,
  })),
  frames: [],
  resources: [],
  draft: null,
  reference: null,
};
