/** The dock's panels on a fake graph that moves; the address opens one: `#rqt_plot&theme=light`. */

import { signal } from "@preact/signals";

import { mount } from "../../src/app/mount";
import type { FrameInfo } from "../../src/frames/frame_tree";
import { panels } from "../../src/panels";
import { FakeConnection } from "../fake_connection";
import { fakePage } from "../fake_page";
import { MANIFEST } from "./manifest";

const [program = "", ...options] = location.hash.slice(1).split("&");
const state = new URLSearchParams(options.join("&"));
const TWIST = `geometry_msgs/Vector3 linear
geometry_msgs/Vector3 angular
===
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
`;

const page = fakePage({
  panels: [program],
  plots:
    program === "rqt_plot"
      ? ["/odom/twist/twist/linear/x", "/cmd_vel/linear/x", "/joint_states/position[left_wheel]"]
      : [],
  sliders:
    program === "joint_state_publisher_gui"
      ? [
          { name: "arm", lower: -1, upper: 2, position: 0.3 },
          { name: "lift", lower: 0, upper: 1, position: 0.1 },
        ]
      : [],
  joystick: true,
  images: program === "rqt_image_view" ? ["/camera/image_raw", "/depth/image_raw"] : [],
});
const { connection } = page;
for (const [name, type] of Object.entries({
  "/scan": "sensor_msgs/LaserScan",
  "/odom": "nav_msgs/Odometry",
  "/cmd_vel": "geometry_msgs/Twist",
  "/joint_states": "sensor_msgs/JointState",
  "/camera/image_raw": "sensor_msgs/Image",
  "/depth/image_raw": "sensor_msgs/Image",
  "/move_base/NavfnROS/plan": "nav_msgs/Path",
  "/rosout": "rosgraph_msgs/Log",
  "/camera/parameter_descriptions": "dynamic_reconfigure/ConfigDescription",
  "/camera/parameter_updates": "dynamic_reconfigure/Config",
}))
  connection.advertise(name, type);
connection.definitions.set("geometry_msgs/Twist", TWIST);
connection.services.value = new Map(
  [
    {
      name: "/spawn",
      type: "turtlesim/Spawn",
      request: "float32 x\nfloat32 y\nfloat32 theta\nstring name\n",
      response: "string name\n",
    },
    { name: "/clear", type: "std_srvs/Empty", request: "", response: "" },
  ].map((service) => [service.name, service]),
);
connection.answers.set("/spawn", (request) => ({ name: request["name"] ?? "turtle2" }));
connection.parameters.value = new Map<string, string | number | boolean | readonly number[]>([
  ["/robot_description", '<robot name="rp2w">…'],
  ["/use_sim_time", true],
  ["/move_base/controller_frequency", 20],
  ["/move_base/planner/tolerance", 0.05],
  ["/move_base/footprint", [0.1, 0.2, 0.3]],
  ["/rosdistro", "noetic"],
]);
connection.floatParameters.value = new Set(["/move_base/controller_frequency", "/move_base/planner/tolerance"]);
connection.graph.value = {
  types: new Map([["/initialpose", "geometry_msgs/PoseWithCovarianceStamped"]]),
  publishers: new Map([
    ["/scan", ["/gazebo"]],
    ["/odom", ["/gazebo"]],
    ["/cmd_vel", ["/move_base"]],
    ["/joint_states", ["/gazebo"]],
    ["/map", ["/map_server"]],
    ["/amcl_pose", ["/amcl"]],
    ["/tf", ["/gazebo", "/amcl", "/robot_state_publisher"]],
    ["/rosout", ["/gazebo"]],
  ]),
  subscribers: new Map([
    ["/scan", ["/amcl", "/move_base"]],
    ["/odom", ["/move_base"]],
    ["/cmd_vel", ["/gazebo"]],
    ["/joint_states", ["/robot_state_publisher"]],
    ["/map", ["/amcl", "/move_base"]],
    ["/tf", ["/amcl", "/move_base"]],
    ["/rosout", ["/rosout"]],
    ["/initialpose", ["/amcl"]],
  ]),
  services: new Map([
    ["/spawn", ["/turtlesim"]],
    ["/clear", ["/turtlesim"]],
  ]),
};

const frame = (name: string, parent: string | null, changes: Partial<FrameInfo> = {}): FrameInfo => ({
  name,
  parent,
  isStatic: false,
  stamp: connection.time,
  rate: 30,
  publisher: "/gazebo",
  ...changes,
});
Object.assign(page.frames, {
  describe: (): readonly FrameInfo[] => [
    frame("map", null),
    frame("odom", "map", { publisher: "/amcl", rate: 10 }),
    frame("base_link", "odom"),
    frame("laser", "base_link", { isStatic: true, rate: null, stamp: 0n }),
    frame("left_wheel", "base_link"),
    frame("right_wheel", "base_link"),
    frame("old_arm", "base_link", { stamp: connection.time - 14_000_000_000n, rate: null }),
    frame("tag_7", "camera_optical", { publisher: "/detector" }),
    frame("camera_optical", null),
  ],
});
page.displays.fixedFrame.value = "map";

page.world.manifest.value = MANIFEST;
const timeline = state.get("bag") === null ? {} : { timeline: { start_ns: 0, end_ns: 60e9 } };
const config = (doubles: readonly object[], ints: readonly object[] = [], bools: readonly object[] = []) => ({
  doubles,
  ints,
  bools,
  strs: [],
  groups: [],
});
const EDIT =
  "{'enum': [{'name': 'Off', 'value': 0, 'description': ''}, {'name': 'Auto', 'value': 1, 'description': ''}]}";

const dropped = new Set(["/scan"]);
const plain = FakeConnection.prototype.statistics.bind(connection);
Object.assign(connection, {
  statistics: (topic: string) => {
    const { count } = plain(topic);
    const isLate = topic.includes("plan");
    return {
      count,
      rate: count === 0 ? null : isLate ? 0.4 : 20,
      bandwidth: count === 0 ? 0 : 1470 * topic.length,
      lastAt: count === 0 ? null : performance.now() - (isLate ? 9380 : 40),
      dropped: dropped.has(topic) ? 3 : 0,
    };
  },
});

let step = 0;
const stamp = (): { sec: number; nsec: number } => ({
  sec: Math.floor(step * 0.02),
  nsec: Math.round(((step * 0.02) % 1) * 1e9),
});
function tick(): void {
  step += 1;
  const time = step * 0.02;
  connection.time = BigInt(Math.round(time * 1e9));
  const speed = 0.3 * Math.sin(time / 2) + 0.01 * Math.sin(40 * time);
  connection.receive(
    "/odom",
    {
      header: { seq: step, stamp: stamp(), frame_id: "odom" },
      child_frame_id: "base_link",
      twist: {
        twist: { linear: { x: speed, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0.12 } },
        covariance: new Float64Array(36),
      },
    },
    { time: connection.time },
  );
  connection.receive(
    "/cmd_vel",
    { linear: { x: 0.3 * Math.sign(Math.sin(time / 2)), y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } },
    { time: connection.time },
  );
  connection.receive(
    "/joint_states",
    {
      header: { seq: step, stamp: stamp(), frame_id: "" },
      name: ["left_wheel", "right_wheel"],
      position: [3 * time, 2 * time],
      velocity: [3, 2],
      effort: [],
    },
    { time: connection.time },
  );
  connection.receive(
    "/scan",
    {
      header: { seq: step, stamp: stamp(), frame_id: "laser" },
      angle_min: -1.57,
      ranges: Float32Array.from({ length: 360 }, (_, index) => 1 + 0.01 * index),
      intensities: new Float32Array(0),
    },
    { time: connection.time },
  );
  if (step % 20 === 0) {
    const header = { seq: step, stamp: stamp(), frame_id: "camera" };
    const data = Uint8Array.from({ length: 160 * 120 * 3 }, (_, index) =>
      index % 3 === 0 ? (index / 3) % 160 : index % 3 === 1 ? step : index / 480,
    );
    connection.receive("/camera/image_raw", {
      header,
      width: 160,
      height: 120,
      encoding: "rgb8",
      is_bigendian: 0,
      step: 480,
      data,
    });
    const depth = new Uint8Array(Float32Array.from({ length: 80 * 60 }, (_, index) => 1 + (index % 80) / 40).buffer);
    connection.receive("/depth/image_raw", {
      header,
      width: 80,
      height: 60,
      encoding: "32FC1",
      is_bigendian: 0,
      step: 320,
      data: depth,
    });
  }
  if (step % 50 === 1) {
    const level = [2, 2, 4, 2, 8, 1][Math.floor(step / 50) % 6];
    connection.receive(
      "/rosout",
      {
        header: { seq: step, stamp: stamp(), frame_id: "" },
        level,
        name: step % 100 === 1 ? "/move_base" : "/gazebo",
        msg:
          level === 8
            ? "No transform from [amcl] to [map]; looked for it 5 s"
            : "Drive started: v 0.32 m/s, w 0.00 rad/s",
        file: "src/move_base.cpp",
        function: "MoveBase::executeCycle",
        line: 903,
        topics: [],
      },
      { time: connection.time },
    );
  }
  page.world.state.value = {
    time_ns: Number(connection.time),
    paused: false,
    real_time_factor: 1,
    speed: 1,
    recording: null,
    ...timeline,
  };
  page.world.joints.value = [0.42, -0.21, 5.17, 4.59, 4.07].map((value) => ({
    position: value + 0.1 * Math.sin(time),
    velocity: value,
    effort: 0,
  }));
}
for (let index = 0; index < 1000; index += 1) tick();
setInterval(tick, 20);
setTimeout(() => {
  for (let index = 0; index < 600; index += 1) tick();
  connection.receive("/move_base/NavfnROS/plan", { header: { seq: 0, stamp: stamp(), frame_id: "map" }, poses: [] });
  connection.notices.value = [{ level: "warning", text: "38 meshes are missing" }];
  connection.receive("/camera/parameter_descriptions", {
    groups: [
      {
        name: "Default",
        id: 0,
        parent: 0,
        parameters: [
          { name: "frame_rate", type: "double", level: 0, description: "Rate [Hz]", edit_method: "" },
          { name: "exposure", type: "int", level: 0, description: "", edit_method: EDIT },
          { name: "flip", type: "bool", level: 0, description: "", edit_method: "" },
          { name: "gain", type: "int", level: 0, description: "", edit_method: "" },
        ],
      },
    ],
    min: config([{ name: "frame_rate", value: 1 }], [{ name: "gain", value: 0 }]),
    max: config([{ name: "frame_rate", value: 60 }], [{ name: "gain", value: 255 }]),
    dflt: config(
      [{ name: "frame_rate", value: 30 }],
      [
        { name: "gain", value: 64 },
        { name: "exposure", value: 1 },
      ],
      [{ name: "flip", value: false }],
    ),
  });
}, 300);

if (state.get("theme") === "light") page.theme.value = "light";
document.documentElement.dataset["theme"] = page.theme.value;
const host = document.createElement("div");
host.append(page.scene.element);
const root = document.getElementById("app");
if (root !== null)
  mount(root, {
    page,
    panels: Promise.resolve(panels),
    commands: page.commands,
    sceneHost: host,
    frozen: signal(false),
  });
Object.assign(window, { page });
