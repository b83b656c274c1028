/** Values of decoded ROS 1 messages. */

export interface RosTime {
  readonly sec: number;
  readonly nsec: number;
}

export type NumberArray =
  | Int8Array
  | Uint8Array
  | Int16Array
  | Uint16Array
  | Int32Array
  | Uint32Array
  | BigInt64Array
  | BigUint64Array
  | Float32Array
  | Float64Array;

export type RosValue = number | bigint | boolean | string | RosTime | NumberArray | RosMessage | readonly RosValue[];

export interface RosMessage {
  readonly [field: string]: RosValue;
}

/** Seconds of a ROS time or duration. */
export function seconds(time: RosTime): number {
  return time.sec + time.nsec * 1e-9;
}

/** Nanoseconds of a ROS time or duration. */
export function nanoseconds(time: RosTime): bigint {
  return BigInt(time.sec) * 1_000_000_000n + BigInt(time.nsec);
}

/** ROS time of nanoseconds. */
export function timeOf(nanoseconds: bigint): RosTime & RosMessage {
  return { sec: Number(nanoseconds / 1_000_000_000n), nsec: Number(nanoseconds % 1_000_000_000n) };
}
