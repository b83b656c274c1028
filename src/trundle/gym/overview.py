"""Pictures of the worlds of an environment."""

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray
from PIL import Image

from trundle.sim.render import Intrinsics, NativeRenderer, scene_from_world
from trundle.sim.sensors import CameraHandle
from trundle.sim.three_quarter_view import BACKDROP, FIELD_OF_VIEW, STUDIO_LIGHT, scene_corners, three_quarter_pose

from .states import WorldStates

_SIZE = 480, 360
_SAMPLES = 2
"""Supersampling per axis."""


class Overview:
    """Pictures from a three-quarter view of the loaded world, or from one of its cameras."""

    def __init__(self, states: WorldStates, camera: str | None) -> None:
        """Select the view.

        Args:
            states: states of the worlds.
            camera: camera's name; None: a fixed three-quarter view.

        Raises:
            UsageError: no such camera.
        """
        self._states = states
        simulation = states.simulation
        self._camera: CameraHandle | None = None if camera is None else simulation.camera(camera)
        if self._camera is not None:
            return
        scene = scene_from_world(simulation.world, simulation.report)
        self._renderer = NativeRenderer(replace(scene, ambient=STUDIO_LIGHT, background=BACKDROP))
        width, height = _SIZE
        self._lens = Intrinsics(
            width_px=width * _SAMPLES,
            height_px=height * _SAMPLES,
            horizontal_fov_rad=FIELD_OF_VIEW,
            near_m=0.01,
            far_m=1000.0,
        )
        corners = scene_corners(scene, simulation.engine.reader.link_poses())
        self._camera_pose = three_quarter_pose(corners, self._lens)

    def draw(self, row: int) -> NDArray[np.uint8]:
        """Return a picture (height, width, 3) of a world."""
        if self._camera is not None:
            self._states.show(row)
            return self._camera.render().rgb
        self._renderer.update(self._states.batch.poses[row])
        picture = Image.fromarray(self._renderer.render([(self._camera_pose, self._lens)])[0].rgb)
        return np.asarray(picture.resize(_SIZE, Image.Resampling.BOX))
