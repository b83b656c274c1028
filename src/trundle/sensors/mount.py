"""Mounts the sensors of a world."""

from collections.abc import Callable

from trundle.diagnostics import Diagnostics
from trundle.model import CameraOptics, Sensor, World
from trundle.render import Renderer

from .camera import CameraSensor
from .mount_measuring import MEASURING

_RGB = ("R8G8B8", "RGB_INT8")
SIMULATED = frozenset({"camera"}) | MEASURING
"""SDF's sensor types that measure."""


def mount_cameras(world: World, renderer: Callable[[], Renderer], report: Diagnostics) -> list[CameraSensor]:
    """Every camera of a world, in file order; sensors of other types are named.

    Args:
        world: with its sensors.
        renderer: makes the one renderer all cameras share; called only if there is a camera.
        report: takes what is not simulated.
    """
    cameras: list[CameraSensor] = []
    shared: Renderer | None = None
    index = 0
    for model in world.models:
        for link in model.links:
            for sensor in link.sensors:
                if sensor.type in MEASURING:
                    continue
                if sensor.camera is None:
                    report.warn(sensor.at, f"sensor {sensor.name!r}: {sensor.type} sensors are not simulated yet")
                    continue
                _name_unsupported(sensor, sensor.camera, report)
                shared = shared or renderer()
                cameras.append(CameraSensor(model, link, sensor, link_index=index, renderer=shared))
            index += 1
    return cameras


def _name_unsupported(sensor: Sensor, optics: CameraOptics, report: Diagnostics) -> None:
    who = f"sensor {sensor.name!r}"
    if optics.format not in _RGB:
        report.warn(sensor.at, f"{who}: image format {optics.format} is not made yet; R8G8B8 is")
    if sensor.topic:
        report.warn(sensor.at, f"{who}: <topic> is not heeded yet; its topics are <model>/<link>/<sensor>/…")
    for plugin in sensor.plugins:
        report.warn(plugin.at, f"{who}: plugin {plugin.filename} is not supported yet; the sensor has topics without")
