"""Command, track speeds and friction of all tracked vehicles."""

from collections.abc import Iterable

from msgspec.structs import replace

from trundle.robots.model import Link, PluginTag
from trundle.robots.names import ros_name
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation

from .velocity_command import VelocityCommand


class Tracks:
    """Turns `/<robot_namespace>/cmd_vel` into the speeds of a left and a right track.

    Parameters: <robot_namespace> (the model's name), <steering_efficiency> (0.5: ratio of the yaw rate to that of
    tracks without slip), <tracks_separation> [m] (0.4), <max_linear_speed> [m/s] (1), <max_angular_speed> [rad/s] (1),
    <track_mu>, <track_mu2>. As in Gazebo a positive yaw speeds the left track up, which turns to the right. The speeds
    are published on `/<robot_namespace>/tracks_speed` (geometry_msgs/Vector3, x left, y right).
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> None:
        parameters = TagParameters(tag.node, sim.report)
        self.efficiency = parameters.number("steering_efficiency", 0.5, above=0.0)
        self.separation = parameters.number("tracks_separation", 0.4, above=0.0)
        self._max_speed = parameters.number("max_linear_speed", 1.0, above=0.0)
        self._max_yaw_rate = abs(parameters.number("max_angular_speed", 1.0))
        namespace = ros_name(parameters.text("robot_namespace", "") or model.name).strip("/")
        self._mu = _friction(parameters, "track_mu"), _friction(parameters, "track_mu2")
        self.command = VelocityCommand(f"/{namespace}/cmd_vel", node)
        self._published = (0.0, 0.0)
        self._topic = None
        if node is not None:
            self._topic = node.advertise(f"/{namespace}/tracks_speed", "geometry_msgs/Vector3", queue_size=10)

    @property
    def speeds(self) -> tuple[float, float]:
        """Speeds of the left and the right track [m/s], positive forwards."""
        speed = _clamp(self.command.speed, self._max_speed)
        half_difference = _clamp(self.command.yaw_rate, self._max_yaw_rate) * self.separation / 2 / self.efficiency
        left, right = _clamp(speed + half_difference, self._max_speed), _clamp(speed - half_difference, self._max_speed)
        if self._topic is not None and self._published != (left, right):
            self._published = (left, right)
            self._topic.publish({"x": left, "y": right})
        return left, right

    def set_friction(self, sim: Simulation, links: Iterable[LinkHandle]) -> None:
        """Set <track_mu> and <track_mu2> of these links' surfaces."""
        mu, mu2 = self._mu
        if mu is None and mu2 is None:
            return

        def with_friction(link: Link) -> Link:
            surfaces = [
                replace(
                    collision.surface,
                    mu=collision.surface.mu if mu is None else mu,
                    mu2=collision.surface.mu2 if mu2 is None else mu2,
                )
                for collision in link.collisions
            ]
            collisions = zip(link.collisions, surfaces, strict=True)
            return replace(
                link, collisions=tuple(replace(collision, surface=surface) for collision, surface in collisions)
            )

        link_ids = {id(link.link) for link in links}
        models = [
            replace(model, links=tuple(with_friction(link) if id(link) in link_ids else link for link in model.links))
            for model in sim.world.models
        ]
        sim.edit(replace(sim.world, models=tuple(models)))


def _friction(parameters: TagParameters, name: str) -> float | None:
    return parameters.number(name, 1.0) if name in parameters else None


def _clamp(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)
