"""Camera sensors: a snapshot becomes a picture."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from trundle.model import Link, Model, Sensor
from trundle.render import Intrinsics, Renderer
from trundle.simulation import Snapshot
from trundle.spatial import Pose

from .mounted import MountedSensor

FASTEST_HZ = 30.0
"""Of a camera whose update_rate is 0. Gazebo then draws at every step, which nobody means."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class CameraReading:
    """What a camera saw, and when."""

    time_ns: int
    """The instant the world looked so."""
    rgb: NDArray[np.uint8]
    """(height, width, 3)"""


class CameraSensor(MountedSensor[CameraReading]):
    """A hook that takes a picture when it is due and somebody wants it."""

    def __init__(self, model: Model, link: Link, sensor: Sensor, *, link_index: int, renderer: Renderer) -> None:
        """Mount a camera.

        Args:
            model: whose it is.
            link: that carries it.
            sensor: with its camera.
            link_index: of the link in `Snapshot.poses`.
            renderer: draws the world; shared by all cameras.
        """
        optics = sensor.camera
        assert optics is not None, f"{sensor.name!r} is no camera"
        super().__init__(model, link, sensor, link_index=link_index, fastest_hz=FASTEST_HZ)
        self.link_from_camera: Pose = sensor.link_from_sensor @ optics.sensor_from_camera
        self.intrinsics = Intrinsics(
            width_px=optics.width_px,
            height_px=optics.height_px,
            horizontal_fov_rad=optics.horizontal_fov_rad,
            near_m=optics.near_m,
            far_m=optics.far_m,
        )
        self.images = 0
        """Pictures finished."""
        self._renderer = renderer

    def take(self, snapshot: Snapshot) -> CameraReading:
        """Take a picture of this instant."""
        world_from_camera = self.world_from_link(snapshot) @ self.link_from_camera
        self._renderer.update(snapshot.poses)
        picture = self._renderer.render(world_from_camera, self.intrinsics)
        self.images += 1
        return CameraReading(time_ns=snapshot.time_ns, rgb=picture.rgb)
