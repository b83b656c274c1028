"""libActorPlugin.so: an actor that wanders between random targets and avoids models."""

import math
from typing import Self

import numpy as np

from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation
from trundle.spatial import Pose, Vector3, normalized, subtract

from ..plugin import Plugin

_SPEED = 0.8
"""Walking speed [m/s]."""
_HEIGHT = 1.2138
"""Height of the actor's origin [m]."""
_QUARTER_TURN = 1.5707
"""π/2 as Gazebo's source has it [rad]: skins face −y and lie on their backs."""
_TARGET_RADIUS, _MIN_TARGET_DISTANCE, _REPULSION_RANGE = 0.3, 2.0, 4.0
"""Distances [m]: at which a target counts as reached, from a new target to models, and within which models repel."""
_MIN_TURN = math.radians(10)
"""Heading error [rad] above which the actor turns on the spot, by a thousandth of the error at each step."""
_X, _Y = (-3.0, 3.5), (-10.0, 2.0)
"""Bounds of the actor's position [m]."""
_MAX_TRIES = 1000


class WanderingActor(Plugin):
    """Walks an actor between targets drawn at random within x −3 to 3.5 and y −10 to 2 m.

    Parameters: <target> [m] (0 −5 1.2138), the first; <target_weight> (1.15), <obstacle_weight> (1.5): repulsion of
    models nearer than 4 m; <ignore_obstacles> with any number of <model>; <animation_factor> (4.5): seconds of the
    animation per metre. The actor's script is ignored.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, tag: PluginTag) -> None:
        parameters = TagParameters(tag.node, sim.report)
        self._model = model
        self._first_target = parameters.vector("target", (0.0, -5.0, _HEIGHT))
        self._target_weight = parameters.number("target_weight", 1.15)
        self._obstacle_weight = parameters.number("obstacle_weight", 1.5)
        self._ignored = {model.name, *parameters.section("ignore_obstacles").texts("model")}
        self._animation_factor = parameters.number("animation_factor", 4.5)
        parameters.report_unread()
        self._seed = sim.seed
        walk = self._walk = sim.actors.get(model.name)
        self.reset()
        if walk is None:
            parameters.warn(
                f"plugin {tag.name!r} is for actors; {model.name!r} is a model; the plugin moves it all the same"
            )
        else:
            walk.stop()

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        del node
        return cls(sim, model, tag)

    def reset(self) -> None:
        """Restart at the first target, with the same random sequence."""
        self._random = np.random.default_rng([self._seed, *self._model.name.encode()])
        self._target: Vector3 = self._first_target
        if self._walk is not None:
            self._walk.animation_s = 0.0

    def before_step(self, sim: Simulation) -> None:
        """Walk a step, or turn."""
        pose = self._model.pose
        if math.dist(self._target, pose.position) < _TARGET_RADIUS:
            self._target = self._draw(sim)
        direction = self._direction(sim, pose.position)
        _, _, heading = pose.rpy
        error = math.remainder(math.atan2(direction[1], direction[0]) + _QUARTER_TURN - heading, math.tau)
        x, y, _ = pose.position
        if abs(error) > _MIN_TURN:
            heading += error * 0.001
        else:
            step = _SPEED * sim.step_ns / 1e9
            x, y, heading = x + direction[0] * step, y + direction[1] * step, heading + error
        x, y = min(max(x, _X[0]), _X[1]), min(max(y, _Y[0]), _Y[1])
        if self._walk is not None:
            self._walk.animation_s += math.dist(pose.position[:2], (x, y)) * self._animation_factor
        self._model.set_pose(Pose.from_rpy(x, y, _HEIGHT, _QUARTER_TURN, 0.0, heading))

    def _direction(self, sim: Simulation, position: Vector3) -> Vector3:
        """Return the walking direction: the weighted sum of attraction and repulsion."""
        attraction = normalized(subtract(self._target, position)) or (0.0, 0.0, 0.0)
        x, y, z = (self._target_weight * component for component in attraction)
        for model in sim.models:
            if model.name in self._ignored:
                continue
            offset = subtract(model.pose.position, position)
            distance = math.hypot(*offset)
            if 0.0 < distance < _REPULSION_RANGE:
                repulsion = self._obstacle_weight / distance**2
                x, y, z = x - offset[0] * repulsion, y - offset[1] * repulsion, z - offset[2] * repulsion
        return (x, y, z)

    def _draw(self, sim: Simulation) -> Vector3:
        """Draw a target that is near neither the last one nor a model; after 1000 tries, keep the last."""
        positions = [model.pose.position for model in sim.models]
        for _ in range(_MAX_TRIES):
            candidate = (float(self._random.uniform(*_X)), float(self._random.uniform(*_Y)), self._target[2])
            if all(math.dist(candidate, position) >= _MIN_TARGET_DISTANCE for position in (self._target, *positions)):
                return candidate
        return self._target
