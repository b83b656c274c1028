/** The look of a cloud's object by its display's properties. */

import { Matrix4, type Vector3 } from "three";

import type { Transform } from "../../frames/transform";
import type { Rgb } from "../../rviz/properties";
import type { Cloud } from "./cloud";
import {
  axisBounds,
  channelBounds,
  choose,
  intensityChannel,
  packedColor,
  range,
  supported,
  type Bounds,
} from "./cloud_colors";
import { ColorMode } from "./cloud_material";
import type { CloudProperties } from "./cloud_properties";
import { wordOf, type CloudObject } from "./point_cloud_object";

/** Divisors that rviz uses where minimum and maximum are equal. */
const INTENSITY_IF_EQUAL = 1e20;
const AXIS_IF_EQUAL = 0.001;

/** Update the choices for a new cloud, and select transformers that support it. */
export function offerTransformers(properties: CloudProperties, cloud: Cloud): void {
  const names = supported(cloud);
  properties.color.choices.value = names;
  properties.color.value.value = choose(properties.color.value.peek(), names);
  properties.position.value.value = "XYZ";
  const channels = [...new Set(cloud.channels.map(({ name }) => name))].filter((name) => name !== "").sort();
  if (channels.join("\n") !== properties.channel.choices.peek().join("\n")) properties.channel.choices.value = channels;
}

/** Set a drawn cloud's size, alpha and colors. */
export function dress(object: CloudObject, cloud: Cloud, transform: Transform, properties: CloudProperties): void {
  const { uniforms } = object.material;
  const size = properties.style.value.value === "Points" ? properties.pixels : properties.size;
  uniforms.pointSize.value.setScalar(size.value.value);
  object.material.setAlpha(properties.alpha.value.value, cloud.channel("rgba") !== undefined);
  setColor(uniforms.minColor.value, properties.minColor.value.value);
  setColor(uniforms.maxColor.value, properties.maxColor.value.value);
  switch (choose(properties.color.value.value, supported(cloud))) {
    case "AxisColor":
      colorByAxis(object, cloud, transform, properties);
      break;
    case "FlatColor":
      uniforms.colorMode.value = ColorMode.flat;
      setColor(uniforms.minColor.value, properties.flatColor.value.value);
      break;
    case "MONO8":
      colorPacked(object, cloud, ColorMode.mono);
      break;
    case "RGB8":
      colorPacked(object, cloud, ColorMode.packed);
      break;
    case "RGBF32":
      uniforms.colorMode.value = ColorMode.floats;
      object.setChannels(["r", "g", "b"].map((name) => wordOf(cloud.channel(name))));
      break;
    case "Intensity":
      colorByChannel(object, cloud, properties);
      break;
  }
}

function colorByChannel(object: CloudObject, cloud: Cloud, properties: CloudProperties): void {
  const { uniforms } = object.material;
  const channel = intensityChannel(cloud, properties.channel.value.value);
  if (channel === undefined) {
    // rviz draws points without the channel white
    uniforms.colorMode.value = ColorMode.flat;
    uniforms.minColor.value.setScalar(1);
    return;
  }
  const { minIntensity, maxIntensity } = properties;
  let bounds: Bounds = { min: minIntensity.value.value, max: maxIntensity.value.value };
  if (properties.autoIntensity.value.value) {
    bounds = channelBounds(cloud, channel);
    minIntensity.value.value = bounds.min;
    maxIntensity.value.value = bounds.max;
  }
  const word = wordOf(channel);
  object.setChannels([word, word + 1 < cloud.stride ? word + 1 : word]);
  uniforms.colorMode.value = ColorMode.channel;
  uniforms.channelType.value = channel.datatype;
  uniforms.channelShift.value = (channel.offset % 4) * 8;
  uniforms.low.value = bounds.min;
  uniforms.range.value = range(bounds, INTENSITY_IF_EQUAL);
  uniforms.rainbow.value = properties.useRainbow.value.value;
  uniforms.invert.value = properties.invertRainbow.value.value;
}

function colorByAxis(object: CloudObject, cloud: Cloud, transform: Transform, properties: CloudProperties): void {
  const { uniforms } = object.material;
  const axis = ({ X: 0, Y: 1, Z: 2 } as const)[properties.axis.value.value as "X" | "Y" | "Z"];
  const frame = new Matrix4();
  if (properties.inFixedFrame.value.value)
    frame.makeRotationFromQuaternion(transform.orientation).setPosition(transform.position);
  const { minValue, maxValue } = properties;
  let bounds: Bounds = { min: minValue.value.value, max: maxValue.value.value };
  if (properties.autoValues.value.value) {
    bounds = axisBounds(cloud, axis, frame);
    minValue.value.value = bounds.min;
    maxValue.value.value = bounds.max;
  }
  const row = [0, 4, 8, 12].map((column) => frame.elements[axis + column] ?? 0) as [number, number, number, number];
  uniforms.colorMode.value = ColorMode.axis;
  uniforms.axisRow.value.set(...row);
  uniforms.low.value = bounds.min;
  uniforms.range.value = range(bounds, AXIS_IF_EQUAL);
}

function colorPacked(object: CloudObject, cloud: Cloud, mode: number): void {
  const { uniforms } = object.material;
  object.setChannels([wordOf(packedColor(cloud))]);
  uniforms.colorMode.value = mode;
  uniforms.invert.value = cloud.channel("rgb") === undefined; // rgba has an alpha of its own
}

function setColor(uniform: Vector3, [red, green, blue]: Rgb): void {
  uniform.set(red / 255, green / 255, blue / 255);
}

/** Fields of a point, named and numbered as rviz's selection does. */
export function describePoint(cloud: Cloud, index: number): Record<string, unknown> {
  const value = (name: string): number => {
    const channel = cloud.channel(name);
    return channel === undefined ? NaN : cloud.value(channel, index);
  };
  const fields: Record<string, unknown> = { Point: index, Position: { x: value("x"), y: value("y"), z: value("z") } };
  const packed = packedColor(cloud);
  cloud.channels.forEach((channel, number) => {
    if (["x", "y", "z"].includes(channel.name.toLowerCase())) return;
    if (channel === packed) {
      const word = cloud.words[index * cloud.stride + wordOf(channel)] ?? 0;
      fields[`${number}: ${channel.name}`] = {
        r: (word >> 16) & 255,
        g: (word >> 8) & 255,
        b: word & 255,
        alpha: (word >>> 24) / 255,
      };
    } else fields[`${number}: ${channel.name}`] = cloud.value(channel, index);
  });
  return fields;
}
