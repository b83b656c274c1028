"""ROS messages by package, for annotations; import under TYPE_CHECKING. Made by typings/message_types.py."""

# ruff: noqa: N801, N815
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .messages.raw_message import TypedMessage

class Time(TypedMessage, Protocol):
    """time or duration."""

    sec: int
    nanosec: int

class actionlib_msgs:
    class GoalID(TypedMessage, Protocol):
        stamp: Time
        id: str

class arbotix_msgs:
    class EnableRequest(TypedMessage, Protocol):
        enable: bool

    class RelaxRequest(TypedMessage, Protocol): ...

    class SetSpeedRequest(TypedMessage, Protocol):
        speed: float

    class SetupChannelRequest(TypedMessage, Protocol):
        topic_name: str
        pin: int
        value: int
        rate: int

class control_msgs:
    class FollowJointTrajectoryGoal(TypedMessage, Protocol):
        trajectory: trajectory_msgs.JointTrajectory
        path_tolerance: list[control_msgs.JointTolerance]
        goal_tolerance: list[control_msgs.JointTolerance]
        goal_time_tolerance: Time

    class GripperCommand(TypedMessage, Protocol):
        position: float
        max_effort: float

    class GripperCommandGoal(TypedMessage, Protocol):
        command: control_msgs.GripperCommand

    class JointTolerance(TypedMessage, Protocol):
        name: str
        position: float
        velocity: float
        acceleration: float

    class PointHeadGoal(TypedMessage, Protocol):
        target: geometry_msgs.PointStamped
        pointing_axis: geometry_msgs.Vector3
        pointing_frame: str
        min_duration: Time
        max_velocity: float

    class QueryTrajectoryStateRequest(TypedMessage, Protocol):
        time: Time

class controller_manager_msgs:
    class ListControllerTypesRequest(TypedMessage, Protocol): ...
    class ListControllersRequest(TypedMessage, Protocol): ...

    class SwitchControllerRequest(TypedMessage, Protocol):
        start_controllers: list[str]
        stop_controllers: list[str]
        strictness: int
        start_asap: bool
        timeout: float
        BEST_EFFORT: int
        STRICT: int

class dynamic_reconfigure:
    class BoolParameter(TypedMessage, Protocol):
        name: str
        value: bool

    class Config(TypedMessage, Protocol):
        bools: list[dynamic_reconfigure.BoolParameter]
        ints: list[dynamic_reconfigure.IntParameter]
        strs: list[dynamic_reconfigure.StrParameter]
        doubles: list[dynamic_reconfigure.DoubleParameter]
        groups: list[dynamic_reconfigure.GroupState]

    class DoubleParameter(TypedMessage, Protocol):
        name: str
        value: float

    class GroupState(TypedMessage, Protocol):
        name: str
        state: bool
        id: int
        parent: int

    class IntParameter(TypedMessage, Protocol):
        name: str
        value: int

    class ReconfigureRequest(TypedMessage, Protocol):
        config: dynamic_reconfigure.Config

    class StrParameter(TypedMessage, Protocol):
        name: str
        value: str

class four_wheel_steering_msgs:
    class FourWheelSteering(TypedMessage, Protocol):
        front_steering_angle: float
        rear_steering_angle: float
        front_steering_angle_velocity: float
        rear_steering_angle_velocity: float
        speed: float
        acceleration: float
        jerk: float

class gazebo_msgs:
    class ApplyBodyWrenchRequest(TypedMessage, Protocol):
        body_name: str
        reference_frame: str
        reference_point: geometry_msgs.Point
        wrench: geometry_msgs.Wrench
        start_time: Time
        duration: Time

    class ApplyJointEffortRequest(TypedMessage, Protocol):
        joint_name: str
        effort: float
        start_time: Time
        duration: Time

    class BodyRequestRequest(TypedMessage, Protocol):
        body_name: str

    class DeleteLightRequest(TypedMessage, Protocol):
        light_name: str

    class DeleteModelRequest(TypedMessage, Protocol):
        model_name: str

    class GetJointPropertiesRequest(TypedMessage, Protocol):
        joint_name: str

    class GetLightPropertiesRequest(TypedMessage, Protocol):
        light_name: str

    class GetLinkPropertiesRequest(TypedMessage, Protocol):
        link_name: str

    class GetLinkStateRequest(TypedMessage, Protocol):
        link_name: str
        reference_frame: str

    class GetModelPropertiesRequest(TypedMessage, Protocol):
        model_name: str

    class GetModelStateRequest(TypedMessage, Protocol):
        model_name: str
        relative_entity_name: str

    class GetPhysicsPropertiesRequest(TypedMessage, Protocol): ...
    class GetWorldPropertiesRequest(TypedMessage, Protocol): ...

    class JointRequestRequest(TypedMessage, Protocol):
        joint_name: str

    class LinkState(TypedMessage, Protocol):
        link_name: str
        pose: geometry_msgs.Pose
        twist: geometry_msgs.Twist
        reference_frame: str

    class ModelState(TypedMessage, Protocol):
        model_name: str
        pose: geometry_msgs.Pose
        twist: geometry_msgs.Twist
        reference_frame: str

    class ODEJointProperties(TypedMessage, Protocol):
        damping: NDArray[np.float64]
        hiStop: NDArray[np.float64]
        loStop: NDArray[np.float64]
        erp: NDArray[np.float64]
        cfm: NDArray[np.float64]
        stop_erp: NDArray[np.float64]
        stop_cfm: NDArray[np.float64]
        fudge_factor: NDArray[np.float64]
        fmax: NDArray[np.float64]
        vel: NDArray[np.float64]

    class ODEPhysics(TypedMessage, Protocol):
        auto_disable_bodies: bool
        sor_pgs_precon_iters: int
        sor_pgs_iters: int
        sor_pgs_w: float
        sor_pgs_rms_error_tol: float
        contact_surface_layer: float
        contact_max_correcting_vel: float
        cfm: float
        erp: float
        max_contacts: int

    class SetJointPropertiesRequest(TypedMessage, Protocol):
        joint_name: str
        ode_joint_config: gazebo_msgs.ODEJointProperties

    class SetJointTrajectoryRequest(TypedMessage, Protocol):
        model_name: str
        joint_trajectory: trajectory_msgs.JointTrajectory
        model_pose: geometry_msgs.Pose
        set_model_pose: bool
        disable_physics_updates: bool

    class SetLightPropertiesRequest(TypedMessage, Protocol):
        light_name: str
        cast_shadows: bool
        diffuse: std_msgs.ColorRGBA
        specular: std_msgs.ColorRGBA
        attenuation_constant: float
        attenuation_linear: float
        attenuation_quadratic: float
        direction: geometry_msgs.Vector3
        pose: geometry_msgs.Pose

    class SetLinkPropertiesRequest(TypedMessage, Protocol):
        link_name: str
        com: geometry_msgs.Pose
        gravity_mode: bool
        mass: float
        ixx: float
        ixy: float
        ixz: float
        iyy: float
        iyz: float
        izz: float

    class SetLinkStateRequest(TypedMessage, Protocol):
        link_state: gazebo_msgs.LinkState

    class SetModelConfigurationRequest(TypedMessage, Protocol):
        model_name: str
        urdf_param_name: str
        joint_names: list[str]
        joint_positions: NDArray[np.float64]

    class SetModelStateRequest(TypedMessage, Protocol):
        model_state: gazebo_msgs.ModelState

    class SetPhysicsPropertiesRequest(TypedMessage, Protocol):
        time_step: float
        max_update_rate: float
        gravity: geometry_msgs.Vector3
        ode_config: gazebo_msgs.ODEPhysics

    class SpawnModelRequest(TypedMessage, Protocol):
        model_name: str
        model_xml: str
        robot_namespace: str
        initial_pose: geometry_msgs.Pose
        reference_frame: str

class geometry_msgs:
    class Point(TypedMessage, Protocol):
        x: float
        y: float
        z: float

    class PointStamped(TypedMessage, Protocol):
        header: std_msgs.Header
        point: geometry_msgs.Point

    class Pose(TypedMessage, Protocol):
        position: geometry_msgs.Point
        orientation: geometry_msgs.Quaternion

    class PoseStamped(TypedMessage, Protocol):
        header: std_msgs.Header
        pose: geometry_msgs.Pose

    class PoseWithCovariance(TypedMessage, Protocol):
        pose: geometry_msgs.Pose
        covariance: NDArray[np.float64]

    class PoseWithCovarianceStamped(TypedMessage, Protocol):
        header: std_msgs.Header
        pose: geometry_msgs.PoseWithCovariance

    class Quaternion(TypedMessage, Protocol):
        x: float
        y: float
        z: float
        w: float

    class Transform(TypedMessage, Protocol):
        translation: geometry_msgs.Vector3
        rotation: geometry_msgs.Quaternion

    class TransformStamped(TypedMessage, Protocol):
        header: std_msgs.Header
        child_frame_id: str
        transform: geometry_msgs.Transform

    class Twist(TypedMessage, Protocol):
        linear: geometry_msgs.Vector3
        angular: geometry_msgs.Vector3

    class TwistWithCovariance(TypedMessage, Protocol):
        twist: geometry_msgs.Twist
        covariance: NDArray[np.float64]

    class Vector3(TypedMessage, Protocol):
        x: float
        y: float
        z: float

    class Wrench(TypedMessage, Protocol):
        force: geometry_msgs.Vector3
        torque: geometry_msgs.Vector3

    class WrenchStamped(TypedMessage, Protocol):
        header: std_msgs.Header
        wrench: geometry_msgs.Wrench

class kobuki_msgs:
    class MotorPower(TypedMessage, Protocol):
        state: int
        OFF: int
        ON: int

class map_msgs:
    class OccupancyGridUpdate(TypedMessage, Protocol):
        header: std_msgs.Header
        x: int
        y: int
        width: int
        height: int
        data: NDArray[np.int8]

class mav_msgs:
    class Actuators(TypedMessage, Protocol):
        header: std_msgs.Header
        angles: NDArray[np.float64]
        angular_velocities: NDArray[np.float64]
        normalized: NDArray[np.float64]

class nav_msgs:
    class GetMapRequest(TypedMessage, Protocol): ...

    class GetPlanRequest(TypedMessage, Protocol):
        start: geometry_msgs.PoseStamped
        goal: geometry_msgs.PoseStamped
        tolerance: float

    class LoadMapRequest(TypedMessage, Protocol):
        map_url: str

    class MapMetaData(TypedMessage, Protocol):
        map_load_time: Time
        resolution: float
        width: int
        height: int
        origin: geometry_msgs.Pose

    class OccupancyGrid(TypedMessage, Protocol):
        header: std_msgs.Header
        info: nav_msgs.MapMetaData
        data: NDArray[np.int8]

    class Odometry(TypedMessage, Protocol):
        header: std_msgs.Header
        child_frame_id: str
        pose: geometry_msgs.PoseWithCovariance
        twist: geometry_msgs.TwistWithCovariance

    class SetMapRequest(TypedMessage, Protocol):
        map: nav_msgs.OccupancyGrid
        initial_pose: geometry_msgs.PoseWithCovarianceStamped

class people_msgs:
    class People(TypedMessage, Protocol):
        header: std_msgs.Header
        people: list[people_msgs.Person]

    class Person(TypedMessage, Protocol):
        name: str
        position: geometry_msgs.Point
        velocity: geometry_msgs.Point
        reliability: float
        tagnames: list[str]
        tags: list[str]

class roscpp:
    class GetLoggersRequest(TypedMessage, Protocol): ...

    class SetLoggerLevelRequest(TypedMessage, Protocol):
        logger: str
        level: str

class rosgraph_msgs:
    class Log(TypedMessage, Protocol):
        header: std_msgs.Header
        level: int
        name: str
        msg: str
        file: str
        function: str
        line: int
        topics: list[str]
        DEBUG: int
        INFO: int
        WARN: int
        ERROR: int
        FATAL: int

class rotors_comm:
    class WindSpeed(TypedMessage, Protocol):
        header: std_msgs.Header
        velocity: geometry_msgs.Vector3

class sensor_msgs:
    class CameraInfo(TypedMessage, Protocol):
        header: std_msgs.Header
        height: int
        width: int
        distortion_model: str
        D: NDArray[np.float64]
        K: NDArray[np.float64]
        R: NDArray[np.float64]
        P: NDArray[np.float64]
        binning_x: int
        binning_y: int
        roi: sensor_msgs.RegionOfInterest

    class Image(TypedMessage, Protocol):
        header: std_msgs.Header
        height: int
        width: int
        encoding: str
        is_bigendian: int
        step: int
        data: NDArray[np.uint8]

    class Imu(TypedMessage, Protocol):
        header: std_msgs.Header
        orientation: geometry_msgs.Quaternion
        orientation_covariance: NDArray[np.float64]
        angular_velocity: geometry_msgs.Vector3
        angular_velocity_covariance: NDArray[np.float64]
        linear_acceleration: geometry_msgs.Vector3
        linear_acceleration_covariance: NDArray[np.float64]

    class JointState(TypedMessage, Protocol):
        header: std_msgs.Header
        name: list[str]
        position: NDArray[np.float64]
        velocity: NDArray[np.float64]
        effort: NDArray[np.float64]

    class Joy(TypedMessage, Protocol):
        header: std_msgs.Header
        axes: NDArray[np.float32]
        buttons: NDArray[np.int32]

    class LaserScan(TypedMessage, Protocol):
        header: std_msgs.Header
        angle_min: float
        angle_max: float
        angle_increment: float
        time_increment: float
        scan_time: float
        range_min: float
        range_max: float
        ranges: NDArray[np.float32]
        intensities: NDArray[np.float32]

    class PointCloud2(TypedMessage, Protocol):
        header: std_msgs.Header
        height: int
        width: int
        fields: list[sensor_msgs.PointField]
        is_bigendian: bool
        point_step: int
        row_step: int
        data: NDArray[np.uint8]
        is_dense: bool

    class PointField(TypedMessage, Protocol):
        name: str
        offset: int
        datatype: int
        count: int
        INT8: int
        UINT8: int
        INT16: int
        UINT16: int
        INT32: int
        UINT32: int
        FLOAT32: int
        FLOAT64: int

    class Range(TypedMessage, Protocol):
        header: std_msgs.Header
        radiation_type: int
        field_of_view: float
        min_range: float
        max_range: float
        range: float
        ULTRASOUND: int
        INFRARED: int

    class RegionOfInterest(TypedMessage, Protocol):
        x_offset: int
        y_offset: int
        height: int
        width: int
        do_rectify: bool

    class SetCameraInfoRequest(TypedMessage, Protocol):
        camera_info: sensor_msgs.CameraInfo

class std_msgs:
    class Bool(TypedMessage, Protocol):
        data: bool

    class ColorRGBA(TypedMessage, Protocol):
        r: float
        g: float
        b: float
        a: float

    class Float32(TypedMessage, Protocol):
        data: float

    class Float64(TypedMessage, Protocol):
        data: float

    class Float64MultiArray(TypedMessage, Protocol):
        layout: std_msgs.MultiArrayLayout
        data: NDArray[np.float64]

    class Header(TypedMessage, Protocol):
        seq: int
        stamp: Time
        frame_id: str

    class Int32(TypedMessage, Protocol):
        data: int

    class MultiArrayDimension(TypedMessage, Protocol):
        label: str
        size: int
        stride: int

    class MultiArrayLayout(TypedMessage, Protocol):
        dim: list[std_msgs.MultiArrayDimension]
        data_offset: int

class std_srvs:
    class EmptyRequest(TypedMessage, Protocol): ...

class tf2_msgs:
    class FrameGraphRequest(TypedMessage, Protocol): ...

    class LookupTransformGoal(TypedMessage, Protocol):
        target_frame: str
        source_frame: str
        source_time: Time
        timeout: Time
        target_time: Time
        fixed_frame: str
        advanced: bool

    class TFMessage(TypedMessage, Protocol):
        transforms: list[geometry_msgs.TransformStamped]

class tf2_web_republisher:
    class RepublishTFsRequest(TypedMessage, Protocol):
        source_frames: list[str]
        target_frame: str
        angular_thres: float
        trans_thres: float
        rate: float
        timeout: Time

    class TFSubscriptionGoal(TypedMessage, Protocol):
        source_frames: list[str]
        target_frame: str
        angular_thres: float
        trans_thres: float
        rate: float

class topic_tools:
    class MuxAddRequest(TypedMessage, Protocol):
        topic: str

    class MuxDeleteRequest(TypedMessage, Protocol):
        topic: str

    class MuxListRequest(TypedMessage, Protocol): ...

    class MuxSelectRequest(TypedMessage, Protocol):
        topic: str

class trajectory_msgs:
    class JointTrajectory(TypedMessage, Protocol):
        header: std_msgs.Header
        joint_names: list[str]
        points: list[trajectory_msgs.JointTrajectoryPoint]

    class JointTrajectoryPoint(TypedMessage, Protocol):
        positions: NDArray[np.float64]
        velocities: NDArray[np.float64]
        accelerations: NDArray[np.float64]
        effort: NDArray[np.float64]
        time_from_start: Time

class turtlesim:
    class KillRequest(TypedMessage, Protocol):
        name: str

    class Pose(TypedMessage, Protocol):
        x: float
        y: float
        theta: float
        linear_velocity: float
        angular_velocity: float

    class SetPenRequest(TypedMessage, Protocol):
        r: int
        g: int
        b: int
        width: int
        off: int

    class SpawnRequest(TypedMessage, Protocol):
        x: float
        y: float
        theta: float
        name: str

    class TeleportAbsoluteRequest(TypedMessage, Protocol):
        x: float
        y: float
        theta: float

    class TeleportRelativeRequest(TypedMessage, Protocol):
        linear: float
        angular: float
