import { Quaternion, Vector3, Vector4 } from "three";
import { describe, expect, it } from "vitest";

import "../../src/displays/depth_cloud";
import { calibratedSize, cameraPose, pictureRectangle, projection } from "../../src/displays/cameras/camera_projection";
import { autoSize, cameraInfoTopic, depthPoints } from "../../src/displays/cameras/depth_points";
import { upright } from "../../src/displays/cameras/scene_picture";
import type { Cloud } from "../../src/displays/clouds/cloud";
import type { DepthCloudDisplay } from "../../src/displays/depth_cloud";
import { displayClass } from "../../src/displays/registry";
import type { CameraInfo, Image } from "../../src/protocol/generated/ros_messages";
import { fakes, header, status } from "./fakes";

function info(changes: Partial<CameraInfo> = {}): CameraInfo {
  const matrix = [100, 0, 1, 0, 0, 200, 0.5, 0, 0, 0, 1, 0];
  return {
    header: header("optical"),
    width: 2,
    height: 1,
    distortion_model: "plumb_bob",
    D: new Float64Array(5),
    R: new Float64Array(9),
    K: Float64Array.of(100, 0, 1, 0, 200, 0.5, 0, 0, 1),
    P: Float64Array.from(matrix),
    binning_x: 0,
    binning_y: 0,
    roi: { x_offset: 0, y_offset: 0, width: 0, height: 0, do_rectify: false },
    ...changes,
  };
}

function depth(encoding: string, values: readonly number[], changes: Partial<Image> = {}): Image {
  const numbers = encoding === "32FC1" ? Float32Array.from(values) : Uint16Array.from(values);
  const data = new Uint8Array(numbers.buffer);
  return {
    header: header("optical"),
    width: values.length,
    height: 1,
    encoding,
    is_bigendian: 0,
    step: data.length,
    data,
    ...changes,
  };
}

function cloud(read: Cloud | string): Cloud {
  if (typeof read === "string") throw new Error(read);
  return read;
}

describe("points of a depth image", () => {
  it("lie where the projection says, in metres", () => {
    const read = cloud(depthPoints(depth("16UC1", [2000, 4000]), info(), null));
    const expected = [-0.02, -0.005, 2, NaN, 0, -0.01, 4, NaN];
    expected.forEach((value, index) => Number.isNaN(value) || expect(read.floats[index]).toBeCloseTo(value, 5));
    expect(read.words[3]).toBe(0xffffff);
  });

  it("leave out unmeasured pixels", () => {
    expect(cloud(depthPoints(depth("16UC1", [0, 1000]), info(), null)).count).toBe(1);
    expect(cloud(depthPoints(depth("32FC1", [NaN, Infinity]), info(), null)).count).toBe(0);
  });

  it("have the colors of the other image", () => {
    const color = {
      width: 2,
      height: 1,
      rgba: new Uint8ClampedArray([1, 2, 3, 255, 4, 5, 6, 255]),
      history: { minima: [], maxima: [] },
    };
    expect(cloud(depthPoints(depth("32FC1", [1, 1]), info(), color)).words[7]).toBe(0x040506);
  });

  it("follow binning and region of interest", () => {
    const binned = info({
      binning_x: 2,
      binning_y: 2,
      width: 8,
      height: 2,
      roi: { x_offset: 1, y_offset: 0, width: 4, height: 2, do_rectify: false },
    });
    const read = cloud(depthPoints(depth("32FC1", [1, 1]), binned, null));
    expect([read.floats[0], read.floats[4]].map((x) => Math.round((x ?? 0) * 1000) / 1000 + 0)).toEqual([0, 0.02]);
  });

  it.each([
    [
      "bytes",
      depth("16UC1", [1, 1], { encoding: "rgb8" }),
      info(),
      "Depth image has invalid format (only 16 bit and float are supported)!",
    ],
    [
      "another size",
      depth("16UC1", [1, 1, 1]),
      info(),
      "Depth image size and camera info don't match: 3 x 1 vs 2 x 1(binning: 1 x 1, ROI size: 2 x 1)",
    ],
    [
      "a focal length of no number",
      depth("16UC1", [1, 1]),
      info({ P: new Float64Array(12).fill(NaN) }),
      "Camera info contains invalid floating point values (nans or infs)",
    ],
    [
      "no projection",
      depth("16UC1", [1, 1]),
      info({ P: new Float64Array(0) }),
      "Camera info contains invalid floating point values (nans or infs)",
    ],
    [
      "a width of a thousand millions",
      depth("16UC1", [1], { width: 1e9 }),
      info({ width: 1e9 }),
      /^Data size \(2 bytes\)/,
    ],
    [
      "a thousand million empty rows",
      depth("16UC1", [1], { width: 0, height: 1e9, step: 0 }),
      info({ width: 0, height: 1e9 }),
      "Depth image is zero-sized (0x1000000000)",
    ],
  ])("are refused with %s", (_name, image, calibration, sentence) => {
    expect(depthPoints(image, calibration, null)).toEqual(
      typeof sentence === "string" ? sentence : expect.stringMatching(sentence),
    );
  });

  it("are as large as a pixel's view", () => {
    expect(autoSize(info(), 2)).toBeCloseTo(0.02);
    expect(autoSize(info({ binning_x: 2 }), 1)).toBeCloseTo(0.02);
    expect(autoSize(info({ K: new Float64Array(9) }), 1)).toBe(0);
  });
});

it("the CameraInfo topic is a sibling of the image's", () => {
  expect(cameraInfoTopic("/head/camera/image_raw")).toBe("/head/camera/camera_info");
});

describe("a camera's projection", () => {
  /** Pixel of a point of the optical frame, through the matrix and the pose. */
  function pixel(calibration: CameraInfo, point: Vector3, zoom = 1): number[] {
    const size = calibratedSize(calibration, { width: 2, height: 1 });
    const matrix = projection(calibration, size, zoom);
    if (typeof matrix === "string") throw new Error(matrix);
    const pose = cameraPose(calibration, { position: new Vector3(), orientation: new Quaternion() });
    const inCamera = point.clone().sub(pose.position).applyQuaternion(pose.orientation.clone().invert());
    const clip = new Vector4(inCamera.x, inCamera.y, inCamera.z, 1).applyMatrix4(matrix);
    return [((clip.x / clip.w + 1) / 2) * size.width, ((1 - clip.y / clip.w) / 2) * size.height].map(
      (value) => Math.round(value * 1e6) / 1e6,
    );
  }

  it("puts a point on its pixel: u = fx x/z + cx, v = fy y/z + cy", () => {
    const calibration = info({
      width: 640,
      height: 480,
      P: Float64Array.of(500, 0, 310, 0, 0, 510, 250, 0, 0, 0, 1, 0),
    });
    expect(pixel(calibration, new Vector3(0.2, -0.1, 2))).toEqual([360, 224.5]);
    expect(pixel(calibration, new Vector3(0, 0, 5))).toEqual([310, 250]);
  });

  it("is offset from its frame in a stereo pair", () => {
    const right = info({ width: 640, height: 480, P: Float64Array.of(500, 0, 310, -50, 0, 500, 250, 0, 0, 0, 1, 0) });
    expect(pixel(right, new Vector3(0.1, 0, 2))).toEqual([310, 250]);
  });

  it("zooms about the middle, as its picture does", () => {
    const calibration = info({
      width: 640,
      height: 480,
      P: Float64Array.of(500, 0, 320, 0, 0, 500, 240, 0, 0, 0, 1, 0),
    });
    expect(pixel(calibration, new Vector3(0.1, 0, 1), 2)).toEqual([420, 240]);
    expect(pictureRectangle(calibration, { width: 640, height: 480 }, 2)).toEqual([-320, -240, 1280, 960]);
    const region = info({ roi: { x_offset: 100, y_offset: 50, width: 200, height: 100, do_rectify: false } });
    expect(pictureRectangle(region, { width: 640, height: 480 }, 1)).toEqual([100, 50, 200, 100]);
  });

  it.each([
    [info({ P: new Float64Array(12).fill(NaN) }), "Contains invalid floating point values (nans or infs)"],
    [info({ P: new Float64Array(2) }), "Contains invalid floating point values (nans or infs)"],
    [info({ P: new Float64Array(12) }), "CameraInfo/P resulted in an invalid position calculation (nans or infs)"],
  ])("that is invalid is refused", (calibration, sentence) =>
    expect(projection(calibration, { width: 2, height: 1 }, 1)).toBe(sentence),
  );

  it("without a size takes the picture's", () => {
    expect(calibratedSize(info({ width: 0, height: 0 }), { width: 7, height: 5 })).toEqual({ width: 7, height: 5 });
  });
});

it("a drawn picture is turned upright and freed of its alpha", () => {
  const bytes = new Uint8Array([1, 2, 3, 255, 50, 25, 0, 128]);
  expect([...upright(bytes, 1, 2)]).toEqual([100, 50, 0, 128, 1, 2, 3, 255]);
});

describe("DepthCloud", () => {
  function start(color: boolean): { display: DepthCloudDisplay; around: ReturnType<typeof fakes> } {
    const around = fakes();
    around.connection.advertise("/c/depth", "sensor_msgs/Image");
    around.connection.advertise("/c/rgb", "sensor_msgs/Image");
    around.connection.advertise("/c/camera_info", "sensor_msgs/CameraInfo");
    const display = displayClass("rviz/DepthCloud")?.create(around.context) as DepthCloudDisplay;
    display.load({ Enabled: true, "Depth Map Topic": "/c/depth", "Color Image Topic": color ? "/c/rgb" : "" });
    display.start();
    return { display, around };
  }

  it("waits for CameraInfo and the transform, then shows points as large as a pixel", () => {
    const { display, around } = start(false);
    around.connection.receive("/c/depth", depth("16UC1", [1000, 2000]));
    around.frames.set("optical");
    display.update(0n, 0.1);
    expect(status(display, "Message")).toBe("warn: Waiting for CameraInfo message..");
    around.connection.receive("/c/camera_info", info());
    display.update(0n, 0.1);
    expect(status(display, "Points")).toBe("ok: Showing [2] points from [1] messages");
    expect(status(display, "Message")).toBe("ok: Ok");
    expect(display.cloudProperties.size.value.value).toBeCloseTo(0.01);
  });

  it("waits for the color image, and names mismatches", () => {
    const { display, around } = start(true);
    around.frames.set("optical");
    around.connection.receive("/c/camera_info", info());
    around.connection.receive("/c/depth", depth("16UC1", [1000, 2000]));
    display.update(0n, 0.1);
    expect(status(display, "Points")).toBeUndefined();
    const rgb = {
      header: header("other"),
      width: 2,
      height: 1,
      encoding: "rgb8",
      is_bigendian: 0,
      step: 6,
      data: new Uint8Array(6),
    };
    around.connection.receive("/c/rgb", rgb);
    display.update(0n, 0.1);
    expect(status(display, "Points")).toBe("ok: Showing [2] points from [1] messages");
    expect(status(display, "Message")).toBe(
      "warn: Depth image frame id [optical] doesn't match color image frame id [other]",
    );
    around.connection.receive("/c/depth", depth("16UC1", [1000, 2000], { encoding: "rgb8" }));
    display.update(0n, 0.1);
    expect(status(display, "Message")).toBe(
      "error: Depth image has invalid format (only 16 bit and float are supported)!",
    );
    display.stop();
    expect(["/c/depth", "/c/rgb", "/c/camera_info"].map((topic) => around.connection.subscriptions(topic))).toEqual([
      0, 0, 0,
    ]);
  });

  it("reports unsupported options", () => {
    const { display } = start(false);
    display.occlusion.value.value = true;
    expect(status(display, "Unsupported")).toBe("warn: Occlusion Compensation: not supported here");
  });
});
