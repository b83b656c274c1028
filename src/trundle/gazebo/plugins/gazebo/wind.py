"""libWindPlugin.so: wind forces, with rise time, gusts and noise."""

import math
from typing import Self

import numpy as np

from trundle.robots.model import Noise, PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.sensors import NoiseSource
from trundle.sim.simulation import LinkHandle, Simulation
from trundle.spatial import Vector3, Wrench

from ..plugin import WorldPlugin


class Wind(WorldPlugin):
    """Applies mass · factor · (wind − velocity) at the centre of mass of every link with <enable_wind>.

    Parameters, as in Gazebo 11: <force_approximation_scaling_factor> [1/s] (required); of <horizontal><magnitude>,
    <horizontal><direction> and <vertical> the <time_for_rise> [s] (1) to the world's wind; of the first two a <sin>
    with <amplitude_percent> (a fraction, not a percentage) or <amplitude> [°] and <period> [s] (1); of all a <noise>.
    Gazebo advances the rise once for each link in the wind; Trundle once per step.
    """

    def __init__(self, sim: Simulation, tag: PluginTag) -> None:
        parameters = TagParameters(tag.node, sim.report)
        horizontal = parameters.section("horizontal")
        self._speed = _WindComponent(horizontal.section("magnitude"), "amplitude_percent", sim)
        self._heading = _WindComponent(horizontal.section("direction"), "amplitude", sim)
        self._rise = _WindComponent(parameters.section("vertical"), "", sim)
        self._factor = parameters.number("force_approximation_scaling_factor", 0.0)
        parameters.report_unread()
        if abs(self._factor) < 1e-6:
            needs = "needs a <force_approximation_scaling_factor> above 0"
            parameters.warn(f"plugin {tag.name!r} {needs}; there is no wind force")
        self._links: list[LinkHandle] = []
        self._find_links(sim)
        sim.on_change(lambda: self._find_links(sim))

    @classmethod
    def load(cls, sim: Simulation, node: Node | None, tag: PluginTag) -> Self:
        """See `WorldPlugin.load`."""
        del node
        return cls(sim, tag)

    def before_step(self, sim: Simulation) -> None:
        """Apply the wind forces."""
        if not self._links:
            return
        wx, wy, wz = self._wind_velocity(sim.world.wind, sim.time_ns / 1e9)
        twists = sim.engine.reader.link_twists()
        for link in self._links:
            vx, vy, vz = twists[link.index, :3].tolist()
            coefficient = self._factor * link.link.inertial.mass
            link.add_wrench(Wrench(force=(coefficient * (wx - vx), coefficient * (wy - vy), coefficient * (wz - vz))))

    def reset(self) -> None:
        """Restart with no wind."""
        for component in (self._speed, self._heading, self._rise):
            component.mean = 0.0

    def _find_links(self, sim: Simulation) -> None:
        """Find the links with <enable_wind>."""
        self._links = [
            link
            for model in sim.models
            for link in model.links
            if (model.model.enable_wind if link.link.enable_wind is None else link.link.enable_wind)
            and abs(self._factor) >= 1e-6
        ]

    def _wind_velocity(self, wind: Vector3, time_s: float) -> Vector3:
        """Current wind in the world [m/s]."""
        x, y, z = wind
        speed = self._speed.follow(math.hypot(x, y))
        speed = self._speed.disturb(speed * (1.0 + self._speed.sine(time_s)))
        heading = self._heading.follow(math.degrees(math.atan2(y, x)))
        heading = math.radians(self._heading.disturb(heading + self._heading.sine(time_s)))
        return (speed * math.cos(heading), speed * math.sin(heading), self._rise.disturb(self._rise.follow(z)))


class _WindComponent:
    """Speed, heading or vertical speed: a lagged mean, a sine and noise."""

    def __init__(self, parameters: TagParameters, amplitude: str, sim: Simulation) -> None:
        rise = parameters.number("time_for_rise", 1.0)
        step = sim.world.physics.max_step_size_s
        self._filter_gain = min(step / rise, 1.0) if rise > 0.0 else 1.0
        self.mean = 0.0
        self._amplitude, self._period = 0.0, 1.0
        if amplitude:
            sine = parameters.section("sin")
            self._amplitude = sine.number(amplitude, 0.0)
            self._period = sine.number("period", 1.0) or 1.0
        self._noise = NoiseSource(
            _read_noise(parameters.section("noise")), np.random.default_rng([sim.seed, *amplitude.encode()])
        )

    def follow(self, value: float) -> float:
        """Move the mean one step towards a value; return it."""
        self.mean += self._filter_gain * (value - self.mean)
        return self.mean

    def sine(self, time_s: float) -> float:
        """Return the sine's value at a time."""
        return self._amplitude * math.sin(math.tau * time_s / self._period)

    def disturb(self, value: float) -> float:
        """Return the value with noise."""
        return self._noise.apply_to_value(value)


def _read_noise(parameters: TagParameters) -> Noise:
    if parameters.attribute("type") == "none":
        return Noise()
    return Noise(
        mean=parameters.number("mean", 0.0),
        stddev=abs(parameters.number("stddev", 0.0)),
        bias_mean=parameters.number("bias_mean", 0.0),
        bias_stddev=abs(parameters.number("bias_stddev", 0.0)),
    )
