/** Worlds and graphs whose names and numbers are hard on the page's layout. */

import type { Manifest, ModelInfo } from "../../src/protocol/generated/page_messages";
import type { FakePage } from "../fake_page";
import { MANIFEST } from "./manifest";

/** Names by script; those of one script have their beginnings in common. */
const NAMES: Readonly<Record<string, (index: number) => string>> = {
  long: (index) => `warehouse_north_wing_autonomous_mobile_base_front_left_${String(index).padStart(6, "0")}`,
  cjk: (index) => `倉庫の北側にある自律移動ロボットの前方左側の車輪と駆動装置その${index}号機予備部品箱`,
  arabic: (index) => `الروبوت_المتنقل_في_المستودع_الشمالي_والعجلة_الأمامية_اليسرى_${index}`,
};

export function nameIn(script: string, index: number): string {
  return NAMES[script]?.(index) ?? `robot_${index}`;
}

/** Show models, cameras and topics of these numbers, named in a script. */
export function showCrowd(page: FakePage, script: string, models: number, cameras: number, topics: number): void {
  const name = (index: number): string => nameIn(script, index);
  const [robot] = MANIFEST.models;
  const [camera] = MANIFEST.cameras;
  if (robot === undefined || camera === undefined) return;
  const renamed = (index: number): ModelInfo => ({
    ...robot,
    name: name(index),
    links: robot.links.map((link, i) => ({ ...link, name: name(100 + i), body: 1000 * index + i })),
    joints: robot.joints.map((joint, i) => ({ ...joint, name: name(200 + i) })),
  });
  const manifest: Manifest = {
    ...MANIFEST,
    name: name(0),
    models: Array.from({ length: models }, (_, index) => renamed(index)),
    cameras: Array.from({ length: cameras }, (_, index) => ({
      ...camera,
      name: name(index),
      topic: `/${name(index)}/image_raw`,
    })),
  };
  page.world.manifest.value = manifest;
  page.selection.value = { kind: "link", model: name(0), link: name(100) };
  for (let index = 0; index < topics; index += 1)
    page.connection.advertise(`/${name(index)}/scan`, "sensor_msgs/LaserScan");
}
