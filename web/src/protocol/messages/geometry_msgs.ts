/** Messages of geometry_msgs. */

import type { Header } from "./std_msgs";

export type Vector3 = { readonly x: number; readonly y: number; readonly z: number };
/** [m]; z of a Point32 is there, too. */
export type Point = Vector3;
export type Quaternion = { readonly x: number; readonly y: number; readonly z: number; readonly w: number };

export type Pose = { readonly position: Point; readonly orientation: Quaternion };
export type Pose2D = { readonly x: number; readonly y: number; readonly theta: number };
export type Transform = { readonly translation: Vector3; readonly rotation: Quaternion };
export type Twist = { readonly linear: Vector3; readonly angular: Vector3 };
export type Accel = Twist;
export type Wrench = { readonly force: Vector3; readonly torque: Vector3 };
export type Polygon = { readonly points: readonly Point[] };

/** Covariance: 6 × 6, by rows. */
export type PoseWithCovariance = { readonly pose: Pose; readonly covariance: Float64Array };
export type TwistWithCovariance = { readonly twist: Twist; readonly covariance: Float64Array };

export type PointStamped = { readonly header: Header; readonly point: Point };
export type Vector3Stamped = { readonly header: Header; readonly vector: Vector3 };
export type QuaternionStamped = { readonly header: Header; readonly quaternion: Quaternion };
export type PoseStamped = { readonly header: Header; readonly pose: Pose };
export type PoseArray = { readonly header: Header; readonly poses: readonly Pose[] };
export type PoseWithCovarianceStamped = { readonly header: Header; readonly pose: PoseWithCovariance };
export type TwistStamped = { readonly header: Header; readonly twist: Twist };
export type AccelStamped = { readonly header: Header; readonly accel: Accel };
export type WrenchStamped = { readonly header: Header; readonly wrench: Wrench };
export type PolygonStamped = { readonly header: Header; readonly polygon: Polygon };
export type TransformStamped = {
  readonly header: Header;
  readonly child_frame_id: string;
  readonly transform: Transform;
};
