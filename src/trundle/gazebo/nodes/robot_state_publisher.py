"""robot_state_publisher: publishes tf of a robot's links from joint positions."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.base.xmlnode import parse_xml
from trundle.robots.parameters import RosParameters
from trundle.robots.robot import Robot, RobotJoint, parent_from_child, read_robot
from trundle.ros import Node, StaticTransformBroadcaster, Transform, TransformBroadcaster, to_nsec
from trundle.spatial import NS_PER_S

from .host import NodeHost
from .private_parameters import private_parameters
from .rate import LogThrottle, period_ns

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_OLD_NS = 30 * NS_PER_S
_FIXED_AHEAD_NS = NS_PER_S // 2
"""Fixed joints on /tf are stamped half a second ahead, to be valid until the next message."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotFrames:
    """Joints of a robot as transforms, with the node's tf_prefix."""

    moving: dict[str, RobotJoint]
    fixed: dict[str, RobotJoint]
    mimics: dict[str, RobotJoint]
    """Joints of `moving` that mimic a joint which does not mimic itself, as in the original."""
    prefix: str = ""

    @staticmethod
    def from_robot(robot: Robot, prefix: str) -> "RobotFrames":
        """Classify joints: planar ones need several positions and are fixed, as in KDL; floating ones are ignored."""
        joints = sorted(robot.joints, key=lambda joint: joint.name)  # as std::map orders the original's messages
        moving = {j.name: j for j in joints if j.type not in ("fixed", "planar", "floating")}
        return RobotFrames(
            moving=moving,
            fixed={j.name: j for j in joints if j.type in ("fixed", "planar")},
            mimics={name: j for name, j in moving.items() if j.mimic is not None},
            prefix=prefix.strip("/"),
        )

    def positions(self, message: "sensor_msgs.JointState") -> dict[str, float]:
        """Return the position of each joint in name order, with mimic joints."""
        positions = {str(name): float(position) for name, position in zip(message.name, message.position, strict=True)}
        for name, joint in self.mimics.items():
            assert joint.mimic is not None
            if joint.mimic.joint in positions:
                mimic_position = positions[joint.mimic.joint] * joint.mimic.multiplier + joint.mimic.offset
                positions.setdefault(name, mimic_position)
        return dict(sorted(positions.items()))

    def transform(self, joint: RobotJoint, position: float, stamp_ns: int) -> Transform:
        """Return the transform of a joint's child frame in its parent frame."""
        pose = parent_from_child(joint, position)
        return Transform(
            parent=self._frame(joint.parent),
            child=self._frame(joint.child),
            stamp_ns=stamp_ns,
            translation=pose.position,
            rotation=pose.quaternion,
        )

    def _frame(self, link: str) -> str:
        name = link.removeprefix("/")
        return f"{self.prefix}/{name}" if self.prefix else name


class RobotStatePublisher:
    """Publishes moving joints at each joint_states, fixed ones at a fixed rate."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._last_published_ns: dict[str, int] = {}
        self._last_received_ns = 0
        self._no_position = LogThrottle(node, 300.0)
        self._unknown = LogThrottle(node, 10.0)
        self._old = LogThrottle(node, 10.0)

    async def run(self) -> int:
        """Read the robot once, then publish until cancelled."""
        node = self._node
        try:
            settings = await private_parameters(node)
            # The original's minimum is 1 Hz.
            self._interval_ns = period_ns(max(settings.number("publish_frequency", 50.0), 1.0))
            self._ignores_stamps = settings.flag("ignore_timestamp", default=False)
            use_tf_static = settings.flag("use_tf_static", default=node.profile.use_tf_static)
            robot, prefix = await self._robot(), await self._prefix()
            self._frames = RobotFrames.from_robot(robot, prefix)
        except TrundleError as error:
            node.log.error(str(error))
            return 1
        for joint in robot.joints:
            if joint.type == "floating":
                node.log.info(f"Floating joint. Not adding segment from {joint.parent} to {joint.child}.")
        self._broadcaster = TransformBroadcaster(node)
        node.subscribe("joint_states", "sensor_msgs/JointState", self._on_joint_states, queue_size=1)
        static = StaticTransformBroadcaster(node)
        if use_tf_static:
            await node.clock.sleep(self._interval_ns / NS_PER_S)
            if fixed := self._fixed(node.clock.now_ns()):
                static.send_transform(*fixed)
            await node.closed.wait()
            return 0
        while True:
            await node.clock.sleep(self._interval_ns / NS_PER_S)
            if fixed := self._fixed(node.clock.now_ns() + _FIXED_AHEAD_NS):
                self._broadcaster.send_transform(*fixed)

    async def _robot(self) -> Robot:
        """Read robot_description from the nearest parent namespace."""
        node = self._node
        name = await node.params.search("robot_description") or "robot_description"
        text = RosParameters({name: await node.params.get(name, None)}, "").text(name)
        report = Diagnostics()
        robot = read_robot(parse_xml(text, name=node.resolve(name), report=report), report)
        for finding in report.findings:
            node.log.debug(str(finding))
        return robot

    async def _prefix(self) -> str:
        name = await self._node.params.search("tf_prefix")
        return str(await self._node.params.get(name, "")) if name else ""

    def _fixed(self, stamp_ns: int) -> list[Transform]:
        return [self._frames.transform(joint, 0.0, stamp_ns) for joint in self._frames.fixed.values()]

    def _on_joint_states(self, message: "sensor_msgs.JointState") -> None:
        node = self._node
        if len(message.name) != len(message.position):
            if len(message.position) == 0:
                self._no_position.warn(
                    f"Robot state publisher ignored a JointState message about joint(s) "
                    f'"{message.name[0]}"(,...) whose position member was empty. '
                    "This message will not reappear for 300 seconds."
                )
            else:
                node.log.error("Robot state publisher ignored an invalid JointState message")
            return
        now, stamp_ns = node.clock.now_ns(), to_nsec(message.header.stamp)
        if now < self._last_received_ns:
            node.log.warn(
                "Moved backwards in time (probably because ROS clock was reset), re-publishing joint transforms!"
            )
            self._last_published_ns.clear()
        self._last_received_ns = now
        if stamp_ns + _OLD_NS < now:
            self._old.warn(f"Received JointState is {(now - stamp_ns) / 1e9:f} seconds old.")
        # Publishers may send different joints: the joint whose last message is oldest determines the interval.
        oldest_ns = min((self._last_published_ns.get(name, 0) for name in message.name), default=now)
        if not self._ignores_stamps and stamp_ns < min(oldest_ns, now) + self._interval_ns:
            return
        self._publish(self._frames.positions(message), stamp_ns)
        self._last_published_ns.update(dict.fromkeys(message.name, stamp_ns))

    def _publish(self, positions: dict[str, float], stamp_ns: int) -> None:
        transforms: list[Transform] = []
        for name, position in positions.items():
            joint = self._frames.moving.get(name)
            if joint is not None:
                transforms.append(self._frames.transform(joint, position, stamp_ns))
            elif name not in self._frames.fixed:
                self._unknown.warn(f'Joint state with name: "{name}" was received but not found in URDF')
        if transforms:
            self._broadcaster.send_transform(*transforms)


class StatePublisher(RobotStatePublisher):
    """Deprecated name of robot_state_publisher."""

    async def run(self) -> int:
        self._node.log.warn(
            "The 'state_publisher' executable is deprecated. Please use 'robot_state_publisher' instead"
        )
        return await super().run()
