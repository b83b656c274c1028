"""libroboticsgroup_gazebo_mimic_joint_plugin.so: a joint that mimics another one."""

import math
from typing import Self

from trundle.base.diagnostics import TrundleError
from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.control import MimicAction
from trundle.sim.simulation import ModelHandle, Simulation

from .plugin import Plugin

_LAG_STEPS = 5
"""Number of steps in which an error is corrected; a correction in one step would oscillate."""


class MimicJoint(Plugin):
    """Holds <mimicJoint> at <multiplier> (1) times the position of <joint>, plus <offset> (0).

    With <hasPID> its effort is at most <maxEffort> (1) [N·m or N], else unlimited, as the original sets the position;
    in a URDF the joints are coupled then, as by <mimic>. Errors below <sensitiveness> (0) [rad or m] are ignored.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, tag: PluginTag) -> None:
        parameters = TagParameters(tag.node, sim.report)
        self._leader = model.joint(parameters.text("joint"))
        self._follower = model.joint(parameters.text("mimicJoint"))
        if not self._follower.is_driven:
            raise TrundleError(f"joint {self._follower.name!r} has no axis to drive")

        self._multiplier, self._offset = parameters.number("multiplier", 1.0), parameters.number("offset", 0.0)
        self._sensitiveness, max_effort = parameters.number("sensitiveness", 0.0), parameters.number("maxEffort", 1.0)
        self._max_effort = max_effort if "hasPID" in parameters else math.inf
        axis = self._follower.joint.axis
        self._is_coupled = axis is not None and axis.mimic is not None
        self._sim = sim
        self._action: MimicAction | None = None
        sim.on_change(self._forget_action)
        parameters.ignore("robotNamespace", "namespace")
        parameters.report_unread()

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        del node
        return cls(sim, model, tag)

    def is_active(self) -> bool:
        """Return False if the engine couples the joints."""
        return not self._is_coupled

    def before_step(self, sim: Simulation) -> None:
        """Set the follower's velocity."""
        target = self._leader.position * self._multiplier + self._offset
        if abs(target - self._follower.position) >= self._sensitiveness:
            speed = (target - self._follower.position) * 1e9 / (_LAG_STEPS * sim.step_ns)
            self._follower.command_velocity(speed, max_effort=self._max_effort)

    def step_action(self) -> tuple[MimicAction, float] | None:
        """Return the action that sets the follower's velocity at every step; None while a timed effort acts on it."""
        has_timed_effort = (self._follower, 0) in self._sim.loads.expiries.efforts
        if not self._leader.is_driven or has_timed_effort:
            return None
        if self._action is None:
            self._action = MimicAction(
                self._leader.motor,
                self._follower.motor,
                multiplier=self._multiplier,
                offset=self._offset,
                min_error=self._sensitiveness,
                max_effort=self._max_effort,
                lag_steps=_LAG_STEPS,
            )
        return self._action, math.inf

    def finish_stride(self) -> None:
        """Do nothing: no event ends a stride."""

    def _forget_action(self) -> None:
        self._action = None
