/** ROS messages that displays, tools and panels know, made by web/schema. */

import type { RosTime } from "../ros_types";

/** geometry_msgs/Accel */
export type Accel = {
  readonly linear: Vector3;
  readonly angular: Vector3;
};

/** geometry_msgs/AccelStamped */
export type AccelStamped = {
  readonly header: Header;
  readonly accel: Accel;
};

/** sensor_msgs/CameraInfo */
export type CameraInfo = {
  readonly header: Header;
  readonly height: number;
  readonly width: number;
  readonly distortion_model: string;
  readonly D: Float64Array;
  readonly K: Float64Array;
  readonly R: Float64Array;
  readonly P: Float64Array;
  readonly binning_x: number;
  readonly binning_y: number;
  readonly roi: RegionOfInterest;
};

/** sensor_msgs/ChannelFloat32 */
export type ChannelFloat32 = {
  readonly name: string;
  readonly values: Float32Array;
};

/** std_msgs/ColorRGBA */
export type ColorRGBA = {
  readonly r: number;
  readonly g: number;
  readonly b: number;
  readonly a: number;
};

/** sensor_msgs/CompressedImage */
export type CompressedImage = {
  readonly header: Header;
  readonly format: string;
  readonly data: Uint8Array;
};

/** sensor_msgs/FluidPressure */
export type FluidPressure = {
  readonly header: Header;
  readonly fluid_pressure: number;
  readonly variance: number;
};

/** actionlib_msgs/GoalID */
export type GoalID = {
  readonly stamp: RosTime;
  readonly id: string;
};

/**
 * actionlib_msgs/GoalStatus: PENDING 0, ACTIVE 1, PREEMPTED 2, SUCCEEDED 3, ABORTED 4, REJECTED 5, PREEMPTING 6,
 * RECALLING 7, RECALLED 8, LOST 9
 */
export type GoalStatus = {
  readonly goal_id: GoalID;
  readonly status: number;
  readonly text: string;
};

/** actionlib_msgs/GoalStatusArray */
export type GoalStatusArray = {
  readonly header: Header;
  readonly status_list: readonly GoalStatus[];
};

/** nav_msgs/GridCells */
export type GridCells = {
  readonly header: Header;
  readonly cell_width: number;
  readonly cell_height: number;
  readonly cells: readonly Point[];
};

/** std_msgs/Header */
export type Header = {
  readonly seq: number;
  readonly stamp: RosTime;
  readonly frame_id: string;
};

/** sensor_msgs/Illuminance */
export type Illuminance = {
  readonly header: Header;
  readonly illuminance: number;
  readonly variance: number;
};

/** sensor_msgs/Image */
export type Image = {
  readonly header: Header;
  readonly height: number;
  readonly width: number;
  readonly encoding: string;
  readonly is_bigendian: number;
  readonly step: number;
  readonly data: Uint8Array;
};

/** sensor_msgs/Imu */
export type Imu = {
  readonly header: Header;
  readonly orientation: Quaternion;
  readonly orientation_covariance: Float64Array;
  readonly angular_velocity: Vector3;
  readonly angular_velocity_covariance: Float64Array;
  readonly linear_acceleration: Vector3;
  readonly linear_acceleration_covariance: Float64Array;
};

/** visualization_msgs/InteractiveMarker */
export type InteractiveMarker = {
  readonly header: Header;
  readonly pose: Pose;
  readonly name: string;
  readonly description: string;
  readonly scale: number;
  readonly menu_entries: readonly MenuEntry[];
  readonly controls: readonly InteractiveMarkerControl[];
};

/**
 * visualization_msgs/InteractiveMarkerControl: INHERIT 0, FIXED 1, VIEW_FACING 2, NONE 0, MENU 1, BUTTON 2,
 * MOVE_AXIS 3, MOVE_PLANE 4, ROTATE_AXIS 5, MOVE_ROTATE 6, MOVE_3D 7, ROTATE_3D 8, MOVE_ROTATE_3D 9
 */
export type InteractiveMarkerControl = {
  readonly name: string;
  readonly orientation: Quaternion;
  readonly orientation_mode: number;
  readonly interaction_mode: number;
  readonly always_visible: boolean;
  readonly markers: readonly Marker[];
  readonly independent_marker_orientation: boolean;
  readonly description: string;
};

/**
 * visualization_msgs/InteractiveMarkerFeedback: KEEP_ALIVE 0, POSE_UPDATE 1, MENU_SELECT 2, BUTTON_CLICK 3,
 * MOUSE_DOWN 4, MOUSE_UP 5
 */
export type InteractiveMarkerFeedback = {
  readonly header: Header;
  readonly client_id: string;
  readonly marker_name: string;
  readonly control_name: string;
  readonly event_type: number;
  readonly pose: Pose;
  readonly menu_entry_id: number;
  readonly mouse_point: Point;
  readonly mouse_point_valid: boolean;
};

/** visualization_msgs/InteractiveMarkerInit */
export type InteractiveMarkerInit = {
  readonly server_id: string;
  readonly seq_num: bigint;
  readonly markers: readonly InteractiveMarker[];
};

/** visualization_msgs/InteractiveMarkerPose */
export type InteractiveMarkerPose = {
  readonly header: Header;
  readonly pose: Pose;
  readonly name: string;
};

/** visualization_msgs/InteractiveMarkerUpdate: KEEP_ALIVE 0, UPDATE 1 */
export type InteractiveMarkerUpdate = {
  readonly server_id: string;
  readonly seq_num: bigint;
  readonly type: number;
  readonly markers: readonly InteractiveMarker[];
  readonly poses: readonly InteractiveMarkerPose[];
  readonly erases: readonly string[];
};

/** sensor_msgs/JointState */
export type JointState = {
  readonly header: Header;
  readonly name: readonly string[];
  readonly position: Float64Array;
  readonly velocity: Float64Array;
  readonly effort: Float64Array;
};

/** sensor_msgs/LaserScan */
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

/** nav_msgs/MapMetaData */
export type MapMetaData = {
  readonly map_load_time: RosTime;
  readonly resolution: number;
  readonly width: number;
  readonly height: number;
  readonly origin: Pose;
};

/**
 * visualization_msgs/Marker: ARROW 0, CUBE 1, SPHERE 2, CYLINDER 3, LINE_STRIP 4, LINE_LIST 5, CUBE_LIST 6,
 * SPHERE_LIST 7, POINTS 8, TEXT_VIEW_FACING 9, MESH_RESOURCE 10, TRIANGLE_LIST 11, ADD 0, MODIFY 0, DELETE 2,
 * DELETEALL 3
 */
export type Marker = {
  readonly header: Header;
  readonly ns: string;
  readonly id: number;
  readonly type: number;
  readonly action: number;
  readonly pose: Pose;
  readonly scale: Vector3;
  readonly color: ColorRGBA;
  readonly lifetime: RosTime;
  readonly frame_locked: boolean;
  readonly points: readonly Point[];
  readonly colors: readonly ColorRGBA[];
  readonly text: string;
  readonly mesh_resource: string;
  readonly mesh_use_embedded_materials: boolean;
};

/** visualization_msgs/MarkerArray */
export type MarkerArray = {
  readonly markers: readonly Marker[];
};

/** visualization_msgs/MenuEntry: FEEDBACK 0, ROSRUN 1, ROSLAUNCH 2 */
export type MenuEntry = {
  readonly id: number;
  readonly parent_id: number;
  readonly title: string;
  readonly command: string;
  readonly command_type: number;
};

/** move_base_msgs/MoveBaseActionFeedback */
export type MoveBaseActionFeedback = {
  readonly header: Header;
  readonly status: GoalStatus;
  readonly feedback: MoveBaseFeedback;
};

/** move_base_msgs/MoveBaseFeedback */
export type MoveBaseFeedback = {
  readonly base_position: PoseStamped;
};

/** nav_msgs/OccupancyGrid */
export type OccupancyGrid = {
  readonly header: Header;
  readonly info: MapMetaData;
  readonly data: Int8Array;
};

/** map_msgs/OccupancyGridUpdate */
export type OccupancyGridUpdate = {
  readonly header: Header;
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
  readonly data: Int8Array;
};

/** nav_msgs/Odometry */
export type Odometry = {
  readonly header: Header;
  readonly child_frame_id: string;
  readonly pose: PoseWithCovariance;
  readonly twist: TwistWithCovariance;
};

/** nav_msgs/Path */
export type Path = {
  readonly header: Header;
  readonly poses: readonly PoseStamped[];
};

/** geometry_msgs/Point */
export type Point = {
  readonly x: number;
  readonly y: number;
  readonly z: number;
};

/** geometry_msgs/Point32 */
export type Point32 = {
  readonly x: number;
  readonly y: number;
  readonly z: number;
};

/** sensor_msgs/PointCloud */
export type PointCloud = {
  readonly header: Header;
  readonly points: readonly Point32[];
  readonly channels: readonly ChannelFloat32[];
};

/** sensor_msgs/PointCloud2 */
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

/** sensor_msgs/PointField: INT8 1, UINT8 2, INT16 3, UINT16 4, INT32 5, UINT32 6, FLOAT32 7, FLOAT64 8 */
export type PointField = {
  readonly name: string;
  readonly offset: number;
  readonly datatype: number;
  readonly count: number;
};

/** geometry_msgs/PointStamped */
export type PointStamped = {
  readonly header: Header;
  readonly point: Point;
};

/** geometry_msgs/Polygon */
export type Polygon = {
  readonly points: readonly Point32[];
};

/** geometry_msgs/PolygonStamped */
export type PolygonStamped = {
  readonly header: Header;
  readonly polygon: Polygon;
};

/** geometry_msgs/Pose */
export type Pose = {
  readonly position: Point;
  readonly orientation: Quaternion;
};

/** geometry_msgs/PoseArray */
export type PoseArray = {
  readonly header: Header;
  readonly poses: readonly Pose[];
};

/** geometry_msgs/PoseStamped */
export type PoseStamped = {
  readonly header: Header;
  readonly pose: Pose;
};

/** geometry_msgs/PoseWithCovariance */
export type PoseWithCovariance = {
  readonly pose: Pose;
  readonly covariance: Float64Array;
};

/** geometry_msgs/PoseWithCovarianceStamped */
export type PoseWithCovarianceStamped = {
  readonly header: Header;
  readonly pose: PoseWithCovariance;
};

/** geometry_msgs/Quaternion */
export type Quaternion = {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  readonly w: number;
};

/** sensor_msgs/Range: ULTRASOUND 0, INFRARED 1 */
export type Range = {
  readonly header: Header;
  readonly radiation_type: number;
  readonly field_of_view: number;
  readonly min_range: number;
  readonly max_range: number;
  readonly range: number;
};

/** move_base_msgs/RecoveryStatus */
export type RecoveryStatus = {
  readonly pose_stamped: PoseStamped;
  readonly current_recovery_number: number;
  readonly total_number_of_recoveries: number;
  readonly recovery_behavior_name: string;
};

/** sensor_msgs/RegionOfInterest */
export type RegionOfInterest = {
  readonly x_offset: number;
  readonly y_offset: number;
  readonly height: number;
  readonly width: number;
  readonly do_rectify: boolean;
};

/** sensor_msgs/RelativeHumidity */
export type RelativeHumidity = {
  readonly header: Header;
  readonly relative_humidity: number;
  readonly variance: number;
};

/** tf2_msgs/TFMessage */
export type TFMessage = {
  readonly transforms: readonly TransformStamped[];
};

/** sensor_msgs/Temperature */
export type Temperature = {
  readonly header: Header;
  readonly temperature: number;
  readonly variance: number;
};

/** geometry_msgs/Transform */
export type Transform = {
  readonly translation: Vector3;
  readonly rotation: Quaternion;
};

/** geometry_msgs/TransformStamped */
export type TransformStamped = {
  readonly header: Header;
  readonly child_frame_id: string;
  readonly transform: Transform;
};

/** geometry_msgs/Twist */
export type Twist = {
  readonly linear: Vector3;
  readonly angular: Vector3;
};

/** geometry_msgs/TwistStamped */
export type TwistStamped = {
  readonly header: Header;
  readonly twist: Twist;
};

/** geometry_msgs/TwistWithCovariance */
export type TwistWithCovariance = {
  readonly twist: Twist;
  readonly covariance: Float64Array;
};

/** geometry_msgs/Vector3 */
export type Vector3 = {
  readonly x: number;
  readonly y: number;
  readonly z: number;
};

/** geometry_msgs/Wrench */
export type Wrench = {
  readonly force: Vector3;
  readonly torque: Vector3;
};

/** geometry_msgs/WrenchStamped */
export type WrenchStamped = {
  readonly header: Header;
  readonly wrench: Wrench;
};
