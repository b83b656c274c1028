"""libBuoyancyPlugin.so: buoyancy of a submerged model."""

import math
from dataclasses import dataclass
from typing import Self

from trundle.robots.model import Box, Capsule, Collision, Cone, Cylinder, Ellipsoid, Geometry, Link, PluginTag, Sphere
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation
from trundle.spatial import ZERO, Vector3, Wrench

from ..plugin import Plugin
from .bounding_box import bounding_box

_WATER_DENSITY = 999.1026
"""Gazebo's default density [kg/m³]."""


@dataclass(frozen=True, slots=True)
class _Volume:
    link: LinkHandle
    volume: float
    """Volume [m³]."""
    centre: Vector3
    """Centre of volume in the link's frame [m]."""


class Buoyancy(Plugin):
    """Applies −ρ·V·g to every link at its centre of volume.

    Parameters: <fluid_density> [kg/m³] (999.1026) and for any <link name="…"> its <center_of_volume> [m] and <volume>
    [m³]; other links' come from their collisions. There is no water surface and no drag, as in Gazebo.
    """

    def __init__(self, volumes: list[_Volume], density: float) -> None:
        self._volumes = volumes
        self._density = density

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        del node
        parameters = TagParameters(tag.node, sim.report)
        density = parameters.number("fluid_density", _WATER_DENSITY)
        declared: dict[str, _Volume] = {}
        for child in parameters.sections("link"):
            link = model.link(child.attribute("name"))
            volume = child.number("volume", 0.0)
            centre = child.vector("center_of_volume", ZERO)
            child.report_unread()
            if volume <= 0.0:
                child.warn(f"link {link.name!r}: a volume of {volume:g} m³ has no buoyancy; it is left out")
            declared[link.name] = _Volume(link, max(volume, 0.0), centre)
        parameters.report_unread()
        volumes = [declared.get(link.name) or _Volume(link, *_collision_volume(link.link)) for link in model.links]
        return cls([volume for volume in volumes if volume.volume > 0.0], density)

    def before_step(self, sim: Simulation) -> None:
        """Apply the buoyancy."""
        gx, gy, gz = sim.world.physics.gravity
        for volume in self._volumes:
            mass = self._density * volume.volume
            lift = Wrench(force=(-mass * gx, -mass * gy, -mass * gz))
            volume.link.add_wrench(lift, at=volume.link.pose.transform_point(volume.centre))


def _collision_volume(link: Link) -> tuple[float, Vector3]:
    """Volume of all collisions [m³], overlaps counted twice as in Gazebo, and its centre in the link's frame [m]."""
    parts = [(_volume(collision), collision.link_from_collision.position) for collision in link.collisions]
    total = sum(volume for volume, _ in parts)
    if total <= 0.0:
        return 0.0, ZERO
    x, y, z = (sum(volume * centre[axis] for volume, centre in parts) / total for axis in range(3))
    return total, (x, y, z)


def _volume(collision: Collision) -> float:
    geometry: Geometry = collision.geometry
    match geometry:
        case Box((x, y, z)):
            return x * y * z
        case Cylinder(radius, length):
            return math.pi * radius**2 * length
        case Cone(radius, length):
            return math.pi * radius**2 * length / 3
        case Capsule(radius, length):
            return math.pi * radius**2 * (length + 4 / 3 * radius)
        case Sphere(radius):
            return 4 / 3 * math.pi * radius**3
        case Ellipsoid((a, b, c)):
            return 4 / 3 * math.pi * a * b * c
        case _:  # Gazebo uses a mesh's bounding box
            x, y, z = bounding_box(Link(name="", at=collision.at, collisions=(collision,)))
            return x * y * z
