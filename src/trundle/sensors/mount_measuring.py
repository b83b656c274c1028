"""Mounts the sensors of a running world that need no picture."""

import numpy as np

from trundle.simulation import Simulation

from .imu import ImuSensor
from .range import RangeSensor

MEASURING = frozenset({"imu", "ray", "gpu_ray", "lidar", "gpu_lidar"})
"""SDF's types of them."""


def mount_sensors(simulation: Simulation) -> list[ImuSensor | RangeSensor]:
    """Every imu, ray sensor and lidar, in file order; each has a stream of random numbers of its own."""
    mounted: list[ImuSensor | RangeSensor] = []
    index = number = 0
    for model in simulation.world.models:
        for link in model.links:
            for sensor in link.sensors:
                number += 1
                random = np.random.default_rng([simulation.seed, number])
                if sensor.imu is not None:
                    gravity = simulation.world.physics.gravity
                    mounted.append(ImuSensor(model, link, sensor, link_index=index, gravity=gravity, random=random))
                elif sensor.scan is not None:
                    mounted.append(
                        RangeSensor(
                            model,
                            link,
                            sensor,
                            link_index=index,
                            distances=lambda origin, directions, reach, exclude: simulation.engine.reader.distances(
                                origin, directions, reach=reach, exclude=exclude
                            ),
                            random=random,
                        )
                    )
            index += 1
    return mounted
