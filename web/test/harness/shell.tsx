/**
 * The shell with a fake page; the address picks a state: `#view=rviz&theme=light&rtf=0.84&names=long&cameras=12`.
 * Nothing is drawn, but the scene's panes have their axes.
 */

import "../../src/theme/font.css";

import { effect } from "@preact/signals";

import { mount } from "../../src/app/mount";
import { panels } from "../../src/panels";
import { LabelSet } from "../../src/scene/label_layer";
import type { PaneLayout } from "../../src/scene/panes/pane_layout";
import { ScenePanes } from "../../src/scene/panes/scene_panes";
import { fakePage, type FakePage } from "../fake_page";
import { nameIn, showCrowd } from "./crowd";
import { MANIFEST } from "./manifest";

const state = new URLSearchParams(location.hash.slice(1));

function number(name: string, fallback: number): number {
  return Number(state.get(name) ?? fallback);
}

function showGraph(page: FakePage): void {
  const { displays } = page;
  displays.show("rviz/Grid", [150, 158, 166], null).status("ok", "OK");
  displays.show("rviz/RobotModel", null, null).status("ok", "OK");
  displays.show("rviz/LaserScan", [255, 107, 74], "/scan").status("ok", "OK");
  displays.show("rviz/Map", [98, 106, 110], "/map").status("ok", "OK");
  displays.show("rviz/Path", [47, 208, 127], "/plan").status("ok", "OK");
  displays.show("rviz/PointCloud2", [199, 155, 255], "/points").status("warn", "No messages received");
  displays
    .show("rviz/PoseArray", [242, 177, 52], "/cloud")
    .status("error", "No transform from [amcl] to [map]", "Nothing publishes amcl. Frames here: base_link, map, odom");
  displays.show("rviz/MarkerArray", null, "/markers").enabled.value.value = false;
  displays.unsupported.value = [
    {
      className: "jsk_rviz_plugins/OverlayText",
      name: "OverlayText",
      reason: "MoveIt's plug-ins are not available here.",
    },
  ];
  const offer = (name: string, type: string, className: string) => ({
    topic: { name, type, encoding: "ros1" },
    className,
  });
  displays.offers.value = [
    offer("/move_base/local_costmap", "nav_msgs/OccupancyGrid", "rviz/Map"),
    offer("/odom", "nav_msgs/Odometry", "rviz/Odometry"),
    offer("/amcl_pose", "geometry_msgs/PoseWithCovarianceStamped", "rviz/PoseWithCovariance"),
    offer("/imu/data", "sensor_msgs/Imu", "rviz/Imu"),
  ];
  page.connection.advertise("/scan", "sensor_msgs/LaserScan");
  for (let index = 0; index < 20; index += 1) page.connection.receive("/scan", {});
  page.connection.graph.value = {
    types: new Map(),
    publishers: new Map([["/scan", ["/laser", "/amcl"]]]),
    subscribers: new Map(),
    services: new Map(),
  };
  page.connection.time = 221_060_000_000n;
}

function showSimulation(page: FakePage): void {
  page.world.manifest.value = MANIFEST;
  page.world.joints.value = [0.42, -0.21, 5.17, 4.59, 4.07].map((value) => ({
    position: value,
    velocity: value,
    effort: 0,
  }));
  page.selection.value = { kind: "link", model: "rp2w", link: "chassis" };
  page.world.hidden.value = new Set(["ground_plane"]);
  const factor = number("rtf", 1);
  const paused = state.get("run") === "0";
  page.world.state.value = { time_ns: 12.48e9, paused, real_time_factor: factor, speed: 1, recording: { since_ns: 0 } };
  if (state.get("notices") !== null)
    page.connection.notices.value = [{ level: "warning", text: "38 meshes are missing" }];
}

/** Put the labels and axes of the scene's panes over a fake scene. */
function showPanes({ scene, views }: FakePage, host: HTMLElement): void {
  const panes = new ScenePanes(host, new LabelSet(() => undefined), scene.size, scene.freeArea);
  effect(() => {
    panes.layout.value = views.layout.value;
    views.panes.value = panes.shown.value.map(({ place }) => ({ ...views.active.peek(), place }));
  });
  new ResizeObserver(() => {
    scene.size.value = { width: host.clientWidth, height: host.clientHeight };
    for (const pane of panes.shown.value) pane.showOver();
  }).observe(host);
}

const graph = state.get("view") === "rviz";
const script = state.get("names");
const page = fakePage({
  ...(graph ? { title: "turtlebot", kind: "graph", robot: null } : {}),
  ...(script === null ? {} : { title: nameIn(script, 0), robot: nameIn(script, 1) }),
});
if (graph) showGraph(page);
else showSimulation(page);
if (state.get("drive") !== "0") page.connection.listen("/cmd_vel", "geometry_msgs/Twist");
if (script !== null) showCrowd(page, script, number("models", 4), number("cameras", 2), number("topics", 4));
if (state.get("loading") !== null) page.world.progress.value = 0.4;
if (state.get("connection") === "lost") page.connection.state.value = { kind: "lost", retryInSeconds: 3 };
if (state.get("theme") === "light") page.theme.value = "light";
document.documentElement.dataset["theme"] = page.theme.value;
Object.assign(page.scene.element.style, {
  width: "100%",
  height: "100%",
  background: page.theme.value === "light" ? "#b9bdc0" : "#2a2d31",
});
const host = document.createElement("div");
host.append(page.scene.element);
showPanes(page, host);
const root = document.getElementById("app");
if (root !== null) {
  const shell = mount(root, { page, panels: Promise.resolve(panels), commands: page.commands, sceneHost: host });
  if (state.has("panes")) shell.split.value = state.get("panes") as PaneLayout;
}
Object.assign(window, { page });
