"""Base of the nodes of imu_tools' two filters: topics, frames, publication."""

import math
from collections import deque
from typing import TYPE_CHECKING, Any

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, Transform, TransformBroadcaster, to_nsec
from trundle.spatial import NS_PER_S, Quaternion, Vector3, conjugate, rpy_from_quaternion

from ..host import NodeHost
from ..private_parameters import private_parameters
from ..rate import LogThrottle

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_QUEUE = 5
_WAIT_S = 10.0


class ImuNode:
    """Publishes `imu/data`, with an orientation, from `imu/data_raw` and, with use_mag, `imu/mag`.

    Each message of the magnetometer is paired with the imu's nearest in time.
    """

    uses_mag_by_default = False
    publishes_tf_by_default = False

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._imus: deque[Any] = deque(maxlen=_QUEUE)
        self._fields: deque[Any] = deque(maxlen=_QUEUE)
        self._last_ns: int | None = None
        """Stamp of the last message; None at the start and after a jump of time."""
        self._now_ns = 0

    async def run(self) -> int:
        """Filter until cancelled."""
        node = self._node
        try:
            settings = await private_parameters(node)
            self._read(settings)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._warnings = LogThrottle(node, 5.0)
        imu = node.resolve("imu")
        self._filtered = node.advertise(f"{imu}/data", "sensor_msgs/Imu", queue_size=_QUEUE)
        has_debug = settings.flag("publish_debug_topics", default=False)
        kind = "geometry_msgs/Vector3Stamped"
        self._angles = node.advertise(f"{imu}/rpy/filtered", kind, queue_size=_QUEUE) if has_debug else None
        self._broadcaster = TransformBroadcaster(node)
        topics = [f"{imu}/data_raw"]
        node.subscribe(topics[0], "sensor_msgs/Imu", self._on_imu, queue_size=_QUEUE)
        if self._uses_mag:
            topics.append(f"{imu}/mag")
            node.subscribe(topics[1], "sensor_msgs/MagneticField", self._on_field, queue_size=_QUEUE)
        while not node.closed.is_set():
            await node.clock.sleep(_WAIT_S)
            if self._last_ns is None:
                node.log.warn(f"still waiting for data on {' and '.join(topics)}...")
        return 0

    def _read(self, settings: RosParameters) -> None:
        self._uses_mag = settings.flag("use_mag", default=self.uses_mag_by_default)
        self._publishes_tf = settings.flag("publish_tf", default=self.publishes_tf_by_default)
        self._is_reversed = settings.flag("reverse_tf", default=False)
        self._fixed_frame = settings.text("fixed_frame", "odom").lstrip("/")
        self._constant_dt = settings.number("constant_dt", 0.0, minimum=0.0)
        self._jump_ns = round(settings.number("time_jump_threshold", 0.0, minimum=0.0) * NS_PER_S)
        self._variance = settings.number("orientation_stddev", 0.0, minimum=0.0) ** 2

    # -- messages

    def _on_imu(self, message: "sensor_msgs.Imu") -> None:
        if not self._uses_mag:
            self._receive(message, None)
            return
        self._imus.append(message)
        self._pair()

    def _on_field(self, message: Any) -> None:
        self._fields.append(message)
        self._pair()

    def _pair(self) -> None:
        """Use each field with the nearest imu message, once an imu message at or after its stamp has arrived."""
        while self._fields and self._imus:
            stamp_ns = to_nsec(self._fields[0].header.stamp)
            if to_nsec(self._imus[-1].header.stamp) < stamp_ns:
                return
            field = self._fields.popleft()
            nearest = min(self._imus, key=lambda imu: abs(to_nsec(imu.header.stamp) - stamp_ns))
            while self._imus.popleft() is not nearest:
                pass
            self._receive(nearest, field)

    def _receive(self, message: Any, field: Any) -> None:
        now_ns = self._node.clock.now_ns()
        if now_ns + self._jump_ns < self._now_ns:
            self._node.log.warn(f"time jumped back by {(self._now_ns - now_ns) / NS_PER_S:.1f} s; the filter restarts")
            self._last_ns = None
        self._now_ns = now_ns
        stamp_ns = to_nsec(message.header.stamp)
        turn, acceleration = _vector(message.angular_velocity), _vector(message.linear_acceleration)
        if not all(map(math.isfinite, (*turn, *acceleration))):
            self._warnings.warn("a measurement is left out: it is not finite")
            return
        direction = None if field is None else _vector(field.magnetic_field)
        if direction is not None and not all(map(math.isfinite, direction)):
            direction = None
        is_first = self._last_ns is None
        dt = self._constant_dt or (stamp_ns - (self._last_ns or stamp_ns)) / NS_PER_S
        if self._filter(turn, acceleration, direction, dt, is_first=is_first):
            self._last_ns = stamp_ns
            self._publish(message, stamp_ns)

    def _filter(
        self, turn: Vector3, acceleration: Vector3, field: Vector3 | None, dt: float, *, is_first: bool
    ) -> bool:
        """Use a measurement; False: there is no orientation yet.

        Args:
            turn: angular velocity in the imu's frame [rad/s].
            acceleration: [m/s²]
            field: magnetic field; None without.
            dt: time since the last measurement [s].
            is_first: True at the start and after a jump of time.
        """
        raise NotImplementedError

    @property
    def _orientation(self) -> Quaternion:
        """world_from_imu."""
        raise NotImplementedError

    def _corrected(self, turn: Vector3, acceleration: Vector3) -> tuple[Vector3, Vector3]:
        """Return angular velocity and acceleration in the form to publish."""
        return turn, acceleration

    def _publish(self, message: Any, stamp_ns: int) -> None:
        turn, acceleration = self._corrected(_vector(message.angular_velocity), _vector(message.linear_acceleration))
        w, x, y, z = self._orientation
        header = {"stamp": stamp_ns, "frame_id": message.header.frame_id}
        self._filtered.publish(
            {
                "header": header,
                "orientation": {"w": w, "x": x, "y": y, "z": z},
                "orientation_covariance": [self._variance if i % 4 == 0 else 0.0 for i in range(9)],
                "angular_velocity": dict(zip("xyz", turn, strict=True)),
                "angular_velocity_covariance": message.angular_velocity_covariance,
                "linear_acceleration": dict(zip("xyz", acceleration, strict=True)),
                "linear_acceleration_covariance": message.linear_acceleration_covariance,
            }
        )
        if self._angles is not None:
            angles = rpy_from_quaternion(self._orientation)
            self._angles.publish({"header": header, "vector": dict(zip("xyz", angles, strict=True))})
        if self._publishes_tf:
            self._send(message.header.frame_id.lstrip("/"), stamp_ns)

    def _send(self, frame: str, stamp_ns: int) -> None:
        parent, child, rotation = self._fixed_frame, frame, self._orientation
        if self._is_reversed:
            parent, child, rotation = child, parent, conjugate(rotation)
        self._broadcaster.send_transform(Transform(parent=parent, child=child, stamp_ns=stamp_ns, rotation=rotation))


def _vector(message: Any) -> Vector3:
    return (message.x, message.y, message.z)
