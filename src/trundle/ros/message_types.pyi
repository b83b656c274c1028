"""ROS messages by package, for annotations; import under TYPE_CHECKING. Made by typings/message_types.py."""

# ruff: noqa: N801, N815
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

class Time(Protocol):
    """time or duration."""

    sec: int
    nanosec: int

class actionlib_msgs:
    class GoalID(Protocol):
        stamp: Time
        id: str

class arbotix_msgs:
    class EnableRequest(Protocol):
        enable: bool

    class RelaxRequest(Protocol): ...

    class SetSpeedRequest(Protocol):
        speed: float

    class SetupChannelRequest(Protocol):
        topic_name: str
        pin: int
        value: int
        rate: int

class control_msgs:
    class FollowJointTrajectoryGoal(Protocol):
        trajectory: trajectory_msgs.JointTrajectory
        path_tolerance: list[control_msgs.JointTolerance]
        goal_tolerance: list[control_msgs.JointTolerance]
        goal_time_tolerance: Time

    class GripperCommand(Protocol):
        position: float
        max_effort: float

    class GripperCommandGoal(Protocol):
        command: control_msgs.GripperCommand

    class JointTolerance(Protocol):
        name: str
        position: float
        velocity: float
        acceleration: float

    class QueryTrajectoryStateRequest(Protocol):
        time: Time

class controller_manager_msgs:
    class ListControllerTypesRequest(Protocol): ...
    class ListControllersRequest(Protocol): ...

    class SwitchControllerRequest(Protocol):
        start_controllers: list[str]
        stop_controllers: list[str]
        strictness: int
        start_asap: bool
        timeout: float
        BEST_EFFORT: int
        STRICT: int

class dynamic_reconfigure:
    class BoolParameter(Protocol):
        name: str
        value: bool

    class Config(Protocol):
        bools: list[dynamic_reconfigure.BoolParameter]
        ints: list[dynamic_reconfigure.IntParameter]
        strs: list[dynamic_reconfigure.StrParameter]
        doubles: list[dynamic_reconfigure.DoubleParameter]
        groups: list[dynamic_reconfigure.GroupState]

    class DoubleParameter(Protocol):
        name: str
        value: float

    class GroupState(Protocol):
        name: str
        state: bool
        id: int
        parent: int

    class IntParameter(Protocol):
        name: str
        value: int

    class ReconfigureRequest(Protocol):
        config: dynamic_reconfigure.Config

    class StrParameter(Protocol):
        name: str
        value: str

class four_wheel_steering_msgs:
    class FourWheelSteering(Protocol):
        front_steering_angle: float
        rear_steering_angle: float
        front_steering_angle_velocity: float
        rear_steering_angle_velocity: float
        speed: float
        acceleration: float
        jerk: float

class gazebo_msgs:
    class ApplyBodyWrenchRequest(Protocol):
        body_name: str
        reference_frame: str
        reference_point: geometry_msgs.Point
        wrench: geometry_msgs.Wrench
        start_time: Time
        duration: Time

    class ApplyJointEffortRequest(Protocol):
        joint_name: str
        effort: float
        start_time: Time
        duration: Time

    class BodyRequestRequest(Protocol):
        body_name: str

    class DeleteLightRequest(Protocol):
        light_name: str

    class DeleteModelRequest(Protocol):
        model_name: str

    class GetJointPropertiesRequest(Protocol):
        joint_name: str

    class GetLightPropertiesRequest(Protocol):
        light_name: str

    class GetLinkPropertiesRequest(Protocol):
        link_name: str

    class GetLinkStateRequest(Protocol):
        link_name: str
        reference_frame: str

    class GetModelPropertiesRequest(Protocol):
        model_name: str

    class GetModelStateRequest(Protocol):
        model_name: str
        relative_entity_name: str

    class GetPhysicsPropertiesRequest(Protocol): ...
    class GetWorldPropertiesRequest(Protocol): ...

    class JointRequestRequest(Protocol):
        joint_name: str

    class LinkState(Protocol):
        link_name: str
        pose: geometry_msgs.Pose
        twist: geometry_msgs.Twist
        reference_frame: str

    class ModelState(Protocol):
        model_name: str
        pose: geometry_msgs.Pose
        twist: geometry_msgs.Twist
        reference_frame: str

    class ODEJointProperties(Protocol):
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

    class ODEPhysics(Protocol):
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

    class SetJointPropertiesRequest(Protocol):
        joint_name: str
        ode_joint_config: gazebo_msgs.ODEJointProperties

    class SetJointTrajectoryRequest(Protocol):
        model_name: str
        joint_trajectory: trajectory_msgs.JointTrajectory
        model_pose: geometry_msgs.Pose
        set_model_pose: bool
        disable_physics_updates: bool

    class SetLightPropertiesRequest(Protocol):
        light_name: str
        cast_shadows: bool
        diffuse: std_msgs.ColorRGBA
        specular: std_msgs.ColorRGBA
        attenuation_constant: float
        attenuation_linear: float
        attenuation_quadratic: float
        direction: geometry_msgs.Vector3
        pose: geometry_msgs.Pose

    class SetLinkPropertiesRequest(Protocol):
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

    class SetLinkStateRequest(Protocol):
        link_state: gazebo_msgs.LinkState

    class SetModelConfigurationRequest(Protocol):
        model_name: str
        urdf_param_name: str
        joint_names: list[str]
        joint_positions: NDArray[np.float64]

    class SetModelStateRequest(Protocol):
        model_state: gazebo_msgs.ModelState

    class SetPhysicsPropertiesRequest(Protocol):
        time_step: float
        max_update_rate: float
        gravity: geometry_msgs.Vector3
        ode_config: gazebo_msgs.ODEPhysics

    class SpawnModelRequest(Protocol):
        model_name: str
        model_xml: str
        robot_namespace: str
        initial_pose: geometry_msgs.Pose
        reference_frame: str

class geometry_msgs:
    class Point(Protocol):
        x: float
        y: float
        z: float

    class Pose(Protocol):
        position: geometry_msgs.Point
        orientation: geometry_msgs.Quaternion

    class Quaternion(Protocol):
        x: float
        y: float
        z: float
        w: float

    class Transform(Protocol):
        translation: geometry_msgs.Vector3
        rotation: geometry_msgs.Quaternion

    class TransformStamped(Protocol):
        header: std_msgs.Header
        child_frame_id: str
        transform: geometry_msgs.Transform

    class Twist(Protocol):
        linear: geometry_msgs.Vector3
        angular: geometry_msgs.Vector3

    class Vector3(Protocol):
        x: float
        y: float
        z: float

    class Wrench(Protocol):
        force: geometry_msgs.Vector3
        torque: geometry_msgs.Vector3

    class WrenchStamped(Protocol):
        header: std_msgs.Header
        wrench: geometry_msgs.Wrench

class kobuki_msgs:
    class MotorPower(Protocol):
        state: int
        OFF: int
        ON: int

class mav_msgs:
    class Actuators(Protocol):
        header: std_msgs.Header
        angles: NDArray[np.float64]
        angular_velocities: NDArray[np.float64]
        normalized: NDArray[np.float64]

class nav_msgs:
    class GetMapRequest(Protocol): ...

    class LoadMapRequest(Protocol):
        map_url: str

    class MapMetaData(Protocol):
        map_load_time: Time
        resolution: float
        width: int
        height: int
        origin: geometry_msgs.Pose

    class OccupancyGrid(Protocol):
        header: std_msgs.Header
        info: nav_msgs.MapMetaData
        data: NDArray[np.int8]

class roscpp:
    class GetLoggersRequest(Protocol): ...

    class SetLoggerLevelRequest(Protocol):
        logger: str
        level: str

class rosgraph_msgs:
    class Log(Protocol):
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
    class WindSpeed(Protocol):
        header: std_msgs.Header
        velocity: geometry_msgs.Vector3

class sensor_msgs:
    class CameraInfo(Protocol):
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

    class Image(Protocol):
        header: std_msgs.Header
        height: int
        width: int
        encoding: str
        is_bigendian: int
        step: int
        data: NDArray[np.uint8]

    class Imu(Protocol):
        header: std_msgs.Header
        orientation: geometry_msgs.Quaternion
        orientation_covariance: NDArray[np.float64]
        angular_velocity: geometry_msgs.Vector3
        angular_velocity_covariance: NDArray[np.float64]
        linear_acceleration: geometry_msgs.Vector3
        linear_acceleration_covariance: NDArray[np.float64]

    class JointState(Protocol):
        header: std_msgs.Header
        name: list[str]
        position: NDArray[np.float64]
        velocity: NDArray[np.float64]
        effort: NDArray[np.float64]

    class Joy(Protocol):
        header: std_msgs.Header
        axes: NDArray[np.float32]
        buttons: NDArray[np.int32]

    class PointCloud2(Protocol):
        header: std_msgs.Header
        height: int
        width: int
        fields: list[sensor_msgs.PointField]
        is_bigendian: bool
        point_step: int
        row_step: int
        data: NDArray[np.uint8]
        is_dense: bool

    class PointField(Protocol):
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

    class RegionOfInterest(Protocol):
        x_offset: int
        y_offset: int
        height: int
        width: int
        do_rectify: bool

class std_msgs:
    class Bool(Protocol):
        data: bool

    class ColorRGBA(Protocol):
        r: float
        g: float
        b: float
        a: float

    class Float32(Protocol):
        data: float

    class Float64(Protocol):
        data: float

    class Float64MultiArray(Protocol):
        layout: std_msgs.MultiArrayLayout
        data: NDArray[np.float64]

    class Header(Protocol):
        seq: int
        stamp: Time
        frame_id: str

    class Int32(Protocol):
        data: int

    class MultiArrayDimension(Protocol):
        label: str
        size: int
        stride: int

    class MultiArrayLayout(Protocol):
        dim: list[std_msgs.MultiArrayDimension]
        data_offset: int

class std_srvs:
    class EmptyRequest(Protocol): ...

class tf2_msgs:
    class FrameGraphRequest(Protocol): ...

    class LookupTransformGoal(Protocol):
        target_frame: str
        source_frame: str
        source_time: Time
        timeout: Time
        target_time: Time
        fixed_frame: str
        advanced: bool

    class TFMessage(Protocol):
        transforms: list[geometry_msgs.TransformStamped]

class topic_tools:
    class MuxAddRequest(Protocol):
        topic: str

    class MuxDeleteRequest(Protocol):
        topic: str

    class MuxListRequest(Protocol): ...

    class MuxSelectRequest(Protocol):
        topic: str

class trajectory_msgs:
    class JointTrajectory(Protocol):
        header: std_msgs.Header
        joint_names: list[str]
        points: list[trajectory_msgs.JointTrajectoryPoint]

    class JointTrajectoryPoint(Protocol):
        positions: NDArray[np.float64]
        velocities: NDArray[np.float64]
        accelerations: NDArray[np.float64]
        effort: NDArray[np.float64]
        time_from_start: Time

class turtlesim:
    class KillRequest(Protocol):
        name: str

    class Pose(Protocol):
        x: float
        y: float
        theta: float
        linear_velocity: float
        angular_velocity: float

    class SetPenRequest(Protocol):
        r: int
        g: int
        b: int
        width: int
        off: int

    class SpawnRequest(Protocol):
        x: float
        y: float
        theta: float
        name: str

    class TeleportAbsoluteRequest(Protocol):
        x: float
        y: float
        theta: float

    class TeleportRelativeRequest(Protocol):
        linear: float
        angular: float
