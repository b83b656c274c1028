"""Handle of a camera of a running simulation."""

import numpy as np

from trundle.sim.simulation import Simulation

from .camera import CameraSensor
from .camera_image import CameraImage


class CameraHandle:
    """Handle of a camera; it belongs to the thread that owns the simulation."""

    __module__ = "trundle"

    def __init__(self, simulation: Simulation, sensor: CameraSensor, name: str) -> None:
        self._simulation = simulation
        self._sensor = sensor
        self.name = name
        """Name `model::link::sensor`, or `model::link::sensor/camera` in a multicamera."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height [px]."""
        return self._sensor.optics.width_px, self._sensor.optics.height_px

    def render(self) -> CameraImage:
        """Render colors, depths and segmentation of the current state at once, through the lens, without noise.

        Cameras of every type return all three; `Simulation.sensor` reads the type's measurement, with noise.
        """
        snapshot = self._simulation.snapshot()
        sensor = self._sensor
        picture = sensor.draw(snapshot, depth=True, segmentation=True)
        assert picture.segmentation is not None
        numbers, names = sensor.scene.visuals
        return CameraImage(
            time_ns=snapshot.time_ns,
            rgb=np.ascontiguousarray(picture.rgb),
            depth=None if sensor.optics.lens is not None else picture.depth,
            segmentation=numbers[picture.segmentation],
            names=names,
        )

    def __repr__(self) -> str:
        width, height = self.size
        return f"<CameraHandle {self.name!r}: {width}x{height}>"
