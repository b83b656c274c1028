"""libRandomVelocityPlugin.so: random velocities of a link."""

import math
from typing import Self

import numpy as np

from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation
from trundle.spatial import NS_PER_S, ZERO, Twist, Vector3

from ..plugin import Plugin


class RandomVelocity(Plugin):
    """Sets a velocity of <link> and draws another, in any direction, every <update_period> [s] (10).

    Further parameters: <initial_velocity> [m/s] (0 0 0), <velocity_factor> [m/s] (1), the drawn speed, and
    <min_x> … <max_z> [m/s], its bounds by axis. Rotation and collisions stay physical.
    """

    def __init__(self, link: LinkHandle, parameters: TagParameters, sim: Simulation) -> None:
        self._link = link
        self._start = parameters.vector("initial_velocity", ZERO)
        self._speed = parameters.number("velocity_factor", 1.0)
        self._update_period_ns = round(parameters.number("update_period", 10.0) * NS_PER_S)
        bounds = [
            sorted(
                parameters.number(f"{bound}_{axis}", default)
                for bound, default in (("min", -math.inf), ("max", math.inf))
            )
            for axis in "xyz"
        ]
        self._low, self._high = np.array(bounds).T
        parameters.report_unread()
        self._seed = sim.seed
        self.reset()

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        del node
        parameters = TagParameters(tag.node, sim.report)
        link = model.link(parameters.text("link"))
        if not sim.engine.writer.is_free(link.index):
            parameters.warn(f"link {link.name!r} has a joint to its parent; the plugin moves free links only")
        return cls(link, parameters, sim)

    def reset(self) -> None:
        """Restart at the initial velocity, with the same random sequence."""
        self._random = np.random.default_rng([self._seed, *self._link.name.encode()])
        self._velocity: Vector3 = self._start
        self._drawn_ns = 0

    def before_step(self, sim: Simulation) -> None:
        """Set the velocity."""
        if not sim.engine.writer.is_free(self._link.index):
            return
        if sim.time_ns - self._drawn_ns > self._update_period_ns:
            self._drawn_ns = sim.time_ns
            self._velocity = self._draw()
        self._link.set_twist(Twist(self._velocity, self._link.twist.angular))

    def _draw(self) -> Vector3:
        velocity = self._random.uniform(-1.0, 1.0, 3)
        velocity *= self._speed / (float(np.linalg.norm(velocity)) or 1.0)
        x, y, z = np.clip(velocity, self._low, self._high).tolist()
        return (x, y, z)
