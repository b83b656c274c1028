"""Mounts the sensors of a running world that need no picture."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from trundle.model import Link, Model, RangeScan, Sensor
from trundle.simulation import Simulation
from trundle.spatial import Pose

from .air import AirPressureSensor, AirSpeedSensor
from .altimeter import AltimeterSensor
from .contact import ContactSensor
from .force_torque import ForceTorqueSensor
from .gps import GpsSensor
from .imu import ImuSensor
from .logical_camera import LogicalCameraSensor
from .magnetometer import MagnetometerSensor
from .orientation import reference_from_world
from .range import RangeSensor
from .sonar import SonarSensor
from .surroundings import Surroundings
from .wireless import RfidSensor, WirelessSensor

MeasuringSensor: TypeAlias = (
    AirPressureSensor
    | AirSpeedSensor
    | AltimeterSensor
    | ContactSensor
    | ForceTorqueSensor
    | GpsSensor
    | ImuSensor
    | LogicalCameraSensor
    | MagnetometerSensor
    | RangeSensor
    | RfidSensor
    | SonarSensor
    | WirelessSensor
)


@dataclass(frozen=True, slots=True, eq=False)
class _Spot:
    """Where a sensor is to be mounted."""

    simulation: Simulation
    around: Surroundings
    model: Model
    link: Link
    sensor: Sensor
    index: int
    """Of the link."""
    random: np.random.Generator

    def start(self) -> Pose:
        """Where the sensor was when its model came."""
        return self.model.world_from_model @ self.link.model_from_link @ self.sensor.link_from_sensor


def mount_sensors(
    simulation: Simulation, *, model: str | None = None, around: Surroundings | None = None
) -> list[MeasuringSensor]:
    """Every sensor that needs no picture, in file order; each has random numbers of its own.

    Args:
        simulation: with its sensors; its seed is that of the noise.
        model: of this one alone.
        around: what sensors that are there already share.
    """
    mounted: list[MeasuringSensor] = []
    around = around or Surroundings(simulation)
    index = number = 0
    for owner in simulation.world.models:
        wanted = model in (None, owner.name)
        for link in owner.links:
            for sensor in link.sensors:
                number += 1
                make = _MAKERS.get(sensor.type)
                if make is not None and wanted:
                    random = np.random.default_rng([simulation.seed, number])
                    made = make(_Spot(simulation, around, owner, link, sensor, index, random))
                    made.follow(simulation[owner.name].link(link.name))
                    mounted.append(made)
            index += 1
        if wanted:
            mounted += _on_joints(simulation, owner, first=index - len(owner.links))
    return mounted


def _on_joints(simulation: Simulation, model: Model, *, first: int) -> list[MeasuringSensor]:
    """The force-torque sensors of a model's joints; `first` is its first link's index."""
    indices = {link.name: first + i for i, link in enumerate(model.links)}
    mounted: list[MeasuringSensor] = []
    for number, joint in enumerate(model.joints):
        for sensor in joint.sensors:
            if sensor.force_torque is None or joint.child not in indices:
                what = f"sensor {sensor.name!r}: {sensor.type} sensors on joints are not simulated yet"
                simulation.report.warn(sensor.at, what)
                continue
            robot = simulation[model.name]
            handle = robot.joint(joint.name)
            made = ForceTorqueSensor(
                model,
                model.link(joint.child),
                sensor,
                joint=joint,
                link_index=indices[joint.child],
                parent=robot.link(joint.parent) if joint.parent in indices else None,
                reaction=lambda handle=handle: handle.reaction,
                random=np.random.default_rng([simulation.seed, first, number]),
            )
            made.follow(robot.link(joint.child))
            mounted.append(made)
    return mounted


def _air_pressure(at: _Spot) -> AirPressureSensor:
    air = at.simulation.world.atmosphere
    return AirPressureSensor(at.model, at.link, at.sensor, link_index=at.index, air=air, random=at.random)


def _air_speed(at: _Spot) -> AirSpeedSensor:
    world = at.simulation.world
    made = AirSpeedSensor(at.model, at.link, at.sensor, link_index=at.index, air=world.atmosphere, random=at.random)
    made.wind = world.wind
    return made


def _altimeter(at: _Spot) -> AltimeterSensor:
    height = at.start().position[2]
    return AltimeterSensor(at.model, at.link, at.sensor, link_index=at.index, start_height=height, random=at.random)


def _contact(at: _Spot) -> ContactSensor:
    return ContactSensor(at.model, at.link, at.sensor, link_index=at.index, contacts=at.simulation.contacts)


def _gps(at: _Spot) -> GpsSensor:
    origin = at.simulation.world.spherical_coordinates
    return GpsSensor(at.model, at.link, at.sensor, link_index=at.index, origin=origin, random=at.random)


def _imu(at: _Spot) -> ImuSensor:
    world = at.simulation.world
    reference = None if at.sensor.imu is None else at.sensor.imu.reference
    told_from_world = reference_from_world(
        reference,
        at_start=at.start(),
        gravity=world.physics.gravity,
        heading_rad=math.radians(world.spherical_coordinates.heading_deg),
    )
    return ImuSensor(
        at.model,
        at.link,
        at.sensor,
        link_index=at.index,
        gravity=world.physics.gravity,
        reference_from_world=told_from_world,
        random=at.random,
    )


def _logical_camera(at: _Spot) -> LogicalCameraSensor:
    return LogicalCameraSensor(at.model, at.link, at.sensor, link_index=at.index, bodies=lambda: at.around.bodies)


def _magnetometer(at: _Spot) -> MagnetometerSensor:
    field = at.simulation.world.magnetic_field
    return MagnetometerSensor(at.model, at.link, at.sensor, link_index=at.index, world_field=field, random=at.random)


def _range(at: _Spot) -> RangeSensor:
    scan = at.sensor.scan or RangeScan()
    rays = at.around.light_rays(scan.min_m) if at.sensor.type.startswith("gpu_") else at.around.rays
    return RangeSensor(at.model, at.link, at.sensor, link_index=at.index, rays=rays, random=at.random)


def _rfid(at: _Spot) -> RfidSensor:
    return RfidSensor(at.model, at.link, at.sensor, link_index=at.index, tags=lambda: at.around.beacons("rfidtag"))


def _sonar(at: _Spot) -> SonarSensor:
    rays = at.around.foreign_rays(at.model, at.link)
    return SonarSensor(at.model, at.link, at.sensor, link_index=at.index, rays=rays)


def _wireless_receiver(at: _Spot) -> WirelessSensor:
    return WirelessSensor(
        at.model,
        at.link,
        at.sensor,
        link_index=at.index,
        transmitters=lambda: at.around.beacons("wireless_transmitter"),
        rays=at.around.rays,
        random=at.random,
    )


_MAKERS: Mapping[str, Callable[[_Spot], MeasuringSensor]] = {
    "air_pressure": _air_pressure,
    "air_speed": _air_speed,
    "altimeter": _altimeter,
    "contact": _contact,
    "gps": _gps,
    "gpu_lidar": _range,
    "gpu_ray": _range,
    "imu": _imu,
    "lidar": _range,
    "logical_camera": _logical_camera,
    "magnetometer": _magnetometer,
    "navsat": _gps,
    "ray": _range,
    "rfid": _rfid,
    "sonar": _sonar,
    "wireless_receiver": _wireless_receiver,
}
MEASURING = frozenset(_MAKERS) | {"force_torque", "rfidtag", "wireless_transmitter"}
"""SDF's types of them; tags and transmitters are measured by others."""
