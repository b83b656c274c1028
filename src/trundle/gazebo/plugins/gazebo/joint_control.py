"""libJointControlPlugin.so: constant targets of joints."""

import re
from typing import Self

from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation

from ..plugin import Plugin
from .joint_controller import ControlledJoint, gazebo_pid

_TYPES = ("force", "position", "velocity")


class JointControl(Plugin):
    """Commands efforts, or PID loops of position or velocity.

    Parameters, of any number of <controller type="force|position|velocity">: <joint> (a name or regular expression,
    any number), <target> [N·m or N, rad or m, rad/s or m/s], <pid_gains> p i d (1 0.1 0.01; the integral term is at
    most 1). Efforts of several controllers on one joint add up.
    """

    def __init__(self, model: ModelHandle, tag: PluginTag, sim: Simulation) -> None:
        self._model = model
        self._joints: dict[str, ControlledJoint] = {}
        parameters = TagParameters(tag.node, sim.report)
        for controller in parameters.sections("controller"):
            self._read(controller)
        parameters.report_unread()

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        del node
        return cls(model, tag, sim)

    def before_step(self, sim: Simulation) -> None:
        """Apply the efforts."""
        for joint in self._joints.values():
            joint.update(sim)

    def reset(self) -> None:
        """Reset the integrals; the targets stay."""
        for joint in self._joints.values():
            joint.reset()

    def _read(self, controller: TagParameters) -> None:
        kind = controller.attribute("type")
        if kind not in _TYPES:
            controller.warn(f"no controller type {kind!r}; types: {', '.join(_TYPES)}; it is left out")
            return
        target = controller.number("target", 0.0) if "target" in controller else None
        gains = controller.vector("pid_gains", (1.0, 0.1, 0.01))
        if kind == "force" and "pid_gains" in controller:
            controller.warn("a force controller does not use <pid_gains>; they are left out")
        for pattern in controller.texts("joint"):
            for joint in self._matching(pattern, controller):
                pid = gazebo_pid()
                if "pid_gains" in controller:
                    pid.p, pid.i, pid.d = gains
                if kind == "position":
                    joint.command_position(target, pid)
                elif kind == "velocity":
                    joint.command_velocity(target, pid)
                elif target is not None:
                    joint.command_effort(target)
        controller.report_unread()

    def _matching(self, text: str, controller: TagParameters) -> list[ControlledJoint]:
        try:
            pattern = re.compile(text)
        except (re.error, RecursionError, OverflowError) as error:
            controller.warn(f"{text!r} is not a regular expression ({error}); it is left out")
            return []
        matches = [joint for joint in self._model.joints if joint.axes and pattern.fullmatch(joint.name)]
        if not matches:
            names = ", ".join(repr(joint.name) for joint in self._model.joints) or "none"
            controller.warn(f"no movable joint matches {text!r}; joints here: {names}")
        return [self._joints.setdefault(joint.name, ControlledJoint(joint)) for joint in matches]
