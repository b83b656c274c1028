"""libInitialVelocityPlugin.so: initial velocity of a model."""

from typing import Self

from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation
from trundle.spatial import ZERO, Twist

from ..plugin import Plugin


class InitialVelocity(Plugin):
    """Sets <linear> [m/s] and <angular> [rad/s], in world axes, of each free link before the first step."""

    period_ns = 1 << 62  # called once, at the start

    def __init__(self, model: ModelHandle, twist: Twist) -> None:
        self._model = model
        self._twist = twist
        self._is_due = True

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        del node
        parameters = TagParameters(tag.node, sim.report)
        linear = parameters.vector("linear", ZERO)
        angular = parameters.vector("angular", ZERO)
        parameters.report_unread()
        return cls(model, Twist(linear, angular))

    def before_step(self, sim: Simulation) -> None:
        """Set the velocity, once."""
        del sim
        if self._is_due:
            self._is_due = False
            self._model.set_link_twists(self._twist)

    def reset(self) -> None:
        """Set the velocity again at the next step."""
        self._is_due = True
