import { expect, it } from "vitest";

import type { Decoded } from "../../src/displays/pictures/picture_decoder";
import { PictureStream } from "../../src/displays/pictures/picture_stream";
import { NO_HISTORY } from "../../src/displays/pictures/pixels";
import { displayClass } from "../../src/displays/registry";
import "../../src/displays/image";
import type { ImageDisplay } from "../../src/displays/image";
import type { Image } from "../../src/protocol/generated/ros_messages";
import { FakeConnection } from "../fake_connection";
import { fakes, header, status } from "./fakes";

class Slow {
  readonly decoded: Image[] = [];
  readonly answers: ((decoded: Decoded) => void)[] = [];
  readonly faults: ((fault: Error) => void)[] = [];
  readonly closed: number[] = [];

  readonly decode = (message: unknown): Promise<Decoded> => {
    this.decoded.push(message as Image);
    return new Promise((resolve, reject) => {
      this.answers.push(resolve);
      this.faults.push(reject);
    });
  };

  answer(index: number): Promise<void> {
    const bitmap = { width: index, height: 1, close: () => this.closed.push(index) } as ImageBitmap;
    this.answers[index]?.({ bitmap, history: NO_HISTORY });
    return settle();
  }
}

function settle(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, 0));
}

function open(): { connection: FakeConnection; slow: Slow; stream: PictureStream; send: (seq: number) => void } {
  const connection = new FakeConnection();
  connection.advertise("/image", "sensor_msgs/Image");
  const slow = new Slow();
  const stream = new PictureStream(connection, "/image", slow.decode);
  const send = (seq: number): void =>
    connection.receive("/image", { header: { ...header("cam"), seq }, encoding: "rgb8", width: 1, height: 1 });
  return { connection, slow, stream, send };
}

it("decodes the newest waiting image, and frees the old picture", async () => {
  const { slow, stream, send } = open();
  [0, 1, 2, 3].forEach(send);
  expect(slow.decoded.map((message) => message.header.seq)).toEqual([0]);
  await slow.answer(0);
  expect(slow.decoded.map((message) => message.header.seq)).toEqual([0, 3]);
  await slow.answer(1);
  expect([stream.picture.value?.header.seq, stream.count.value]).toEqual([3, 4]);
  expect(slow.closed).toEqual([0]);
});

it("reports why an image is not shown, and continues with the next", async () => {
  const { connection, slow, stream, send } = open();
  send(0);
  slow.faults[0]?.(new Error("Unsupported image encoding [x]"));
  await settle();
  expect(stream.fault.value).toBe("Unsupported image encoding [x]");
  send(1);
  await slow.answer(1);
  expect(stream.fault.value).toBeNull();
  connection.advertise("/image", "std_msgs/String");
  send(2);
  expect(stream.fault.value).toBe(
    "/image is of type std_msgs/String, not sensor_msgs/Image or sensor_msgs/CompressedImage",
  );
});

it("frees everything when it is closed", async () => {
  const { connection, slow, stream, send } = open();
  send(0);
  stream.close();
  await slow.answer(0);
  expect(slow.closed).toEqual([0]);
  expect(stream.picture.value).toBeNull();
  expect(connection.subscriptions("/image")).toBe(0);
});

it("the display subscribes by its transport and reports missing topics", () => {
  const around = fakes();
  const display = displayClass("rviz/Image")?.create(around.context) as ImageDisplay;
  display.load({
    Enabled: true,
    "Image Topic": "/camera/image_raw",
    "Transport Hint": "compressed",
    "Median window": 3,
  });
  display.start();
  expect(around.connection.subscriptions("/camera/image_raw/compressed")).toBe(1);
  expect(status(display, "Image")).toBe("warn: No Image received");
  expect(display.statuses.value.get("Image")?.advice).toBe("Nothing publishes /camera/image_raw/compressed.");
  display.transport.value.value = "theora";
  expect(status(display, "Transport Hint")).toMatch(/^error: Transport theora is not supported/);
  display.transport.value.value = "raw";
  expect(around.connection.subscriptions("/camera/image_raw")).toBe(1);
  expect(around.connection.subscriptions("/camera/image_raw/compressed")).toBe(0);
  display.stop();
  expect(around.connection.subscriptions("/camera/image_raw")).toBe(0);
});
