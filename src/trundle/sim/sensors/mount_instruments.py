"""Creation of a running world's sensors other than cameras."""

import math
from collections.abc import Callable, Mapping
from typing import TypeAlias

from msgspec import Struct

from trundle.robots.model import Model, RangeScan, World
from trundle.sim.simulation import Simulation

from .air import AirPressureSensor, AirSpeedSensor
from .altimeter import AltimeterSensor
from .contact import ContactSensor
from .force_torque import ForceTorqueSensor
from .gps import GpsSensor
from .imu import ImuSensor
from .imu_reference import reference_from_world
from .live_sensor import SensorMount
from .logical_camera import LogicalCameraSensor
from .magnetometer import MagnetometerSensor
from .range import RangeSensor
from .ray_scene import RayScene
from .sonar import SonarSensor
from .wireless import RfidSensor, WirelessSensor

InstrumentSensor: TypeAlias = (
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


class _MountContext(Struct, frozen=True, eq=False):
    """Simulation and mount of a sensor to be created."""

    simulation: Simulation
    ray_scene: RayScene
    mount: SensorMount

    @property
    def world(self) -> World:
        """World that is simulated."""
        return self.simulation.world


def mount_instruments(
    simulation: Simulation, *, model: str | None, ray_scene: RayScene | None
) -> list[InstrumentSensor]:
    """Create the sensors of `mount_sensors`, with the same arguments."""
    mounted: list[InstrumentSensor] = []
    ray_scene = ray_scene or RayScene(simulation)
    index = number = 0
    for owner in simulation.world.models:
        wanted = model in (None, owner.name)
        for link in owner.links:
            for sensor in link.sensors:
                number += 1
                make = MAKERS.get(sensor.type)
                if sensor.type == "force_torque" and wanted:
                    what = f"sensor {sensor.name!r}: force_torque sensors measure joints; not simulated on a link"
                    simulation.report.warn(sensor.at, what)
                if make is not None and wanted:
                    mount = SensorMount(owner, link, sensor, index, (simulation.seed, number))
                    made = make(_MountContext(simulation, ray_scene, mount))
                    made.attach_to(simulation[owner.name].link(link.name))
                    mounted.append(made)
            index += 1
        if wanted:
            mounted += _on_joints(simulation, owner, first=index - len(owner.links))
    return mounted


def _on_joints(simulation: Simulation, model: Model, *, first: int) -> list[InstrumentSensor]:
    """Create the force-torque sensors of a model's joints; `first` is its first link's index."""
    indices = {link.name: first + i for i, link in enumerate(model.links)}
    mounted: list[InstrumentSensor] = []
    for number, joint in enumerate(model.joints):
        for sensor in joint.sensors:
            if sensor.force_torque is None or joint.child not in indices:
                what = f"sensor {sensor.name!r}: {sensor.type} sensors on joints are not simulated yet"
                simulation.report.warn(sensor.at, what)
                continue
            robot = simulation[model.name]
            handle = robot.joint(joint.name)
            made = ForceTorqueSensor(
                SensorMount(
                    model, model.link(joint.child), sensor, indices[joint.child], (simulation.seed, first, number)
                ),
                joint=joint,
                parent=robot.link(joint.parent) if joint.parent in indices else None,
                reaction=lambda handle=handle: handle.reaction,
            )
            made.attach_to(robot.link(joint.child))
            mounted.append(made)
    return mounted


def _air_speed(at: _MountContext) -> AirSpeedSensor:
    made = AirSpeedSensor(at.mount, air=at.world.atmosphere)
    made.wind = at.world.wind
    return made


def _imu(at: _MountContext) -> ImuSensor:
    settings = at.mount.sensor.imu
    reference = reference_from_world(
        None if settings is None else settings.reference,
        at_start=at.mount.initial_pose(),
        gravity=at.world.physics.gravity,
        heading_rad=math.radians(at.world.spherical_coordinates.heading_deg),
    )
    return ImuSensor(at.mount, gravity=at.world.physics.gravity, reference_from_world=reference)


def _range(at: _MountContext) -> RangeSensor:
    sensor = at.mount.sensor
    scan = sensor.scan or RangeScan()
    lit = at.ray_scene.visual_rays(scan.min_m, scan.visibility_mask)
    rays = lit if sensor.type.startswith("gpu_") else at.ray_scene.rays
    return RangeSensor(at.mount, rays=rays)


def _wireless_receiver(at: _MountContext) -> WirelessSensor:
    around = at.ray_scene
    return WirelessSensor(at.mount, transmitters=lambda: around.transmitters("wireless_transmitter"), rays=around.rays)


def _contact(at: _MountContext) -> ContactSensor:
    sensor, link = at.mount.sensor, at.mount.link
    there = [collision.name for collision in link.collisions]
    for name in sensor.contact_collisions or ():
        if name not in there:
            what = f"no collision {name!r} on link {link.name!r}; collisions here: {', '.join(there) or 'none'}"
            at.simulation.report.warn(sensor.at, f"sensor {sensor.name!r}: {what}")
    return ContactSensor(at.mount)


def _gps(at: _MountContext) -> GpsSensor:
    return GpsSensor(at.mount, origin=at.world.spherical_coordinates)


MAKERS: Mapping[str, Callable[[_MountContext], InstrumentSensor]] = {
    "air_pressure": lambda at: AirPressureSensor(at.mount, air=at.world.atmosphere),
    "air_speed": _air_speed,
    "altimeter": lambda at: AltimeterSensor(at.mount, start_height=at.mount.initial_pose().position[2]),
    "contact": _contact,
    "gps": _gps,
    "gpu_lidar": _range,
    "gpu_ray": _range,
    "imu": _imu,
    "lidar": _range,
    "logical_camera": lambda at: LogicalCameraSensor(at.mount, bodies=lambda: at.ray_scene.models),
    "magnetometer": lambda at: MagnetometerSensor(at.mount, world_field=at.world.magnetic_field),
    "navsat": _gps,
    "ray": _range,
    "rfid": lambda at: RfidSensor(at.mount, tags=lambda: at.ray_scene.transmitters("rfidtag")),
    "sonar": lambda at: SonarSensor(at.mount, rays=at.ray_scene.rays_excluding(at.mount.model, at.mount.link)),
    "wireless_receiver": _wireless_receiver,
}
