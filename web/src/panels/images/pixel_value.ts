/** The value of one pixel as the message has it. */

import type { Image } from "../../protocol/generated/ros_messages";

type Read = (view: DataView, at: number, isLittle: boolean) => number;

const READS: Readonly<Record<string, readonly [bytes: number, read: Read]>> = {
  U8: [1, (view, at) => view.getUint8(at)],
  S8: [1, (view, at) => view.getInt8(at)],
  U16: [2, (view, at, isLittle) => view.getUint16(at, isLittle)],
  S16: [2, (view, at, isLittle) => view.getInt16(at, isLittle)],
  S32: [4, (view, at, isLittle) => view.getInt32(at, isLittle)],
  F32: [4, (view, at, isLittle) => view.getFloat32(at, isLittle)],
  F64: [8, (view, at, isLittle) => view.getFloat64(at, isLittle)],
};

/** Kind of number and names of the channels of an encoding; null where pixels share colors. */
function layoutOf(encoding: string): readonly [kind: string, channels: readonly string[]] | null {
  const [, colors, bits] = /^(rgba?|bgra?|mono)(8|16)$/.exec(encoding) ?? [];
  if (colors !== undefined && bits !== undefined) return [`U${bits}`, colors === "mono" ? [""] : Array.from(colors)];
  const [, size, kind, count] = /^(8|16|32|64)([USF])C(\d{0,3})$/.exec(encoding) ?? [];
  if (size === undefined || kind === undefined) return null;
  return [`${kind}${size}`, Array.from({ length: Number(count === "" ? 1 : count) }, () => "")];
}

/** Values of the channels at a pixel, with their names if any; null: unknown encoding. */
export function pixelValue(
  image: Image,
  x: number,
  y: number,
): readonly (readonly [name: string, value: number])[] | null {
  const layout = layoutOf(image.encoding);
  if (layout === null) return null;
  const [kind, channels] = layout;
  const [bytes, read] = READS[kind] ?? [0, null];
  const at = y * image.step + x * bytes * channels.length;
  if (
    read === null ||
    x < 0 ||
    y < 0 ||
    x >= image.width ||
    y >= image.height ||
    at + bytes * channels.length > image.data.length
  )
    return null;
  const view = new DataView(image.data.buffer, image.data.byteOffset, image.data.byteLength);
  return channels.map((name, index) => [name, read(view, at + index * bytes, image.is_bigendian === 0)]);
}
