"""Mounts the sensors of a running world that need no picture."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from trundle.model import Link, Model, Sensor
from trundle.simulation import Simulation

from .contact import ContactSensor
from .force_torque import ForceTorqueSensor
from .gps import GpsSensor
from .imu import ImuSensor
from .range import RangeSensor

MeasuringSensor: TypeAlias = ContactSensor | ForceTorqueSensor | GpsSensor | ImuSensor | RangeSensor


def mount_sensors(simulation: Simulation) -> list[MeasuringSensor]:
    """Every imu, ray sensor, lidar, gps and contact sensor, in file order; each has random numbers of its own."""
    mounted: list[MeasuringSensor] = []
    index = number = 0
    for model in simulation.world.models:
        for link in model.links:
            for sensor in link.sensors:
                number += 1
                make = _MAKERS.get(sensor.type)
                if make is not None:
                    random = np.random.default_rng([simulation.seed, number])
                    mounted.append(make(simulation, model, link, sensor, index, random))
            index += 1
        mounted += _on_joints(simulation, model, first=index - len(model.links))
    return mounted


def _on_joints(simulation: Simulation, model: Model, *, first: int) -> list[MeasuringSensor]:
    """The force-torque sensors of a model's joints; `first` is its first link's index."""
    indices = {link.name: first + i for i, link in enumerate(model.links)}
    mounted: list[MeasuringSensor] = []
    for joint in model.joints:
        for sensor in joint.sensors:
            if sensor.force_torque is None or joint.child not in indices:
                what = f"sensor {sensor.name!r}: {sensor.type} sensors on joints are not simulated yet"
                simulation.report.warn(sensor.at, what)
                continue
            handle = simulation[model.name].joint(joint.name)
            mounted.append(
                ForceTorqueSensor(
                    model,
                    model.link(joint.child),
                    sensor,
                    joint=joint,
                    link_index=indices[joint.child],
                    parent_index=indices.get(joint.parent),
                    reaction=lambda handle=handle: handle.reaction,
                )
            )
    return mounted


_Maker: TypeAlias = Callable[[Simulation, Model, Link, Sensor, int, np.random.Generator], MeasuringSensor]


def _imu(
    simulation: Simulation, model: Model, link: Link, sensor: Sensor, index: int, random: np.random.Generator
) -> ImuSensor:
    gravity = simulation.world.physics.gravity
    return ImuSensor(model, link, sensor, link_index=index, gravity=gravity, random=random)


def _range(
    simulation: Simulation, model: Model, link: Link, sensor: Sensor, index: int, random: np.random.Generator
) -> RangeSensor:
    # The engine is another after models came or went: it is asked for at each scan.
    return RangeSensor(
        model,
        link,
        sensor,
        link_index=index,
        distances=lambda origin, directions, reach, exclude: simulation.engine.reader.distances(
            origin, directions, reach=reach, exclude=exclude
        ),
        random=random,
    )


def _gps(
    simulation: Simulation, model: Model, link: Link, sensor: Sensor, index: int, random: np.random.Generator
) -> GpsSensor:
    origin = simulation.world.spherical_coordinates
    return GpsSensor(model, link, sensor, link_index=index, origin=origin, random=random)


def _contact(
    simulation: Simulation, model: Model, link: Link, sensor: Sensor, index: int, random: np.random.Generator
) -> ContactSensor:
    del random
    return ContactSensor(model, link, sensor, link_index=index, contacts=simulation.contacts)


_MAKERS: dict[str, _Maker] = {
    "imu": _imu,
    "ray": _range,
    "gpu_ray": _range,
    "lidar": _range,
    "gpu_lidar": _range,
    "gps": _gps,
    "navsat": _gps,
    "contact": _contact,
}
MEASURING = frozenset(_MAKERS) | {"force_torque"}
"""SDF's types of them."""
