"""joint_state_publisher: publishes positions of joints without sensors."""

import math
from dataclasses import dataclass
from typing import Any

from trundle.base.diagnostics import DescriptionError, Diagnostics, TrundleError
from trundle.base.xmlnode import XmlNode, parse_numbers, parse_xml
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Distro, Message, Node

from .host import NodeHost, Slider
from .rate import Rate

_OPTIONS = (
    "delta",
    "dependent_joints",
    "publish_default_efforts",
    "publish_default_positions",
    "publish_default_velocities",
    "rate",
    "robot_description",
    "source_list",
    "use_gui",
    "use_mimic_tags",
    "use_smallest_joint_limits",
    "zeros",
)


@dataclass(slots=True, kw_only=True)
class FreeJoint:
    """Joint whose state this node sets or receives."""

    lower: float
    upper: float
    """[rad] or [m]"""
    continuous: bool = False
    position: float | None = None
    """None: the position is not published."""
    velocity: float | None = None
    effort: float | None = None
    is_rising: bool = True

    def sweep(self, delta: float) -> None:
        """Move by `delta` between the limits, back and forth; a continuous joint wraps to its lower limit."""
        if self.position is None:
            return
        if self.is_rising:
            self.position += delta
            if self.position > self.upper:
                self.position = self.lower if self.continuous else self.upper
                self.is_rising = self.continuous
        else:
            self.position -= delta
            if self.position < self.lower:
                self.position, self.is_rising = self.lower, True


@dataclass(frozen=True, slots=True, kw_only=True)
class DependentJoint:
    """Joint that follows another joint."""

    parent: str
    factor: float = 1.0
    offset: float = 0.0


class JointSet:
    """Joints of a URDF, selected by the rules of the original."""

    def __init__(self, options: RosParameters, profile: Distro) -> None:
        self.names: list[str] = []
        """Joint names in file order."""
        self.free: dict[str, FreeJoint] = {}
        self.dependent: dict[str, DependentJoint] = _dependent(options.section("dependent_joints"))
        self._options = options
        self._zeros = options.section("zeros")
        self._skipped = ("fixed", "floating") if profile.planar_is_free else ("fixed", "floating", "planar")

    def read(self, robot: XmlNode, report: Diagnostics) -> None:
        """Add a URDF's joints; those without limits are reported and skipped."""
        for joint in robot.all("joint"):
            kind, name = joint.attribute("type") or "", joint.attribute("name") or ""
            if kind in self._skipped:
                continue
            limits = (-math.pi, math.pi) if kind == "continuous" else _limits(joint)
            if limits is None:
                report.warn(
                    joint.at,
                    f"joint {name!r} is neither fixed nor continuous, but has no limits; it is ignored",
                    "missing-limit",
                )
                continue
            self.names.append(name)
            self._add(joint, name, limits, continuous=kind == "continuous")

    def _add(self, joint: XmlNode, name: str, limits: tuple[float, float], *, continuous: bool) -> None:
        lower, upper = limits
        safety = joint.find("safety_controller")
        if safety is not None and self._options.flag("use_smallest_joint_limits", default=True):
            lower = max(lower, _number(safety.attribute("soft_lower_limit"), lower))
            upper = min(upper, _number(safety.attribute("soft_upper_limit"), upper))
        mimic = joint.find("mimic")
        if mimic is not None and self._options.flag("use_mimic_tags", default=True):
            self.dependent[name] = DependentJoint(
                parent=mimic.attribute("joint") or "",
                factor=_number(mimic.attribute("multiplier"), 1.0),
                offset=_number(mimic.attribute("offset"), 0.0),
            )
            return
        if name in self.dependent:
            return
        # The original ignores the value 0 in `zeros`: a joint whose limits exclude 0 is centred.
        zero = self._zeros.number(name, 0.0) or (0.0 if lower <= 0.0 <= upper else (lower + upper) / 2.0)
        self.free[name] = FreeJoint(
            lower=lower,
            upper=upper,
            continuous=continuous,
            position=zero if self._options.flag("publish_default_positions", default=True) else None,
            velocity=0.0 if self._options.flag("publish_default_velocities", default=False) else None,
            effort=0.0 if self._options.flag("publish_default_efforts", default=False) else None,
        )

    def update(self, message: Message) -> None:
        """Set the states of free joints from another publisher's message."""
        for index, name in enumerate(message.name):
            joint = self.free.get(name)
            if joint is not None:
                joint.position = _at(message.position, index, joint.position)
                joint.velocity = _at(message.velocity, index, joint.velocity)
                joint.effort = _at(message.effort, index, joint.effort)

    def resolve(self, name: str) -> tuple[FreeJoint, float, float]:
        """Follow a chain of dependent joints; return its free joint, factor and offset.

        Raises:
            ParamError: the chain is cyclic, or ends at an unknown joint.
        """
        factor, offset = 1.0, 0.0
        chain: list[str] = []
        while name in self.dependent:
            if name in chain:
                raise ParamError(f"Found an infinite recursive mimic chain: {', '.join([*chain, name])}")
            chain.append(name)
            joint = self.dependent[name]
            offset += factor * joint.offset
            factor *= joint.factor
            name = joint.parent
        if name not in self.free:
            raise ParamError(f"joint {chain[0] if chain else name!r} follows {name!r}, which is not a free joint")
        return self.free[name], factor, offset

    def message(self) -> dict[str, object]:
        """Return the JointState fields in file order; arrays without a known value are omitted."""
        joints = [(name, *self.resolve(name)) for name in self.names]
        fields: dict[str, Any] = {"name": [name for name, *_ in joints]}
        if self.dependent or any(joint.position is not None for joint in self.free.values()):
            fields["position"] = [
                0.0 if joint.position is None else joint.position * factor + offset
                for _, joint, factor, offset in joints
            ]
        if any(joint.velocity is not None for joint in self.free.values()):
            fields["velocity"] = [(joint.velocity or 0.0) * factor for _, joint, factor, _ in joints]
        if any(joint.effort is not None for joint in self.free.values()):
            fields["effort"] = [joint.effort or 0.0 for _, joint, *_ in joints]
        return fields


class JointStatePublisher:
    """Publishes joint_states at a fixed rate; with `use_gui`, from the page's sliders."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments
        self._node = node
        self._display = host.display
        self._always_sliders = False

    async def run(self) -> int:
        """Read the robot, then publish."""
        node = self._node
        try:
            options = RosParameters(await self._options(), node.name)
            joints = JointSet(options, node.profile)
            report = Diagnostics()
            joints.read(self._robot(options), report)
            for warning in report.findings:
                node.log.warn(warning.what)
            # Indigo's parameter, supported in every distribution.
            if self._always_sliders or options.flag("use_gui", default=False):
                self._offer_sliders(joints)
            delta = options.number("delta", 0.0)
            rate = Rate(node, options.number("rate", 10.0, above=0.0))
            joints.message()
        except TrundleError as error:
            node.log.error(str(error))
            return 1
        for source in options.texts("source_list"):
            node.subscribe(source, "sensor_msgs/JointState", joints.update)
        publisher = node.advertise("joint_states", "sensor_msgs/JointState", queue_size=5)
        while True:
            stamp_ns = node.clock.now_ns()
            if delta > 0.0:
                for joint in joints.free.values():
                    joint.sweep(delta)
            if joints.names or node.profile.publishes_empty_joint_states:
                publisher.publish({"header": {"stamp": stamp_ns}, **joints.message()})
            await rate.sleep()

    async def _options(self) -> dict[str, Any]:
        """Look up each option as `~name`, then as `name` in the node's namespace, such as `/use_gui`."""
        values: dict[str, Any] = {}
        for name in _OPTIONS:
            for candidate in (f"~{name}", name):
                value = await self._node.params.get(candidate, None)
                if value is not None:
                    values[name] = value
                    break
        return values

    def _offer_sliders(self, joints: JointSet) -> None:
        if self._display is None:
            self._node.log.warn("no page for sliders; joints keep their positions")
            return
        sliders = [
            Slider(name=name, lower=joint.lower, upper=joint.upper, position=joint.position or 0.0)
            for name, joint in joints.free.items()
        ]

        def move(name: str, position: float) -> None:
            joints.free[name].position = position

        self._display.offer_sliders(sliders, move)

    def _robot(self, options: RosParameters) -> XmlNode:
        name = f"{self._node.name}/robot_description"
        root = parse_xml(options.text("robot_description"), name=name)
        robot = root.find("robot") or root  # the original's tests nest <robot> in <urdf>, too
        if robot.tag != "robot":
            raise DescriptionError(robot.at, f"a URDF starts with <robot>, not <{robot.tag}>", "wrong-root")
        return robot


class JointStatePublisherGui(JointStatePublisher):
    """joint_state_publisher_gui: always with sliders."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        super().__init__(node, arguments, host)
        self._always_sliders = True


def _dependent(settings: RosParameters) -> dict[str, DependentJoint]:
    return {
        name: DependentJoint(
            parent=settings.section(name).text("parent"),
            factor=settings.section(name).number("factor", 1.0),
            offset=settings.section(name).number("offset", 0.0),
        )
        for name in settings.names()
    }


def _limits(joint: XmlNode) -> tuple[float, float] | None:
    limit = joint.find("limit")
    values = None if limit is None else [parse_numbers(limit.attribute(name) or "") for name in ("lower", "upper")]
    if values is None or not values[0] or not values[1]:
        return None
    return values[0][0], values[1][0]


def _number(text: str | None, default: float) -> float:
    values = parse_numbers(text or "")
    return values[0] if values else default


def _at(values: Any, index: int, default: float | None) -> float | None:
    return float(values[index]) if index < len(values) else default
