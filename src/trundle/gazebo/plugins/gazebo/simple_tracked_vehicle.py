"""libSimpleTrackedVehiclePlugin.so: tracks as moving surfaces, without wheels."""

from typing import Self

from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.physics import TrackMotion
from trundle.sim.simulation import ModelHandle, Simulation
from trundle.spatial import Vector3

from ..plugin import Plugin
from .tracked_vehicle import Tracks

_MIN_SPEED = 0.1
"""Speed [m/s] and rate [rad/s] below which Gazebo assumes a turn on the spot, or straight motion."""


class SimpleTrackedVehicle(Plugin):
    """Drives a robot whose tracks are links of any convex shape.

    Parameters: <body>, <left_track>, <right_track> (required), any number of <left_flipper> and <right_flipper>: links;
    and those of `Tracks`. At each contact the surface moves along the body's x; mu acts across the direction to the
    robot's centre of rotation, mu2 along it, as in Gazebo.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> None:
        self._tracks = Tracks(sim, model, node, tag)
        parameters = TagParameters(tag.node, sim.report)
        self._body = model.link(parameters.text("body"))
        sides = (("left_track", "left_flipper"), ("right_track", "right_flipper"))
        links = [
            [model.link(name) for name in (parameters.text(track), *parameters.texts(flipper))]
            for track, flipper in sides
        ]
        parameters.ignore("collide_without_contact_bitmask")
        parameters.report_unread()
        self._tracks.set_friction(sim, [*links[0], *links[1]])
        self._links = links

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        return cls(sim, model, node, tag)

    def before_step(self, sim: Simulation) -> None:
        """Set the tracks' surface speeds."""
        del sim
        speeds, left = self._tracks.speeds, self._body.pose.transform_vector((0.0, 1.0, 0.0))
        centre = self._centre(speeds, left)
        for links, speed in zip(self._links, speeds, strict=True):
            for link in links:
                link.set_surface_motion(TrackMotion(axis=left, speed=speed, centre=centre))

    def reset(self) -> None:
        """Stop."""
        self._tracks.command.stop()

    def _centre(self, speeds: tuple[float, float], left: Vector3) -> Vector3 | None:
        """Centre of rotation in the world [m]; None: straight motion."""
        left_speed, right_speed = speeds
        yaw_rate = (left_speed - right_speed) * self._tracks.efficiency / self._tracks.separation
        speed = (left_speed + right_speed) / 2
        if abs(yaw_rate) < _MIN_SPEED:
            return None
        offset = 0.0 if abs(speed) < _MIN_SPEED else -speed / yaw_rate
        x, y, z = (p + offset * y for p, y in zip(self._body.pose.position, left, strict=True))
        return (x, y, z)
