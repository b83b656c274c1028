"""Compiled plugins of sensors: they get the readings that the simulation measures."""

import math
from collections.abc import Sequence
from functools import partial
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
    LogicalCameraReading,
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

    Args:
        library: the library.
        tag: the plugin's element.
        sensor: the sensor; of a multicamera any camera.
        node: a node of the graph.
        sim: the simulation.

    Raises:
        DescriptionError: it cannot be loaded, or its Load threw an exception.
    """
    plugins = CompiledPlugins.of(sim)
    name = sensor.scoped_name
    if isinstance(sensor, CameraSensor) and sensor.optics.name:
        name = name.removesuffix(f"/{sensor.optics.name}")
    elif isinstance(sensor, CameraSensor):
        plugins.cameras[name] = sensor
    number = plugins.load(library, tag, name, node)

    def give(reading: Any, camera: NDArray[np.float64] | None = None) -> None:
        image = depths = None
        if isinstance(reading, CameraReading):
            image = np.ascontiguousarray(reading.rgb)
            depths = None if reading.depth is None else np.ascontiguousarray(reading.depth)
        values = _values(reading) if camera is None else camera
        plugins.give_reading(number, reading.time_ns, values, image, depths, _contacts(reading))

    def is_wanted() -> bool:
        return plugins.wants_reading(number)

    if isinstance(sensor, CameraSensor) and sensor.optics.name:
        for index, camera in enumerate(sensor.multicamera):
            camera.listen(partial(give, camera=np.array([float(index)])), enabled=is_wanted)
    else:
        sensor.listen(give, enabled=is_wanted)


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
        case LogicalCameraReading():
            poses = [model.camera_from_model for model in reading.models]
            values = tuple(number for pose in poses for number in (*pose.position, *pose.quaternion))
        case CameraReading() | ContactReading():
            values = ()
        case _:
            raise UsageError(f"the kit's sensors have no readings of {type(reading).__name__}")
    return np.array(values, dtype=np.float64)


def _contacts(reading: object) -> list[_Contact]:
    """Return the contacts of the last step of a reading, or the names of the models in view."""
    if isinstance(reading, LogicalCameraReading):
        return [(model.name, "", (0.0,) * 10) for model in reading.models]
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
