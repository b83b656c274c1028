"""libHarnessPlugin.so: a model that hangs from a winch until it is detached."""

from typing import TYPE_CHECKING, Self

from msgspec.structs import replace

from trundle.base.diagnostics import UsageError
from trundle.robots.description import read_extra_joint
from trundle.robots.model import Joint, JointAxis, PluginTag
from trundle.robots.names import ros_name
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.control import Pid
from trundle.sim.simulation import JointHandle, ModelHandle, Simulation
from trundle.spatial import Pose

from ..plugin import Plugin

if TYPE_CHECKING:
    from trundle.ros.message_types import std_msgs

_PID = (
    *((name, name) for name in ("p", "i", "d", "i_min", "i_max")),
    ("low", "cmd_min"),
    ("high", "cmd_max"),
)
_STILL = 1e-6
"""Winch velocity [m/s] below which the position is held."""


class Harness(Plugin):
    """Joins links of the model to the world, drives the winch and detaches the model.

    Parameters: any number of <joint>, as in a model; <winch> with <joint>, <pos_pid> and <vel_pid> (p, i, d, i_max,
    i_min, cmd_max, cmd_min, all 0); <detach>: the joint to remove. `/<model>/harness/velocity` (std_msgs/Float32) is
    the winch's velocity [m/s], 0 holds; `/<model>/harness/detach` (std_msgs/Bool) detaches, once. The velocity loop
    only pulls up, as in Gazebo.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> None:
        self._sim = sim
        parameters = TagParameters(tag.node, sim.report)
        self._joints: list[JointHandle] = []
        for child in tag.node.all("joint"):
            joint = read_extra_joint(child, model.model, sim.report)
            if joint is not None:
                self._joints.append(sim.attach(_in_world(joint, model)))
        if not self._joints:
            raise UsageError("a harness needs a <joint>")
        winch = parameters.section("winch")
        self._winch: JointHandle | None = self._find_joint(model.name, winch, "joint", parameters)
        self._detachable: JointHandle | None = self._find_joint(model.name, parameters, "detach", parameters)
        self._position = _read_pid(winch.section("pos_pid"))
        self._speed = _read_pid(winch.section("vel_pid"))
        parameters.report_unread()
        self._target, self._target_speed = 0.0, 0.0
        if node is not None:
            base = f"/{ros_name(model.name)}/harness"
            node.subscribe(f"{base}/velocity", "std_msgs/Float32", self._on_velocity)
            node.subscribe(f"{base}/detach", "std_msgs/Bool", self._on_detach)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        return cls(sim, model, node, tag)

    def before_step(self, sim: Simulation) -> None:
        """Drive the winch, or hold its position."""
        if self._winch is None or not self._winch.is_valid:
            return
        dt = sim.step_ns / 1e9
        is_holding = abs(self._target_speed) < _STILL
        error = self._winch.position - self._target if is_holding else 0.0
        pull = max(self._speed.command(self._winch.velocity - self._target_speed, dt), 0.0)
        self._winch.command_effort(pull + self._position.command(error, dt))

    def reset(self) -> None:
        """Hold the winch at zero; a detached model stays detached."""
        self._target = self._target_speed = 0.0
        self._position.reset()
        self._speed.reset()

    def set_winch_velocity(self, speed: float) -> None:
        """Set the winch's velocity [m/s]; 0 holds."""
        self._target_speed = speed
        if abs(speed) < _STILL and self._winch is not None:
            self._target = self._winch.position
            self._position.reset()

    def detach(self) -> None:
        """Remove the joint; the winch stops for good."""
        if self._detachable is not None and self._detachable.is_valid:
            self._sim.detach(self._detachable.name)
            self._detachable = self._winch = None

    def _on_velocity(self, message: "std_msgs.Float32") -> None:
        self.set_winch_velocity(float(message.data))

    def _on_detach(self, message: "std_msgs.Bool") -> None:
        if message.data:
            self.detach()

    def _find_joint(self, model: str, section: TagParameters, tag: str, parameters: TagParameters) -> JointHandle:
        """Return the joint that a tag names; without one, warn and return the first."""
        name = section.text(tag, "")
        for joint in self._joints:
            if joint.name == f"{model}::{name}":
                return joint
        reporter = parameters if section.node is None else section
        reporter.warn(f"harness: no joint {name!r} for <{tag}>; the first one is used")
        return self._joints[0]


def _in_world(joint: Joint, model: ModelHandle) -> Joint:
    """Return a model's joint with names and axes in the world."""

    def world_link(link: str) -> str:
        return link if link == "world" else f"{model.name}::{link}"

    def rotate(axis: JointAxis | None, world_from_model: Pose) -> JointAxis | None:
        return None if axis is None else replace(axis, direction=world_from_model.transform_vector(axis.direction))

    return replace(
        joint,
        name=f"{model.name}::{joint.name}",
        parent=world_link(joint.parent),
        child=world_link(joint.child),
        axis=rotate(joint.axis, model.pose),
        axis2=rotate(joint.axis2, model.pose),
    )


def _read_pid(parameters: TagParameters) -> Pid:
    """Gains and limits; all default to 0, the command's limits as well."""
    return Pid(**{field: parameters.number(name, 0.0) for field, name in _PID})
