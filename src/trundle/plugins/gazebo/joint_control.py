"""libJointControlPlugin.so: constant targets of joints."""

import re
from typing import Self

from trundle.model import PluginTag
from trundle.ros import Node
from trundle.simulation import ModelHandle, Simulation
from trundle.xmlnode import XmlNode

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
        for controller in tag.node.all("controller"):
            self._read(controller, sim)
        tag.node.report_unread(sim.report)

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

    def _read(self, controller: XmlNode, sim: Simulation) -> None:
        report, kind = sim.report, controller.attribute("type")
        if kind not in _TYPES:
            report.warn(controller.at, f"no controller type {kind!r}; types: {', '.join(_TYPES)}; it is ignored")
            controller.mark_all_read()
            return
        target = None
        if controller.find("target") is not None:
            target = controller.number("target", default=0.0, report=report)
        gains = controller.vector("pid_gains", default=(1.0, 0.1, 0.01), report=report)
        if kind == "force" and controller.find("pid_gains") is not None:
            report.warn(controller.at, "a force controller does not use <pid_gains>; they are left out")
        for name in controller.all("joint"):
            for joint in self._matching(name, sim):
                pid = gazebo_pid()
                if controller.find("pid_gains") is not None:
                    pid.p, pid.i, pid.d = gains
                if kind == "position":
                    joint.command_position(target, pid)
                elif kind == "velocity":
                    joint.command_velocity(target, pid)
                elif target is not None:
                    joint.command_effort(target)
        controller.report_unread(report)

    def _matching(self, name: XmlNode, sim: Simulation) -> list[ControlledJoint]:
        try:
            pattern = re.compile(name.text)
        except (re.error, RecursionError, OverflowError) as error:
            sim.report.warn(name.at, f"{name.text!r} is not a regular expression ({error}); it is left out")
            return []
        found = [joint for joint in self._model.joints if joint.axes and pattern.fullmatch(joint.name)]
        if not found:
            there = ", ".join(repr(joint.name) for joint in self._model.joints) or "none"
            sim.report.warn(name.at, f"no movable joint matches {name.text!r}; joints here: {there}")
        return [self._joints.setdefault(joint.name, ControlledJoint(joint)) for joint in found]
