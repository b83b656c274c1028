"""Sensors other than cameras: their SDF types and their creation.

A world without such sensors does not import their modules.
"""

from typing import TYPE_CHECKING

from trundle.robots.model import MEASURING, Model
from trundle.sim.simulation import Simulation

if TYPE_CHECKING:
    from .mount_instruments import InstrumentSensor
    from .ray_scene import RayScene


def mount_sensors(
    simulation: Simulation, *, model: str | None = None, ray_scene: "RayScene | None" = None
) -> "list[InstrumentSensor]":
    """Create every sensor other than cameras, in file order, each with its own random numbers.

    Args:
        simulation: simulation with the sensors; its seed is the noise's.
        model: model whose sensors are created; None: all models.
        ray_scene: scene shared with existing sensors.
    """
    if not any(map(has_instruments, simulation.world.models)):
        return []
    from .mount_instruments import mount_instruments

    return mount_instruments(simulation, model=model, ray_scene=ray_scene)


def has_instruments(model: Model) -> bool:
    on_links = (sensor.type in MEASURING for link in model.links for sensor in link.sensors)
    return any(on_links) or any(joint.sensors for joint in model.joints)
