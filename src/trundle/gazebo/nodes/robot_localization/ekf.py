"""robot_localization/ekf_localization_node and ukf_localization_node."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, Transform, TransformBroadcaster, TransformError, TransformListener, to_nsec
from trundle.spatial import NS_PER_S, Pose, quaternion_from_rpy

from ..host import NodeHost
from ..private_parameters import private_parameters
from ..rate import LogThrottle, Rate
from .kalman import ANGLES, SIZE, Array, KalmanFilter, Measurement
from .sources import KINDS, MessageReader, Source, read_sources
from .unscented import UnscentedKalmanFilter

_NOISE = (0.05, 0.05, 0.06, 0.03, 0.03, 0.06, 0.025, 0.025, 0.04, 0.01, 0.01, 0.02, 0.01, 0.01, 0.015)
"""Default process noise: growth of the state's variances per second."""
_START_VARIANCE, _SET_VARIANCE = 1e-9, 1e-6
_WARNING_S = 5.0


class EkfLocalization:
    """Publishes `odometry/filtered` and the transform of the robot, from odometry, poses, twists and imus.

    Parameters, with the original's defaults: frequency 30, sensor_timeout (a period), two_d_mode false, map_frame map,
    odom_frame odom, base_link_frame base_link, base_link_output_frame (base_link_frame), world_frame (odom_frame),
    publish_tf true, publish_acceleration false, transform_time_offset 0, predict_to_current_time false,
    gravitational_acceleration 9.80665, process_noise_covariance and initial_estimate_covariance (225 values, or the
    15 of the diagonal), initial_state; odomN, poseN, twistN and imuN, each with _config, _differential, _relative,
    _queue_size and its rejection thresholds, imuN with _remove_gravitational_acceleration. Topic and service
    `set_pose`, service `toggle`. The filter restarts when time jumps back; late measurements are not smoothed.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._queue: list[Measurement] = []
        self._is_on = True

    async def run(self) -> int:
        """Filter until cancelled."""
        node = self._node
        try:
            settings = await private_parameters(node)
            self._read(settings)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._reset()
        self._subscribe(settings)
        rate = Rate(node, self._rate_hz)
        while not node.closed.is_set():
            await rate.sleep()
            self._step(node.clock.now_ns())
        return 0

    def _read(self, settings: RosParameters) -> None:
        self._rate_hz = settings.number("frequency", 30.0, above=0.0)
        self._timeout_ns = round(settings.number("sensor_timeout", 1.0 / self._rate_hz, minimum=0.0) * NS_PER_S)
        self._map = settings.text("map_frame", "map").lstrip("/")
        self._odom = settings.text("odom_frame", "odom").lstrip("/")
        self._base = settings.text("base_link_frame", "base_link").lstrip("/")
        self._output = settings.text("base_link_output_frame", self._base).lstrip("/")
        self._world = settings.text("world_frame", self._odom).lstrip("/")
        self._is_predicting = settings.flag("predict_to_current_time", default=False)
        self._offset_ns = round(settings.number("transform_time_offset", 0.0) * NS_PER_S)
        self._noise = _matrix(settings, "process_noise_covariance", _NOISE)
        self._start = _matrix(settings, "initial_estimate_covariance", (_START_VARIANCE,) * SIZE)
        self._initial = settings.numbers("initial_state", SIZE, (0.0,) * SIZE)
        self._reader = MessageReader(
            world=self._world,
            base=self._base,
            two_d=settings.flag("two_d_mode", default=False),
            gravity=settings.number("gravitational_acceleration", 9.80665),
            find=self._find,
        )
        self._sources = read_sources(settings)
        if not self._sources:
            raise ParamError(f"{settings.namespace}: no sensor; set odom0, pose0, twist0 or imu0 to a topic")

    def _subscribe(self, settings: RosParameters) -> None:
        node = self._node
        self._missing = LogThrottle(node, _WARNING_S)
        self._buffer = TransformListener(node).buffer
        self._topic = node.advertise("odometry/filtered", "nav_msgs/Odometry", queue_size=20)
        has_acceleration = settings.flag("publish_acceleration", default=False)
        kind = "geometry_msgs/AccelWithCovarianceStamped"
        self._accelerations = node.advertise("accel/filtered", kind, queue_size=20) if has_acceleration else None
        has_tf = settings.flag("publish_tf", default=True)
        self._broadcaster = TransformBroadcaster(node) if has_tf else None
        for source in self._sources:
            size = settings.integer(f"{source.name}_queue_size", 10, minimum=1)

            def receive(message: Any, source: Source = source) -> None:
                self._receive(source, message)

            node.subscribe(source.topic, KINDS[source.kind], receive, queue_size=size)
            node.log.info(f"{source.name}: {node.resolve(source.topic)}")
        kind = KINDS["pose"]
        node.subscribe("set_pose", kind, self._set_pose, queue_size=1)
        node.advertise_service("set_pose", "robot_localization/SetPose", self._on_set_pose)
        node.advertise_service("~toggle", "robot_localization/ToggleFilterProcessing", self._on_toggle)

    def _make_filter(self) -> KalmanFilter:
        return KalmanFilter(process_noise=self._noise, covariance=self._start, state=self._initial)

    def _reset(self) -> None:
        self._filter = self._make_filter()
        self._time_ns: int | None = None
        """Stamp of the estimate; None: no measurement yet."""
        self._now_ns = 0
        self._queue.clear()
        for source in self._sources:
            source.reset()

    def _receive(self, source: Source, message: Any) -> None:
        if self._is_on:
            roll, pitch, yaw = self._filter.state[ANGLES].tolist()
            self._queue += self._reader.read(source, message, quaternion_from_rpy(roll, pitch, yaw))

    def _step(self, now_ns: int) -> None:
        """Process the measurements up to now, and publish."""
        if now_ns < self._now_ns:
            self._node.log.warn("time jumped back; the filter restarts")
            self._reset()
        self._now_ns = now_ns
        due = sorted(
            (measurement for measurement in self._queue if measurement.stamp_ns <= now_ns),
            key=lambda measurement: measurement.stamp_ns,
        )
        self._queue = [measurement for measurement in self._queue if measurement.stamp_ns > now_ns]
        for measurement in due:
            self._process(measurement)
        if self._time_ns is None or not self._is_on:
            return
        if self._is_predicting or (not due and now_ns - self._time_ns >= self._timeout_ns):
            self._predict(now_ns)
        if not np.isfinite(self._filter.state).all():
            self._node.log.error("the estimate is not finite; the filter restarts")
            self._reset()
            return
        self._publish(self._time_ns)

    def _process(self, measurement: Measurement) -> None:
        if self._time_ns is None:
            self._time_ns = measurement.stamp_ns
            self._filter.start(measurement)
            return
        self._predict(measurement.stamp_ns)
        try:
            self._filter.correct(measurement)
        except np.linalg.LinAlgError:
            self._missing.warn("a measurement is left out: its covariance is singular")

    def _predict(self, stamp_ns: int) -> None:
        if self._time_ns is not None and stamp_ns > self._time_ns:
            self._filter.predict((stamp_ns - self._time_ns) / NS_PER_S)
            self._time_ns = stamp_ns

    def _find(self, target: str, source: str, stamp_ns: int) -> Pose | None:
        """See `FrameLookup`; without a transform at the time, the latest is used."""
        target, source = target.lstrip("/"), source.lstrip("/")
        if target == source:
            return Pose()
        for stamp in (stamp_ns, 0):
            try:
                return self._buffer.lookup_transform(target, source, stamp).pose
            except TransformError as error:
                text = str(error)
        self._missing.warn(f"a measurement in frame {source} is left out: {text}")
        return None

    def _publish(self, stamp_ns: int) -> None:
        state, covariance = self._filter.state, self._filter.covariance
        roll, pitch, yaw = state[ANGLES].tolist()
        x, y, z = state[:3].tolist()
        world_from_base = Pose((x, y, z), quaternion_from_rpy(roll, pitch, yaw))
        w, *q = world_from_base.quaternion
        pose = {"position": _xyz((x, y, z)), "orientation": {**_xyz(q), "w": w}}
        twist = {"linear": _xyz(state[6:9].tolist()), "angular": _xyz(state[9:12].tolist())}
        header = {"stamp": stamp_ns, "frame_id": self._world}
        self._topic.publish(
            {
                "header": header,
                "child_frame_id": self._output,
                "pose": {"pose": pose, "covariance": covariance[:6, :6].ravel().tolist()},
                "twist": {"twist": twist, "covariance": covariance[6:12, 6:12].ravel().tolist()},
            }
        )
        if self._accelerations is not None:
            acceleration_covariance = np.zeros((6, 6))
            acceleration_covariance[:3, :3] = covariance[12:, 12:]
            linear = {"linear": _xyz(state[12:].tolist())}
            body = {"stamp": stamp_ns, "frame_id": self._output}
            self._accelerations.publish(
                {"header": body, "accel": {"accel": linear, "covariance": acceleration_covariance.ravel().tolist()}}
            )
        if self._broadcaster is not None:
            self._send(self._broadcaster, world_from_base, stamp_ns)

    def _send(self, broadcaster: TransformBroadcaster, world_from_base: Pose, stamp_ns: int) -> None:
        """Publish the pose as a transform; if the world is the map, the odometry frame's transform."""
        parent, child, pose = self._world, self._output, world_from_base
        if self._world == self._map and self._odom != self._world:
            odom_from_base = self._find(self._odom, self._output, stamp_ns)
            if odom_from_base is None:
                return
            child, pose = self._odom, world_from_base @ odom_from_base.inverse()
        transform = Transform(
            parent=parent,
            child=child,
            stamp_ns=stamp_ns + self._offset_ns,
            translation=pose.position,
            rotation=pose.quaternion,
        )
        broadcaster.send_transform(transform)

    def _set_pose(self, message: Any) -> None:
        """Restart at a pose, at rest."""
        orientation, position = message.pose.pose.orientation, message.pose.pose.position
        world_from_frame = self._find(self._world, message.header.frame_id or self._world, 0)
        norm = math.hypot(orientation.w, orientation.x, orientation.y, orientation.z)
        if world_from_frame is None or not norm > 0.0:
            self._node.log.warn("set_pose is ignored: it has no orientation, or an unknown frame")
            return
        frame_from_pose = Pose(
            (position.x, position.y, position.z),
            (orientation.w / norm, orientation.x / norm, orientation.y / norm, orientation.z / norm),
        )
        pose = world_from_frame @ frame_from_pose
        self._reset()
        self._filter.state = np.array([*pose.position, *pose.rpy, *(0.0,) * 9])
        self._filter.covariance = _SET_VARIANCE * np.eye(SIZE)
        covariance = np.array(message.pose.covariance, dtype=float).reshape(6, 6)
        if np.isfinite(covariance).all():
            self._filter.covariance[:6, :6] = covariance
        self._time_ns = to_nsec(message.header.stamp) or self._node.clock.now_ns()

    def _on_set_pose(self, request: Any) -> dict[str, Any]:
        self._set_pose(request.pose)
        return {}

    def _on_toggle(self, request: Any) -> dict[str, Any]:
        has_changed = bool(request.on) != self._is_on
        self._is_on = bool(request.on)
        return {"status": has_changed}


class UkfLocalization(EkfLocalization):
    """EkfLocalization with an unscented filter, of the parameters alpha 0.001, kappa 0 and beta 2."""

    def _read(self, settings: RosParameters) -> None:
        super()._read(settings)
        self._alpha = settings.number("alpha", 0.001, above=0.0)
        self._kappa = settings.number("kappa", 0.0, above=-SIZE)
        self._beta = settings.number("beta", 2.0, minimum=0.0)

    def _make_filter(self) -> KalmanFilter:
        return UnscentedKalmanFilter(
            process_noise=self._noise,
            covariance=self._start,
            state=self._initial,
            alpha=self._alpha,
            kappa=self._kappa,
            beta=self._beta,
        )


def _xyz(values: Sequence[float]) -> dict[str, float]:
    return dict(zip("xyz", values, strict=True))


def _matrix(settings: RosParameters, name: str, diagonal: Sequence[float]) -> Array:
    """Read a (15, 15) matrix from all its values or its diagonal."""
    if len(settings.items(name)) == SIZE * SIZE:
        return np.array(settings.numbers(name, SIZE * SIZE)).reshape(SIZE, SIZE)
    return np.diag(np.array(settings.numbers(name, SIZE, diagonal)))
