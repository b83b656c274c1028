/** Messages of sensor_msgs. */

import type { Quaternion, Vector3, Transform, Twist, Wrench } from "./geometry_msgs";
import type { Header } from "./std_msgs";

export type LaserScan = {
  readonly header: Header;
  readonly angle_min: number;
  readonly angle_max: number;
  readonly angle_increment: number;
  readonly time_increment: number;
  readonly scan_time: number;
  readonly range_min: number;
  readonly range_max: number;
  readonly ranges: Float32Array;
  readonly intensities: Float32Array;
};

export type Range = {
  readonly header: Header;
  /** 0 ultrasound, 1 infrared. */
  readonly radiation_type: number;
  readonly field_of_view: number;
  readonly min_range: number;
  readonly max_range: number;
  readonly range: number;
};

export type Image = {
  readonly header: Header;
  readonly height: number;
  readonly width: number;
  readonly encoding: string;
  readonly is_bigendian: number;
  /** Bytes of a row. */
  readonly step: number;
  readonly data: Uint8Array;
};

export type CompressedImage = { readonly header: Header; readonly format: string; readonly data: Uint8Array };

export type RegionOfInterest = {
  readonly x_offset: number;
  readonly y_offset: number;
  readonly height: number;
  readonly width: number;
  readonly do_rectify: boolean;
};

export type CameraInfo = {
  readonly header: Header;
  readonly height: number;
  readonly width: number;
  readonly distortion_model: string;
  readonly D: Float64Array;
  /** 3 × 3, by rows. */
  readonly K: Float64Array;
  readonly R: Float64Array;
  /** 3 × 4, by rows. */
  readonly P: Float64Array;
  readonly binning_x: number;
  readonly binning_y: number;
  readonly roi: RegionOfInterest;
};

export type PointField = {
  readonly name: string;
  readonly offset: number;
  /** 1 INT8, 2 UINT8, 3 INT16, 4 UINT16, 5 INT32, 6 UINT32, 7 FLOAT32, 8 FLOAT64. */
  readonly datatype: number;
  readonly count: number;
};

export type PointCloud2 = {
  readonly header: Header;
  readonly height: number;
  readonly width: number;
  readonly fields: readonly PointField[];
  readonly is_bigendian: boolean;
  readonly point_step: number;
  readonly row_step: number;
  readonly data: Uint8Array;
  readonly is_dense: boolean;
};

export type ChannelFloat32 = { readonly name: string; readonly values: Float32Array };

export type PointCloud = {
  readonly header: Header;
  readonly points: readonly Vector3[];
  readonly channels: readonly ChannelFloat32[];
};

/** Covariances: 3 × 3, by rows; −1 at the beginning: the quantity is not measured. */
export type Imu = {
  readonly header: Header;
  readonly orientation: Quaternion;
  readonly orientation_covariance: Float64Array;
  readonly angular_velocity: Vector3;
  readonly angular_velocity_covariance: Float64Array;
  readonly linear_acceleration: Vector3;
  readonly linear_acceleration_covariance: Float64Array;
};

export type MagneticField = {
  readonly header: Header;
  readonly magnetic_field: Vector3;
  readonly magnetic_field_covariance: Float64Array;
};

export type NavSatFix = {
  readonly header: Header;
  readonly status: { readonly status: number; readonly service: number };
  readonly latitude: number;
  readonly longitude: number;
  readonly altitude: number;
  readonly position_covariance: Float64Array;
  readonly position_covariance_type: number;
};

export type FluidPressure = {
  readonly header: Header;
  readonly fluid_pressure: number;
  readonly variance: number;
};
export type Illuminance = { readonly header: Header; readonly illuminance: number; readonly variance: number };
export type RelativeHumidity = {
  readonly header: Header;
  readonly relative_humidity: number;
  readonly variance: number;
};
export type Temperature = { readonly header: Header; readonly temperature: number; readonly variance: number };

export type JointState = {
  readonly header: Header;
  readonly name: readonly string[];
  readonly position: Float64Array;
  readonly velocity: Float64Array;
  readonly effort: Float64Array;
};

export type MultiDOFJointState = {
  readonly header: Header;
  readonly joint_names: readonly string[];
  readonly transforms: readonly Transform[];
  readonly twist: readonly Twist[];
  readonly wrench: readonly Wrench[];
};

export type Joy = { readonly header: Header; readonly axes: Float32Array; readonly buttons: Int32Array };

export type BatteryState = {
  readonly header: Header;
  readonly voltage: number;
  readonly current: number;
  readonly charge: number;
  readonly capacity: number;
  readonly design_capacity: number;
  /** 0…1; NaN: not measured. */
  readonly percentage: number;
  readonly power_supply_status: number;
  readonly power_supply_health: number;
  readonly power_supply_technology: number;
  readonly present: boolean;
  readonly cell_voltage: Float32Array;
  readonly location: string;
  readonly serial_number: string;
};
