/** Fields of sensor_msgs/Image that its pixels depend on. */
export interface RawImage {
  readonly width: number;
  readonly height: number;
  readonly encoding: string;
  readonly is_bigendian: number;
  readonly step: number;
  readonly data: Uint8Array;
}
