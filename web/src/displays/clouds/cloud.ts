/** Points of a sensor_msgs/PointCloud2 as the GPU reads them: the message's own bytes, in words of 4. */

import type { PointCloud2, PointField } from "../../protocol/generated/ros_messages";

/** Bytes of a sensor_msgs/PointField datatype: INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64. */
const SIZES: readonly number[] = [0, 1, 1, 2, 2, 4, 4, 4, 8];
export const UINT32 = 6;
export const FLOAT32 = 7;
const FLOAT64 = 8;
/** WebGL's greatest stride is 255 bytes; strides here are multiples of 4. */
const MAX_STRIDE = 252;

export interface Channel {
  readonly name: string;
  /** Bytes from the beginning of a point. */
  readonly offset: number;
  readonly datatype: number;
}

/** Points of the same layout; words are little-endian, as every GPU's are. */
export class Cloud {
  private readonly view: DataView;

  constructor(
    readonly count: number,
    readonly words: Uint32Array,
    /** Words from a point to the next. */
    readonly stride: number,
    readonly channels: readonly Channel[],
  ) {
    this.view = new DataView(words.buffer, words.byteOffset, words.byteLength);
  }

  channel(name: string): Channel | undefined {
    return this.channels.find((channel) => channel.name === name);
  }

  /** Value of a channel at a point; integers are read as unsigned, as in rviz. */
  value({ offset, datatype }: Channel, index: number): number {
    return read(this.view, index * this.stride * 4 + offset, datatype, true);
  }

  /** All words as float32, for loops over x, y, z. */
  get floats(): Float32Array {
    return new Float32Array(this.words.buffer, this.words.byteOffset, this.words.length);
  }
}

/** Points of a message, or rviz's error. */
export function readCloud(message: PointCloud2): Cloud | string {
  const { width, height, point_step: step, data, fields } = message;
  const count = width * height;
  if (count * step !== data.length) {
    return (
      `Data size (${data.length} bytes) does not match width (${width}) times height (${height}) ` +
      `times point_step (${step}).  Dropping message.`
    );
  }
  const channels = fields.filter(({ datatype }) => (SIZES[datatype] ?? 0) > 0);
  if (!hasPosition(channels)) return "No position transformer available for cloud";
  const overrun = channels.find((field) => field.offset + size(field) > step);
  if (overrun !== undefined) {
    return `Field ${overrun.name} at offset ${overrun.offset} reaches beyond point_step (${step}).  Dropping message.`;
  }
  const isWordwise = !message.is_bigendian && step % 4 === 0 && step <= MAX_STRIDE && channels.every(isInWords);
  if (!isWordwise) return repack(count, step, data, channels, !message.is_bigendian);
  const aligned = data.byteOffset % 4 === 0 ? data : data.slice();
  const words = new Uint32Array(aligned.buffer, aligned.byteOffset, data.length / 4);
  return new Cloud(count, words, step / 4, channels);
}

function hasPosition(channels: readonly PointField[]): boolean {
  return ["x", "y", "z"].every((axis) => channels.find(({ name }) => name === axis)?.datatype === FLOAT32);
}

function size({ datatype }: Channel): number {
  return SIZES[datatype] ?? 0;
}

function isInWords(channel: Channel): boolean {
  const bytes = size(channel);
  return bytes >= 4 ? channel.offset % 4 === 0 : (channel.offset % 4) + bytes <= 4;
}

/** Copy points that no vertex attribute can address, with one word for each channel. */
function repack(count: number, step: number, data: Uint8Array, channels: readonly Channel[], isLittle: boolean): Cloud {
  const from = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const used = channels.slice(0, MAX_STRIDE / 4);
  const words = new Uint32Array(count * used.length);
  const floats = new Float32Array(words.buffer);
  used.forEach(({ offset, datatype }, word) => {
    const target = datatype === FLOAT64 ? floats : words;
    const wordType = datatype === FLOAT32 ? UINT32 : datatype; // copies the bits of a float32 unchanged
    for (let index = 0; index < count; index++) {
      target[index * used.length + word] = read(from, index * step + offset, wordType, isLittle);
    }
  });
  const packed = used.map(({ name, datatype }, word) => ({
    name,
    offset: word * 4,
    datatype: datatype >= FLOAT32 ? FLOAT32 : UINT32,
  }));
  return new Cloud(count, words, used.length, packed);
}

function read(view: DataView, at: number, datatype: number, isLittle: boolean): number {
  switch (SIZES[datatype]) {
    case 1:
      return view.getUint8(at);
    case 2:
      return view.getUint16(at, isLittle);
    case 8:
      return view.getFloat64(at, isLittle);
    default:
      return datatype === FLOAT32 ? view.getFloat32(at, isLittle) : view.getUint32(at, isLittle);
  }
}

/** A cloud of float32 channels from one array per point: `values` holds x, y, z and the further channels. */
export function cloudOf(names: readonly string[], values: Float32Array): Cloud {
  const channels = names.map((name, word) => ({ name, offset: word * 4, datatype: FLOAT32 }));
  const words = new Uint32Array(values.buffer, values.byteOffset, values.length);
  return new Cloud(values.length / names.length, words, names.length, channels);
}
