"""Sensors that need no picture: SDF's types of them, and the way to those of a world.

A world without any starts without their modules.
"""

from typing import TYPE_CHECKING

from trundle.model import MEASURING, Model
from trundle.simulation import Simulation

if TYPE_CHECKING:
    from .mount_instruments import InstrumentSensor
    from .ray_scene import RayScene


def mount_sensors(
    simulation: Simulation, *, model: str | None = None, ray_scene: "RayScene | None" = None
) -> "list[InstrumentSensor]":
    """Every sensor that needs no picture, in file order; each has random numbers of its own.

    Args:
        simulation: with its sensors; its seed is that of the noise.
        model: of this one alone.
        ray_scene: what sensors that are there already share.
    """
    if not any(map(_has_instruments, simulation.world.models)):
        return []
    from .mount_instruments import mount_instruments

    return mount_instruments(simulation, model=model, ray_scene=ray_scene)


def _has_instruments(model: Model) -> bool:
    on_links = (sensor.type in MEASURING for link in model.links for sensor in link.sensors)
    return any(on_links) or any(joint.sensors for joint in model.joints)
