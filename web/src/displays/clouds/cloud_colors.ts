/** rviz's color transformers: those that a cloud supports, and the bounds of their colors. */

import type { Matrix4 } from "three";

import { FLOAT32, UINT32, type Channel, type Cloud } from "./cloud";

/** In rviz's order, which is that of their names. */
export const COLOR_TRANSFORMERS = ["AxisColor", "FlatColor", "Intensity", "MONO8", "RGB8", "RGBF32"] as const;
export type ColorTransformer = (typeof COLOR_TRANSFORMERS)[number];

const INT32 = 5;

export interface Bounds {
  readonly min: number;
  readonly max: number;
}

/** Channel of packed colors: `rgba` if a cloud has both. */
export function packedColor(cloud: Cloud): Channel | undefined {
  const order = cloud.channels.filter(({ name }) => name === "rgb" || name === "rgba");
  const channel = order.at(-1);
  return channel !== undefined && [INT32, UINT32, FLOAT32].includes(channel.datatype) ? channel : undefined;
}

/** Color transformers that can show a cloud. */
export function supported(cloud: Cloud): readonly ColorTransformer[] {
  const isPacked = packedColor(cloud) !== undefined;
  const isFloat =
    cloud.channel("r")?.datatype === FLOAT32 && ["g", "b"].every((name) => cloud.channel(name) !== undefined);
  return COLOR_TRANSFORMERS.filter((name) => {
    if (name === "RGB8" || name === "MONO8") return isPacked;
    return name !== "RGBF32" || isFloat;
  });
}

/** Transformer that rviz uses: the preferred one if supported, otherwise RGB8, otherwise Intensity. */
export function choose(preferred: string, names: readonly ColorTransformer[]): ColorTransformer {
  const match = names.find((name) => name === preferred);
  return match ?? (names.includes("RGB8") ? "RGB8" : "Intensity");
}

/** The channel that Intensity colors by; without `intensity`, a cloud's `intensities`. */
export function intensityChannel(cloud: Cloud, name: string): Channel | undefined {
  return cloud.channel(name) ?? (name === "intensity" ? cloud.channel("intensities") : undefined);
}

/** Minimum and maximum of a channel; they begin at rviz's ±999999. */
export function channelBounds(cloud: Cloud, channel: Channel): Bounds {
  let min = 999999;
  let max = -999999;
  const take = (value: number): void => {
    if (value < min) min = value;
    if (value > max) max = value;
  };
  if (channel.datatype === FLOAT32) {
    const { floats, stride } = cloud;
    for (let at = channel.offset / 4; at < floats.length; at += stride) take(floats[at] ?? NaN);
  } else {
    for (let index = 0; index < cloud.count; index++) take(cloud.value(channel, index));
  }
  return { min: Math.max(-999999, min), max: Math.min(999999, max) };
}

/** Minimum and maximum coordinate along row `axis` of a transform, from rviz's ±9999. */
export function axisBounds(cloud: Cloud, axis: 0 | 1 | 2, transform: Matrix4): Bounds {
  const [x = 0, y = 0, z = 0] = ["x", "y", "z"].map((name) => (cloud.channel(name)?.offset ?? 0) / 4);
  const row = [0, 4, 8, 12].map((column) => transform.elements[axis + column] ?? 0);
  const [a = 0, b = 0, c = 0, d = 0] = row;
  const { floats, stride } = cloud;
  let min = 9999;
  let max = -9999;
  for (let at = 0; at < floats.length; at += stride) {
    const value = a * (floats[at + x] ?? NaN) + b * (floats[at + y] ?? NaN) + c * (floats[at + z] ?? NaN) + d;
    if (value < min && value > -Infinity) min = value;
    if (value > max && value < Infinity) max = value;
  }
  return { min, max };
}

/** Divisor of a value's distance from the minimum; `ifEqual`, as in rviz, if the bounds are equal. */
export function range({ min, max }: Bounds, ifEqual: number): number {
  return max - min === 0 ? ifEqual : max - min;
}

/** Corners of rviz's rainbow, which leaves a sixth of the hues out: 0 is magenta, 1 is red. */
export const RAINBOW = [
  [1, 0, 1],
  [0, 0, 1],
  [0, 1, 1],
  [0, 1, 0],
  [1, 1, 0],
  [1, 0, 0],
] as const;
