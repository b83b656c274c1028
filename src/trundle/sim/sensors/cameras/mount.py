"""Creation of a world's cameras."""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import MEASURING, CameraOptics, Distortion, Sensor
from trundle.sim import sensors
from trundle.sim.render import Renderer, Scene
from trundle.sim.simulation import Simulation

from ..live_sensor import SensorMount
from .camera import CameraSensor
from .image_saver import ImageSaver, folder_for, quota_of
from .lens import fits
from .pixel_formats import FORMATS
from .scene import CameraScene

_KINDS: Mapping[str, str] = {
    "boundingbox": "BoundingBoxCameraSensor",
    "boundingbox_camera": "BoundingBoxCameraSensor",
    "camera": "CameraSensor",
    "depth": "DepthCameraSensor",
    "depth_camera": "DepthCameraSensor",
    "multicamera": "CameraSensor",
    "rgbd": "DepthCameraSensor",
    "rgbd_camera": "DepthCameraSensor",
    "segmentation": "SegmentationCameraSensor",
    "segmentation_camera": "SegmentationCameraSensor",
    "thermal": "ThermalCameraSensor",
    "thermal_camera": "ThermalCameraSensor",
    "wide_angle_camera": "CameraSensor",
    "wideanglecamera": "CameraSensor",
}
"""SDF type → class, which is imported on first use."""
SIMULATED_CAMERAS = frozenset(_KINDS) | MEASURING
"""SDF sensor types that are simulated."""


def mount_cameras(
    simulation: Simulation,
    make: Callable[[Scene], Renderer],
    *,
    model: str | None = None,
    existing: Sequence[CameraSensor] = (),
) -> list[CameraSensor]:
    """Create every camera of a world, in file order; warn of unsupported sensor types.

    Args:
        simulation: simulation with the sensors; its seed is the noise's.
        make: creates a renderer, one per visibility mask; not called without cameras.
        model: model whose cameras are created; None: all models.
        existing: existing cameras, whose renderers are shared.
    """
    world, report = simulation.world, simulation.report
    cameras: list[CameraSensor] = []
    scenes = {camera.scene.mask: camera.scene for camera in existing}
    index = number = 0
    for owner in world.models:
        for link in owner.links:
            for sensor in link.sensors:
                number += 1
                if sensor.type in MEASURING or model not in (None, owner.name):
                    continue
                if sensor.type not in _KINDS:
                    report.warn(
                        sensor.at,
                        f"sensor {sensor.name!r}: {sensor.type} sensors are not simulated yet",
                        "unsupported-sensor",
                    )
                    continue
                kind: type[CameraSensor] = getattr(sensors, _KINDS[sensor.type])
                _report_unsupported(sensor, report)
                multicamera: list[CameraSensor] = []
                for part, optics in enumerate(_supported_cameras(sensor, report)):
                    mask = optics.visibility_mask
                    if mask not in scenes:
                        scenes[mask] = CameraScene(simulation, make, mask=mask)
                    camera = kind(
                        SensorMount(owner, link, sensor, index, (simulation.seed, number, part)),
                        optics,
                        scene=scenes[mask],
                    )
                    camera.attach_to(simulation[owner.name].link(link.name))
                    camera.multicamera = multicamera
                    _save(camera, simulation, world.name, report)
                    multicamera.append(camera)
                _check_labels(multicamera, report)
                cameras += multicamera
            index += 1
    return cameras


def _check_labels(cameras: Sequence[CameraSensor], report: Diagnostics) -> None:
    for camera in cameras:
        if camera.sees_labels and not camera.scene.labels.any():
            problem = "nothing in the world has a label (gz-sim-label-system in a <visual> or <model> gives one)"
            report.warn(
                camera.sensor.at, f"sensor {camera.name!r}: {problem}; the image shows background only", "no-labels"
            )


def _supported_cameras(sensor: Sensor, report: Diagnostics) -> Iterator[CameraOptics]:
    """Yield the sensor's cameras, with R8G8B8 for unsupported formats."""
    for optics in sensor.cameras:
        if optics.format in FORMATS:
            yield optics
        else:
            formats = ", ".join(FORMATS)
            problem = f"no image format {optics.format}; formats: {formats}; R8G8B8 is used"
            report.warn(sensor.at, f"sensor {sensor.name!r}: {problem}", "unknown-choice")
            yield replace(optics, format="R8G8B8")


def _save(camera: CameraSensor, simulation: Simulation, world: str, report: Diagnostics) -> None:
    path = camera.optics.save_path
    if path is None:
        return
    folder = folder_for(path)
    if folder == Path(os.path.abspath(path)):
        report.info(camera.sensor.at, f"sensor {camera.name!r}: <save> writes into {folder}", "saved-images")
    else:
        report.warn(
            camera.sensor.at, f"sensor {camera.name!r}: <save> writes into {folder} in place of {path}", "saved-images"
        )
    saver = ImageSaver(camera, folder, world, report, quota_of(simulation))
    camera.listen(saver.save, enabled=saver.enabled)


def _report_unsupported(sensor: Sensor, report: Diagnostics) -> None:
    prefix = f"sensor {sensor.name!r}"
    for optics in sensor.cameras:
        if optics.lens is not None and optics.lens.scale_to_hfov and not fits(optics.lens, optics.horizontal_fov_rad):
            fov = f"{optics.horizontal_fov_rad:g} rad"
            report.warn(
                sensor.at, f"{prefix}: no scale of this lens spans {fov}; <scale_to_hfov> is ignored", "out-of-range"
            )
        if optics.box_type == "full_2d" and (optics.distortion != Distortion() or optics.intrinsics is not None):
            report.warn(sensor.at, f"{prefix}: full_2d boxes ignore distortion and <intrinsics>", "unsupported-sensor")
