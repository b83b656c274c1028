"""Mounts the cameras of a world."""

from collections.abc import Callable, Mapping

from trundle.diagnostics import Diagnostics
from trundle.model import Distortion, Noise, Sensor, World
from trundle.render import Renderer, Scene

from .bounding_box_camera import BoundingBoxCameraSensor
from .camera import CameraSensor
from .depth_camera import DepthCameraSensor
from .mount_measuring import MEASURING
from .scenery import Scenery
from .segmentation_camera import SegmentationCameraSensor
from .thermal_camera import ThermalCameraSensor

_RGB = ("R8G8B8", "RGB_INT8")
_KINDS: Mapping[str, type[CameraSensor]] = {
    "boundingbox": BoundingBoxCameraSensor,
    "boundingbox_camera": BoundingBoxCameraSensor,
    "camera": CameraSensor,
    "depth": DepthCameraSensor,
    "depth_camera": DepthCameraSensor,
    "multicamera": CameraSensor,
    "rgbd": DepthCameraSensor,
    "rgbd_camera": DepthCameraSensor,
    "segmentation": SegmentationCameraSensor,
    "segmentation_camera": SegmentationCameraSensor,
    "thermal": ThermalCameraSensor,
    "thermal_camera": ThermalCameraSensor,
}
SIMULATED = frozenset(_KINDS) | MEASURING
"""SDF's sensor types that measure."""


def mount_cameras(world: World, make: Callable[[Scene], Renderer], report: Diagnostics) -> list[CameraSensor]:
    """Every camera of a world, in file order; sensors of types that do not measure yet are named.

    Args:
        world: with its sensors.
        make: makes the one renderer all cameras share; called only if there is a camera.
        report: takes what is not simulated.
    """
    cameras: list[CameraSensor] = []
    scenery: Scenery | None = None
    index = 0
    for model in world.models:
        for link in model.links:
            for sensor in link.sensors:
                if sensor.type in MEASURING:
                    continue
                kind = _KINDS.get(sensor.type)
                if kind is None:
                    report.warn(sensor.at, f"sensor {sensor.name!r}: {sensor.type} sensors are not simulated yet")
                    continue
                _name_unsupported(sensor, report)
                scenery = scenery or Scenery(world, make, report)
                _doubt_labels(sensor, kind, scenery, report)
                cameras += [
                    kind(model, link, sensor, optics, link_index=index, scenery=scenery) for optics in sensor.cameras
                ]
            index += 1
    return cameras


def _doubt_labels(sensor: Sensor, kind: type[CameraSensor], scenery: Scenery, report: Diagnostics) -> None:
    if kind in (BoundingBoxCameraSensor, SegmentationCameraSensor) and not scenery.labels.any():
        report.warn(
            sensor.at,
            f"sensor {sensor.name!r}: nothing in the world has a label (gz-sim-label-system in a <visual> or <model> "
            "gives one); it sees background alone",
        )


def _name_unsupported(sensor: Sensor, report: Diagnostics) -> None:
    who = f"sensor {sensor.name!r}"
    for optics in sensor.cameras:
        if optics.format not in _RGB:
            report.warn(sensor.at, f"{who}: image format {optics.format} is not made yet; R8G8B8 is")
    if any(optics.noise != Noise() or optics.distortion != Distortion() for optics in sensor.cameras):
        report.warn(sensor.at, f"{who}: noise and distortion of pictures are not made yet")
    for plugin in sensor.plugins:
        report.warn(plugin.at, f"{who}: plugin {plugin.filename} is not supported yet; the sensor has topics without")
