"""robot_pose_ekf/robot_pose_ekf, a node."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.robots.parameters import ParamError
from trundle.ros import Node, Transform, TransformBroadcaster, TransformError, TransformListener, to_nsec
from trundle.spatial import NS_PER_S, Pose, quaternion_from_rpy

from ..host import NodeHost
from ..private_parameters import private_parameters
from ..rate import LogThrottle, Rate
from .pose_filter import PoseFilter
from .sensors import MAX_VARIANCE, SENSORS, Sensor, read_covariance, read_pose

_Array = NDArray[np.float64]
_IMU_VARIANCE = 0.00017**2
"""Variance of each angle if a message has no covariance [rad²]."""
_MAX_DIFFERENCE_NS = NS_PER_S


class RobotPoseEkf:
    """Publishes `~odom_combined` and the transform of the robot, from `odom`, `imu_data`, `vo` and `gps`.

    Parameters, with the original's names and defaults: output_frame odom_combined, base_footprint_frame base_footprint,
    freq 30, sensor_timeout 1, odom_used, imu_used and vo_used true, gps_used false, self_diagnose. Service
    `~get_status`. The filter's time is the latest at which all active sensors have measured.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._filter: PoseFilter | None = None
        self._stamp_ns = 0
        self._sent = 0

    async def run(self) -> int:
        """Filter until cancelled."""
        node = self._node
        try:
            settings = await private_parameters(node)
            self._output = settings.text("output_frame", "odom_combined").lstrip("/")
            self._base = settings.text("base_footprint_frame", "base_footprint").lstrip("/")
            self._timeout_ns = round(settings.number("sensor_timeout", 1.0, minimum=0.0) * NS_PER_S)
            self._diagnoses = settings.flag("self_diagnose", default=False)
            rate_hz = max(settings.number("freq", 30.0), 1.0)
            self._sensors = {
                name: Sensor(name, topic, kind, indices)
                for name, (topic, kind, indices) in SENSORS.items()
                if settings.flag(f"{name}_used", default=name != "gps")
            }
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._warnings = LogThrottle(node, 5.0)
        self._buffer = TransformListener(node).buffer
        self._broadcaster = TransformBroadcaster(node)
        kind = "geometry_msgs/PoseWithCovarianceStamped"
        self._poses = node.advertise("~odom_combined", kind, queue_size=10)
        node.advertise_service("~get_status", "robot_pose_ekf/GetStatus", self._get_status)
        for sensor in self._sensors.values():

            def receive(message: Any, sensor: Sensor = sensor) -> None:
                self._receive(sensor, message)

            node.subscribe(sensor.topic, sensor.kind, receive, queue_size=10)
        rate = Rate(node, rate_hz)
        while not node.closed.is_set():
            await rate.sleep()
            self._step(node.clock.now_ns())
        return 0

    # -- sensors

    def _receive(self, sensor: Sensor, message: Any) -> None:
        sensor.count += 1
        stamp_ns = to_nsec(message.header.stamp)
        try:
            pose, covariance = self._read(sensor, message, stamp_ns)
        except (ValueError, TransformError) as error:
            self._warnings.warn(f"a measurement of {sensor.topic} is left out: {error}")
            return
        if sensor.poses and stamp_ns < sensor.poses[-1][0]:
            sensor.poses.clear()
        sensor.poses.append((stamp_ns, pose))
        sensor.covariance = covariance
        sensor.received_ns = self._node.clock.now_ns()

    def _read(self, sensor: Sensor, message: Any, stamp_ns: int) -> tuple[Pose, _Array]:
        """Return the measured pose of the robot, and the covariance of the measured elements."""
        if sensor.name == "imu":
            covariance = read_covariance(message.orientation_covariance, 3, range(3), _IMU_VARIANCE)
            orientation = read_pose((0.0, 0.0, 0.0), message.orientation)
            frame = message.header.frame_id.lstrip("/")
            imu_from_base = Pose()
            if frame != self._base:
                imu_from_base = self._buffer.lookup_transform(self._base, frame, stamp_ns).pose.inverse()
            return orientation @ Pose((0.0, 0.0, 0.0), imu_from_base.quaternion), covariance
        position, orientation = message.pose.pose.position, message.pose.pose.orientation
        height = 0.0 if sensor.name == "odom" or math.isnan(position.z) else position.z
        covariance = read_covariance(message.pose.covariance, 6, sensor.indices, None)
        if sensor.name == "gps":
            if math.isnan(position.z):
                covariance[2, :] = covariance[:, 2] = 0.0
                covariance[2, 2] = MAX_VARIANCE
            return read_pose((position.x, position.y, height), None), covariance
        return read_pose((position.x, position.y, height), orientation), covariance

    # -- steps

    def _step(self, now_ns: int) -> None:
        if now_ns < self._stamp_ns:
            self._node.log.warn("time jumped back; the filter restarts")
            self._filter = None
            for sensor in self._sensors.values():
                sensor.poses.clear()
                sensor.received_ns = sensor.last = None
        active = [sensor for sensor in self._sensors.values() if self._is_active(sensor, now_ns)]
        for sensor in self._sensors.values():
            if sensor not in active:
                sensor.last = None
        if not active:
            return
        stamps = {sensor.name: sensor.poses[-1][0] for sensor in active}
        if "odom" in stamps and "imu" in stamps and abs(stamps["odom"] - stamps["imu"]) > _MAX_DIFFERENCE_NS:
            self._warnings.warn("stamps of odometry and imu are more than a second apart")
        stamp_ns = min(now_ns, *stamps.values())
        if self._filter is None:
            self._start(active, stamp_ns)
        elif stamp_ns > self._stamp_ns:
            self._update(self._filter, active, stamp_ns)
            self._publish(self._filter, {sensor.name for sensor in active})

    def _is_active(self, sensor: Sensor, now_ns: int) -> bool:
        return sensor.received_ns is not None and now_ns - sensor.received_ns <= self._timeout_ns

    def _start(self, active: list[Sensor], stamp_ns: int) -> None:
        """Begin at the first measurement of the odometry or vo; with GPS, the position is that of the GPS."""
        poses = {sensor.name: sensor.at(stamp_ns) for sensor in active}
        orientation = next((pose for name in ("imu", "odom", "vo") if (pose := poses.get(name)) is not None), None)
        start = next((pose for name in ("odom", "vo") if (pose := poses.get(name)) is not None), None)
        if "gps" in self._sensors:
            gps = poses.get("gps")
            start = None if gps is None or orientation is None else Pose(gps.position, orientation.quaternion)
        if start is not None:
            self._filter, self._stamp_ns = PoseFilter(start), stamp_ns
            self._node.log.info("the filter begins")

    def _update(self, estimate: PoseFilter, active: list[Sensor], stamp_ns: int) -> None:
        """Add each sensor's motion since the last step; the imu's roll and pitch and GPS positions are absolute."""
        dt = (stamp_ns - self._stamp_ns) / NS_PER_S
        old = estimate.pose
        turned: dict[str, float] = {}
        estimate.predict()
        for sensor in active:
            pose, last = sensor.at(stamp_ns), sensor.last
            sensor.last = pose
            if pose is None or last is None:
                continue
            start = Pose(old.position, quaternion_from_rpy(0.0, 0.0, old.rpy[2])) if sensor.name == "odom" else old
            moved = pose if sensor.name == "gps" else start @ last.inverse() @ pose
            values = [*moved.position, *moved.rpy]
            if sensor.name == "imu":
                values[3:5] = pose.rpy[:2]
            turned[sensor.name] = values[5]
            estimate.correct(sensor.indices, [values[i] for i in sensor.indices], sensor.covariance * dt**2)
        if not turned:  # no sensor has measured a motion yet: the robot is assumed to stand still
            estimate.rest()
        self._stamp_ns = stamp_ns
        if self._diagnoses and {"odom", "imu"} <= turned.keys():
            difference = abs(math.remainder(turned["odom"] - turned["imu"], math.tau)) / dt
            if difference > 0.3 and dt > 0.01:
                self._warnings.warn(f"odometry and imu disagree by {difference:.2f} rad/s")

    def _publish(self, estimate: PoseFilter, active: set[str]) -> None:
        pose = estimate.pose
        (x, y, z), (qw, qx, qy, qz) = pose.position, pose.quaternion
        header = {"stamp": self._stamp_ns, "frame_id": self._output}
        fields = {"position": {"x": x, "y": y, "z": z}, "orientation": {"w": qw, "x": qx, "y": qy, "z": qz}}
        self._poses.publish(
            {"header": header, "pose": {"pose": fields, "covariance": estimate.covariance.ravel().tolist()}}
        )
        self._sent += 1
        self._broadcaster.send_transform(
            Transform(
                parent=self._output,
                child=self._base,
                stamp_ns=self._stamp_ns,
                translation=(x, y, z if active & {"vo", "gps"} else 0.0),
                rotation=pose.quaternion,
            )
        )

    def _get_status(self, _request: object) -> dict[str, Any]:
        now_ns, lines = self._node.clock.now_ns(), ["Input:"]
        for name, (topic, _, _) in SENSORS.items():
            sensor = self._sensors.get(name)
            is_active = sensor is not None and self._is_active(sensor, now_ns)
            lines += [
                f" * {name}",
                f"   - is {'' if sensor else 'NOT '}used",
                f"   - is {'' if is_active else 'NOT '}active",
                f"   - received {sensor.count if sensor else 0} messages",
                f"   - listens to topic {self._node.resolve(topic) if sensor else ''}",
            ]
        lines += ["Output:", " * Robot pose ekf filter", f"   - is {'NOT ' if self._filter is None else ''}active"]
        lines.append(f"   - sent {self._sent} messages")
        return {"status": "\n".join(lines) + "\n"}
