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

/** moveit_msgs/AllowedCollisionEntry */
export type AllowedCollisionEntry = {
  readonly enabled: readonly boolean[];
};

/** moveit_msgs/AllowedCollisionMatrix */
export type AllowedCollisionMatrix = {
  readonly entry_names: readonly string[];
  readonly entry_values: readonly AllowedCollisionEntry[];
  readonly default_entry_names: readonly string[];
  readonly default_entry_values: readonly boolean[];
};

/** moveit_msgs/AttachedCollisionObject */
export type AttachedCollisionObject = {
  readonly link_name: string;
  readonly object: CollisionObject;
  readonly touch_links: readonly string[];
  readonly detach_posture: JointTrajectory;
  readonly weight: number;
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

/** moveit_msgs/CollisionObject: ADD 0, REMOVE 1, APPEND 2, MOVE 3 */
export type CollisionObject = {
  readonly header: Header;
  readonly pose: Pose;
  readonly id: string;
  readonly type: ObjectType;
  readonly primitives: readonly SolidPrimitive[];
  readonly primitive_poses: readonly Pose[];
  readonly meshes: readonly Mesh[];
  readonly mesh_poses: readonly Pose[];
  readonly planes: readonly Plane[];
  readonly plane_poses: readonly Pose[];
  readonly subframe_names: readonly string[];
  readonly subframe_poses: readonly Pose[];
  readonly operation: number;
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

/** moveit_msgs/ContactInformation: ROBOT_LINK 0, WORLD_OBJECT 1, ROBOT_ATTACHED 2 */
export type ContactInformation = {
  readonly header: Header;
  readonly position: Point;
  readonly normal: Vector3;
  readonly depth: number;
  readonly contact_body_1: string;
  readonly body_type_1: number;
  readonly contact_body_2: string;
  readonly body_type_2: number;
};

/** moveit_msgs/DisplayRobotState */
export type DisplayRobotState = {
  readonly state: RobotState;
  readonly highlight_links: readonly ObjectColor[];
  readonly hide: boolean;
};

/** moveit_msgs/DisplayTrajectory */
export type DisplayTrajectory = {
  readonly model_id: string;
  readonly trajectory: readonly RobotTrajectory[];
  readonly trajectory_start: RobotState;
};

/** moveit_msgs/ExecuteTrajectoryActionResult */
export type ExecuteTrajectoryActionResult = {
  readonly header: Header;
  readonly status: GoalStatus;
  readonly result: ExecuteTrajectoryResult;
};

/** moveit_msgs/ExecuteTrajectoryResult */
export type ExecuteTrajectoryResult = {
  readonly error_code: MoveItErrorCodes;
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

/** trajectory_msgs/JointTrajectory */
export type JointTrajectory = {
  readonly header: Header;
  readonly joint_names: readonly string[];
  readonly points: readonly JointTrajectoryPoint[];
};

/** trajectory_msgs/JointTrajectoryPoint */
export type JointTrajectoryPoint = {
  readonly positions: Float64Array;
  readonly velocities: Float64Array;
  readonly accelerations: Float64Array;
  readonly effort: Float64Array;
  readonly time_from_start: RosTime;
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

/** moveit_msgs/LinkPadding */
export type LinkPadding = {
  readonly link_name: string;
  readonly padding: number;
};

/** moveit_msgs/LinkScale */
export type LinkScale = {
  readonly link_name: string;
  readonly scale: number;
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

/** shape_msgs/Mesh */
export type Mesh = {
  readonly triangles: readonly MeshTriangle[];
  readonly vertices: readonly Point[];
};

/** shape_msgs/MeshTriangle */
export type MeshTriangle = {
  readonly vertex_indices: Uint32Array;
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

/** moveit_msgs/MoveGroupActionFeedback */
export type MoveGroupActionFeedback = {
  readonly header: Header;
  readonly status: GoalStatus;
  readonly feedback: MoveGroupFeedback;
};

/** moveit_msgs/MoveGroupActionResult */
export type MoveGroupActionResult = {
  readonly header: Header;
  readonly status: GoalStatus;
  readonly result: MoveGroupResult;
};

/** moveit_msgs/MoveGroupFeedback */
export type MoveGroupFeedback = {
  readonly state: string;
};

/** moveit_msgs/MoveGroupResult */
export type MoveGroupResult = {
  readonly error_code: MoveItErrorCodes;
  readonly trajectory_start: RobotState;
  readonly planned_trajectory: RobotTrajectory;
  readonly executed_trajectory: RobotTrajectory;
  readonly planning_time: number;
};

/**
 * moveit_msgs/MoveItErrorCodes: SUCCESS 1, FAILURE 99999, PLANNING_FAILED -1, INVALID_MOTION_PLAN -2,
 * MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE -3, CONTROL_FAILED -4, UNABLE_TO_AQUIRE_SENSOR_DATA -5,
 * TIMED_OUT -6, PREEMPTED -7, START_STATE_IN_COLLISION -10, START_STATE_VIOLATES_PATH_CONSTRAINTS -11,
 * START_STATE_INVALID -26, GOAL_IN_COLLISION -12, GOAL_VIOLATES_PATH_CONSTRAINTS -13, GOAL_CONSTRAINTS_VIOLATED
 * -14, GOAL_STATE_INVALID -27, UNRECOGNIZED_GOAL_TYPE -28, INVALID_GROUP_NAME -15, INVALID_GOAL_CONSTRAINTS -16,
 * INVALID_ROBOT_STATE -17, INVALID_LINK_NAME -18, INVALID_OBJECT_NAME -19, FRAME_TRANSFORM_FAILURE -21,
 * COLLISION_CHECKING_UNAVAILABLE -22, ROBOT_STATE_STALE -23, SENSOR_INFO_STALE -24, COMMUNICATION_FAILURE -25,
 * CRASH -29, ABORT -30, NO_IK_SOLUTION -31
 */
export type MoveItErrorCodes = {
  readonly val: number;
};

/** sensor_msgs/MultiDOFJointState */
export type MultiDOFJointState = {
  readonly header: Header;
  readonly joint_names: readonly string[];
  readonly transforms: readonly Transform[];
  readonly twist: readonly Twist[];
  readonly wrench: readonly Wrench[];
};

/** trajectory_msgs/MultiDOFJointTrajectory */
export type MultiDOFJointTrajectory = {
  readonly header: Header;
  readonly joint_names: readonly string[];
  readonly points: readonly MultiDOFJointTrajectoryPoint[];
};

/** trajectory_msgs/MultiDOFJointTrajectoryPoint */
export type MultiDOFJointTrajectoryPoint = {
  readonly transforms: readonly Transform[];
  readonly velocities: readonly Twist[];
  readonly accelerations: readonly Twist[];
  readonly time_from_start: RosTime;
};

/** moveit_msgs/ObjectColor */
export type ObjectColor = {
  readonly id: string;
  readonly color: ColorRGBA;
};

/** object_recognition_msgs/ObjectType */
export type ObjectType = {
  readonly key: string;
  readonly db: string;
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

/** octomap_msgs/Octomap */
export type Octomap = {
  readonly header: Header;
  readonly binary: boolean;
  readonly id: string;
  readonly resolution: number;
  readonly data: Int8Array;
};

/** octomap_msgs/OctomapWithPose */
export type OctomapWithPose = {
  readonly header: Header;
  readonly origin: Pose;
  readonly octomap: Octomap;
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

/** shape_msgs/Plane */
export type Plane = {
  readonly coef: Float64Array;
};

/** moveit_msgs/PlannerInterfaceDescription */
export type PlannerInterfaceDescription = {
  readonly name: string;
  readonly pipeline_id: string;
  readonly planner_ids: readonly string[];
};

/** moveit_msgs/PlanningScene */
export type PlanningScene = {
  readonly name: string;
  readonly robot_state: RobotState;
  readonly robot_model_name: string;
  readonly fixed_frame_transforms: readonly TransformStamped[];
  readonly allowed_collision_matrix: AllowedCollisionMatrix;
  readonly link_padding: readonly LinkPadding[];
  readonly link_scale: readonly LinkScale[];
  readonly object_colors: readonly ObjectColor[];
  readonly world: PlanningSceneWorld;
  readonly is_diff: boolean;
};

/** moveit_msgs/PlanningSceneWorld */
export type PlanningSceneWorld = {
  readonly collision_objects: readonly CollisionObject[];
  readonly octomap: OctomapWithPose;
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

/** moveit_msgs/RobotState */
export type RobotState = {
  readonly joint_state: JointState;
  readonly multi_dof_joint_state: MultiDOFJointState;
  readonly attached_collision_objects: readonly AttachedCollisionObject[];
  readonly is_diff: boolean;
};

/** moveit_msgs/RobotTrajectory */
export type RobotTrajectory = {
  readonly joint_trajectory: JointTrajectory;
  readonly multi_dof_joint_trajectory: MultiDOFJointTrajectory;
};

/**
 * shape_msgs/SolidPrimitive: BOX 1, SPHERE 2, CYLINDER 3, CONE 4, BOX_X 0, BOX_Y 1, BOX_Z 2, SPHERE_RADIUS 0,
 * CYLINDER_HEIGHT 0, CYLINDER_RADIUS 1, CONE_HEIGHT 0, CONE_RADIUS 1
 */
export type SolidPrimitive = {
  readonly type: number;
  readonly dimensions: Float64Array;
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
