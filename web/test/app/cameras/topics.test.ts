import { expect, it } from "vitest";

import { cameraTopics, streamedTopic, tileKey } from "../../../src/app/cameras/topics";
import "../../../src/displays/all";
import type { Display } from "../../../src/displays/display";
import type { YamlMapping } from "../../../src/rviz/properties";
import { displayClass } from "../../../src/displays/registry";
import { fakes } from "../../displays/fakes";
import { MANIFEST } from "../../harness/manifest";

it("lists each camera once, requested topics first", () => {
  const topics = cameraTopics({ images: ["/usb_cam/image_raw", "/my_sensor/image_raw"] }, MANIFEST);
  expect(topics.map(({ name }) => name)).toEqual(["usb_cam/image_raw", "netbook_webcam", "my_sensor"]);
  expect(cameraTopics({ images: [] }, null)).toEqual([]);
});

it("lists enabled displays of pictures, those in groups too, instead of their topics", () => {
  const { context } = fakes();
  const make = (className: string, yaml: YamlMapping): Display => {
    const display = displayClass(className)?.create(context);
    if (display === undefined) throw new Error(className);
    display.load(yaml);
    return display;
  };
  const image = { Class: "rviz/Image", Name: "Front", Enabled: true, "Image Topic": "/usb_cam/image_raw" };
  const camera = { Class: "rviz/Camera", Name: "Overlay", Enabled: true, "Image Topic": "/usb_cam/image_raw" };
  const group = make("rviz/Group", {
    Name: "Pictures",
    Enabled: true,
    Displays: [camera, { ...image, Name: "Off", Enabled: false }],
  });
  const topics = cameraTopics({ images: ["/usb_cam/image_raw"] }, null, [
    make("rviz/Image", image),
    group,
    make("rviz/Axes", { Enabled: true }),
  ]);
  expect(topics.map(({ name }) => name)).toEqual(["Front", "Overlay"]);
  expect(new Set(topics.map(tileKey)).size).toBe(2);
});

it("uses compressed pictures only over a network", () => {
  const topics = new Map([
    ["/c/compressed", { name: "/c/compressed", type: "sensor_msgs/CompressedImage", encoding: "ros1" }],
  ]);
  expect(streamedTopic("/c", topics, "192.168.1.7")).toBe("/c/compressed");
  expect(streamedTopic("/c", topics, "localhost")).toBe("/c");
  expect(streamedTopic("/d", topics, "192.168.1.7")).toBe("/d");
});
