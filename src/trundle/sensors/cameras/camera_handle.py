"""A camera of a running simulation, by name."""

import numpy as np

from trundle.simulation import Simulation

from .camera import CameraSensor
from .camera_image import CameraImage


class CameraHandle:
    """One camera; it belongs to the thread that owns the simulation."""

    def __init__(self, simulation: Simulation, sensor: CameraSensor, name: str) -> None:
        self._simulation = simulation
        self._sensor = sensor
        self.name = name
        """`model::link::sensor`; of a multicamera's: `model::link::sensor/camera`."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height [px]."""
        return self._sensor.optics.width_px, self._sensor.optics.height_px

    def render(self) -> CameraImage:
        """Draw what the camera sees now: colours, depths and segmentation at once, through its lens, without noise.

        Whatever its type, a camera gives all three; `Simulation.sensor` reads what its type measures, with noise.
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
