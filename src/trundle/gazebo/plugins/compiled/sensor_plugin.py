"""Compiled plugins of sensors: they get the readings that the simulation measures."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.robots.model import PluginTag
from trundle.ros import Node
from trundle.sim.sensors import (
    CameraReading,
    CameraSensor,
    ContactReading,
    ForceTorqueReading,
    GpsReading,
    ImuReading,
    InstrumentSensor,
    RangeReading,
    SonarReading,
)
from trundle.sim.simulation import Simulation

from .plugin_world import CompiledPlugins

_Contact = tuple[str, str, Sequence[float]]


def attach_compiled_plugin(
    library: Path, tag: PluginTag, sensor: InstrumentSensor | CameraSensor, node: Node, sim: Simulation
) -> None:
    """Load a sensor's plugin from a library; the sensor is read while the plugin has connected to its updates.

    Raises:
        DescriptionError: it cannot be loaded, or its Load threw an exception.
    """
    plugins = CompiledPlugins.of(sim)
    number = plugins.load(library, tag, sensor.scoped_name, node)

    def give(reading: Any) -> None:
        image = depths = None
        if isinstance(reading, CameraReading):
            image = np.ascontiguousarray(reading.rgb)
            depths = None if reading.depth is None else np.ascontiguousarray(reading.depth)
        plugins.give_reading(number, reading.time_ns, _values(reading), image, depths, _contacts(reading))

    sensor.listen(give, enabled=lambda: plugins.wants_reading(number))


def _values(reading: object) -> NDArray[np.float64]:
    """Return the numbers of a reading, in the order of `trundle_host.h`."""
    match reading:
        case RangeReading():
            parts = (reading.ranges.ravel(), reading.intensities.ravel())
            return np.concatenate(parts, dtype=np.float64)
        case ImuReading():
            values = (*reading.orientation, *reading.angular_velocity, *reading.linear_acceleration)
        case GpsReading():
            values = (math.radians(reading.latitude_deg), math.radians(reading.longitude_deg), reading.altitude)
        case SonarReading():
            values = (reading.range_m,)
        case ForceTorqueReading():
            values = (*reading.wrench.force, *reading.wrench.torque)
        case CameraReading() | ContactReading():
            values = ()
        case _:
            raise UsageError(f"the kit's sensors have no readings of {type(reading).__name__}")
    return np.array(values, dtype=np.float64)


def _contacts(reading: object) -> list[_Contact]:
    """Return the contacts of the last step of a reading."""
    if not isinstance(reading, ContactReading):
        return []
    last_ns = max((record.time_ns for record in reading.contacts), default=0)
    return [
        (
            record.collision,
            record.other,
            (*record.position, *record.normal, *record.wrench.force, record.depth),
        )
        for record in reading.contacts
        if record.time_ns == last_ns and last_ns >= reading.time_ns
    ]
