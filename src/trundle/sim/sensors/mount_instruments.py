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
        """Simulated world."""
        return self.simulation.world


def mount_instruments(
    simulation: Simulation, *, model: str | None, ray_scene: RayScene | None
) -> list[InstrumentSensor]:
    """Create the sensors of `mount_sensors`, with the same arguments."""
    mounted: list[InstrumentSensor] = []
    ray_scene = ray_scene or RayScene(simulation)
    index = number = 0
    for owner in simulation.world.models:
        is_selected = model in (None, owner.name)
        for link in owner.links:
            for sensor in link.sensors:
                number += 1
                create = MAKERS.get(sensor.type)
                if sensor.type == "force_torque" and is_selected:
                    problem = f"sensor {sensor.name!r}: force_torque sensors measure joints; not simulated on a link"
                    simulation.report.warn(sensor.at, problem, "unsupported-sensor")
                if create is not None and is_selected:
                    mount = SensorMount(owner, link, sensor, index, (simulation.seed, number))
                    instrument = create(_MountContext(simulation, ray_scene, mount))
                    instrument.attach_to(simulation[owner.name].link(link.name))
                    mounted.append(instrument)
            index += 1
        if is_selected:
            mounted += _on_joints(simulation, owner, first=index - len(owner.links))
    return mounted


def _on_joints(simulation: Simulation, model: Model, *, first: int) -> list[InstrumentSensor]:
    """Create the force-torque sensors of a model's joints; `first` is its first link's index."""
    indices = {link.name: first + i for i, link in enumerate(model.links)}
    mounted: list[InstrumentSensor] = []
    for number, joint in enumerate(model.joints):
        for sensor in joint.sensors:
            if sensor.force_torque is None or joint.child not in indices:
                problem = f"sensor {sensor.name!r}: {sensor.type} sensors on joints are not simulated yet"
                simulation.report.warn(sensor.at, problem, "unsupported-sensor")
                continue
            robot = simulation[model.name]
            handle = robot.joint(joint.name)
            instrument = ForceTorqueSensor(
                SensorMount(
                    model, model.link(joint.child), sensor, indices[joint.child], (simulation.seed, first, number)
                ),
                joint=joint,
                parent=robot.link(joint.parent) if joint.parent in indices else None,
                reaction=lambda handle=handle: handle.reaction,
            )
            instrument.attach_to(robot.link(joint.child))
            mounted.append(instrument)
    return mounted


def _air_speed(context: _MountContext) -> AirSpeedSensor:
    sensor = AirSpeedSensor(context.mount, air=context.world.atmosphere)
    sensor.wind = context.world.wind
    return sensor


def _imu(context: _MountContext) -> ImuSensor:
    settings = context.mount.sensor.imu
    reference = reference_from_world(
        None if settings is None else settings.reference,
        at_start=context.mount.initial_pose(),
        gravity=context.world.physics.gravity,
        heading_rad=math.radians(context.world.spherical_coordinates.heading_deg),
    )
    return ImuSensor(context.mount, gravity=context.world.physics.gravity, reference_from_world=reference)


def _range(context: _MountContext) -> RangeSensor:
    sensor = context.mount.sensor
    scan = sensor.scan or RangeScan()
    visual_rays = context.ray_scene.visual_rays(scan.min_m, scan.visibility_mask)
    rays = visual_rays if sensor.type.startswith("gpu_") else context.ray_scene.rays
    return RangeSensor(context.mount, rays=rays)


def _wireless_receiver(context: _MountContext) -> WirelessSensor:
    scene = context.ray_scene
    return WirelessSensor(
        context.mount, transmitters=lambda: scene.transmitters("wireless_transmitter"), rays=scene.rays
    )


def _contact(context: _MountContext) -> ContactSensor:
    sensor, link = context.mount.sensor, context.mount.link
    names = [collision.name for collision in link.collisions]
    for name in sensor.contact_collisions or ():
        if name not in names:
            problem = f"no collision {name!r} on link {link.name!r}; collisions here: {', '.join(names) or 'none'}"
            context.simulation.report.warn(sensor.at, f"sensor {sensor.name!r}: {problem}", "missing-collision")
    return ContactSensor(context.mount)


def _gps(context: _MountContext) -> GpsSensor:
    return GpsSensor(context.mount, origin=context.world.spherical_coordinates)


MAKERS: Mapping[str, Callable[[_MountContext], InstrumentSensor]] = {
    "air_pressure": lambda context: AirPressureSensor(context.mount, air=context.world.atmosphere),
    "air_speed": _air_speed,
    "altimeter": lambda context: AltimeterSensor(context.mount, start_height=context.mount.initial_pose().position[2]),
    "contact": _contact,
    "gps": _gps,
    "gpu_lidar": _range,
    "gpu_ray": _range,
    "imu": _imu,
    "lidar": _range,
    "logical_camera": lambda context: LogicalCameraSensor(context.mount, bodies=lambda: context.ray_scene.models),
    "magnetometer": lambda context: MagnetometerSensor(context.mount, world_field=context.world.magnetic_field),
    "navsat": _gps,
    "ray": _range,
    "rfid": lambda context: RfidSensor(context.mount, tags=lambda: context.ray_scene.transmitters("rfidtag")),
    "sonar": lambda context: SonarSensor(
        context.mount, rays=context.ray_scene.rays_excluding(context.mount.model, context.mount.link)
    ),
    "wireless_receiver": _wireless_receiver,
}
