/** Messages that are shown alone, by name; those with a number in the name have so many points. */

import type { Header, Pose } from "../../src/protocol/generated/ros_messages";

function header(frame = "map"): Header {
  return { seq: 0, stamp: { sec: 1, nsec: 0 }, frame_id: frame };
}

const WIDTH = 160;
const HEIGHT = 120;

function gradient(encoding: string): unknown {
  const bytes = encoding === "rgba8" ? 4 : encoding === "mono8" || encoding.startsWith("bayer") ? 1 : 3;
  const data = new Uint8Array(WIDTH * HEIGHT * bytes);
  for (let at = 0; at < WIDTH * HEIGHT; at++) {
    const [red, green] = [((at % WIDTH) * 255) / WIDTH, (Math.floor(at / WIDTH) * 255) / HEIGHT];
    const parts = bytes === 1 ? [red] : encoding === "bgr8" ? [64, green, red] : [red, green, 64, 255];
    data.set(parts.slice(0, bytes), at * bytes);
  }
  return {
    header: header("optical"),
    width: WIDTH,
    height: HEIGHT,
    encoding,
    is_bigendian: 0,
    step: WIDTH * bytes,
    data,
  };
}

type Maker = (argument: string) => unknown;

const MAKERS: Record<string, Maker> = {
  scan: () => ({
    header: header(),
    angle_min: -Math.PI / 2,
    angle_max: Math.PI / 2,
    angle_increment: Math.PI / 180,
    time_increment: 0,
    scan_time: 0,
    range_min: 0.1,
    range_max: 10,
    ranges: Float32Array.from({ length: 181 }, (_, i) => 2 + 0.5 * Math.sin(i / 8)),
    intensities: Float32Array.from({ length: 181 }, (_, i) => i),
  }),
  /** Six points in a row along y whose intensities are 0…5. */
  row: () => cloud2(6, (i) => [0, i - 2.5, 0, i]),
  /** Six colored points in a row: red, green, blue, white, grey, half transparent yellow. */
  rgba: () => {
    const colors = [0xffff0000, 0xff00ff00, 0xff0000ff, 0xffffffff, 0xff808080, 0x80ffff00];
    const message = cloud2(6, (i) => [0, i - 2.5, 0, 0], "rgba");
    const words = new Uint32Array(message.data.buffer);
    colors.forEach((color, i) => (words[i * 4 + 3] = color));
    return message;
  },
  /** Points on a helix. */
  helix: (argument) => cloud2(Number(argument), (i, n) => [Math.cos(i / 5), Math.sin(i / 5), (2 * i) / n - 1, i]),
  /** A map of rings around its middle, unknown at the corner. */
  map: (argument) => {
    const side = Number(argument);
    const data = Int8Array.from({ length: side * side }, (_, at) => {
      const [x, y] = [at % side, Math.floor(at / side)];
      return x < side / 4 && y < side / 4
        ? -1
        : Math.round((200 * Math.hypot(x - side / 2, y - side / 2)) / side) % 101;
    });
    const origin = { position: { x: -2, y: -2, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
    return {
      header: header(),
      info: { map_load_time: { sec: 0, nsec: 0 }, resolution: 4 / side, width: side, height: side, origin },
      data,
    };
  },
  /** A square of lethal cells. */
  update: (argument) => {
    const side = Number(argument);
    return { header: header(), x: 10, y: 30, width: side, height: side, data: new Int8Array(side * side).fill(100) };
  },
  pose: () => ({ header: header("tilted"), pose: pose(0.5, 0, 0) }),
  poses: () => ({ header: header(), poses: ring(12) }),
  /** In the plane, or with `3d` in space. */
  sure: (argument) => ({
    header: header(),
    pose: { pose: pose(0, 0, argument === "3d" ? 0.3 : 0, 0.5), covariance: covariance(argument === "3d") },
  }),
  odometry: (argument) => {
    const turn = Number(argument) / 10;
    const twist = { linear: { x: 0, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } };
    return {
      header: header(),
      child_frame_id: "base_link",
      pose: {
        pose: pose(1.5 * Math.cos(turn), 1.5 * Math.sin(turn), 0, turn + Math.PI / 2),
        covariance: covariance(false),
      },
      twist: { twist, covariance: new Float64Array(36) },
    };
  },
  path: () => ({ header: header(), poses: ring(16).map((one) => ({ header: header(), pose: one })) }),
  point: () => ({ header: header("tilted"), point: { x: 0, y: 1, z: 0 } }),
  polygon: () => ({
    header: header("tilted"),
    polygon: {
      points: [
        [1, 1, 0],
        [-1, 1, 0],
        [-1, -1, 0],
        [1.5, -1, 0],
      ].map(([x, y, z]) => ({ x, y, z })),
    },
  }),
  cells: () => ({
    header: header(),
    cell_width: 0.4,
    cell_height: 0.2,
    cells: ring(12).map(({ position }) => position),
  }),
  range: () => ({ header: header(), radiation_type: 0, field_of_view: 0.5, min_range: 0.1, max_range: 4, range: 2 }),
  wrench: () => ({ header: header(), wrench: { force: { x: 0.6, y: 0, z: 0 }, torque: { x: 0, y: 0.3, z: 0.6 } } }),
  twist: () => ({ header: header(), twist: { linear: { x: 0.6, y: 0, z: 0 }, angular: { x: 0, y: 0.3, z: 0.6 } } }),
  accel: () => ({ header: header(), accel: { linear: { x: 0.6, y: 0, z: 0 }, angular: { x: 0, y: 0.3, z: 0.6 } } }),
  imu: () => ({
    header: header("tilted"),
    orientation: pose(0, 0, 0, 0.6).orientation,
    orientation_covariance: new Float64Array(9),
    angular_velocity: { x: 0, y: 0, z: 0 },
    angular_velocity_covariance: new Float64Array(9),
    linear_acceleration: { x: 1, y: 0, z: 9.81 },
    linear_acceleration_covariance: new Float64Array(9),
  }),
  /** Red grows to the right, green downwards; in an encoding of bytes. */
  image: (argument) => gradient(argument),
  /** Metres that grow to the right from 1 to 3, none in the left eighth. */
  depth: () => {
    const values = Float32Array.from({ length: WIDTH * HEIGHT }, (_, at) =>
      at % WIDTH < WIDTH / 8 ? NaN : 1 + (2 * (at % WIDTH)) / WIDTH,
    );
    return {
      header: header("optical"),
      width: WIDTH,
      height: HEIGHT,
      encoding: "32FC1",
      is_bigendian: 0,
      step: 4 * WIDTH,
      data: new Uint8Array(values.buffer),
    };
  },
  info: () => ({
    header: header("optical"),
    width: WIDTH,
    height: HEIGHT,
    distortion_model: "plumb_bob",
    D: new Float64Array(5),
    R: new Float64Array(9),
    K: Float64Array.of(160, 0, 80, 0, 160, 60, 0, 0, 1),
    P: Float64Array.of(160, 0, 80, 0, 0, 160, 60, 0, 0, 0, 1, 0),
    binning_x: 0,
    binning_y: 0,
    roi: { x_offset: 0, y_offset: 0, width: 0, height: 0, do_rectify: false },
  }),
  temperature: () => ({ header: header(), temperature: 50, variance: 0 }),
};

function pose(x: number, y: number, z: number, yaw = 0): Pose {
  return { position: { x, y, z }, orientation: { x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) } };
}

/** Poses on a circle of 1.5 m that point along it. */
function ring(count: number): Pose[] {
  return Array.from({ length: count }, (_, index) => {
    const angle = (1.8 * Math.PI * index) / count;
    return pose(1.5 * Math.cos(angle), 1.5 * Math.sin(angle), 0, angle + Math.PI / 2);
  });
}

function covariance(isSpatial: boolean): Float64Array {
  const matrix = new Float64Array(36);
  const diagonal = isSpatial ? [0.3, 0.1, 0.05, 0.02, 0.05, 0.1] : [0.3, 0.1, 0, 0, 0, 0.05];
  diagonal.forEach((variance, row) => (matrix[7 * row] = variance));
  matrix[1] = matrix[6] = 0.1;
  return matrix;
}

/** A cloud of x, y, z and one further float32. */
function cloud2(
  count: number,
  point: (index: number, count: number) => readonly number[],
  name = "intensity",
): { data: Uint8Array } {
  const values = new Float32Array(count * 4);
  for (let index = 0; index < count; index++) values.set(point(index, count), index * 4);
  const fields = ["x", "y", "z", name].map((field, word) => ({ name: field, offset: word * 4, datatype: 7, count: 1 }));
  const data = new Uint8Array(values.buffer);
  return {
    header: header(),
    height: 1,
    width: count,
    fields,
    is_bigendian: false,
    point_step: 16,
    row_step: 16 * count,
    data,
    is_dense: true,
  } as { data: Uint8Array };
}

/** `helix 1000`: the message of that name. */
export function makeMessage(name: string): unknown {
  const [kind = "", argument = ""] = name.split(" ");
  const make = MAKERS[kind];
  if (make === undefined) throw new Error(`no message ${kind}`);
  return make(argument);
}
