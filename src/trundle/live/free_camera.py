"""Camera at any pose in a world, without a sensor."""

import math
from typing import TYPE_CHECKING

import numpy as np

from trundle.base.arguments import count_of, number_of, vector_of
from trundle.base.diagnostics import UsageError
from trundle.sim.render import Intrinsics
from trundle.sim.renderers import RENDERERS
from trundle.sim.sensors import CameraImage, CameraScene
from trundle.sim.simulation import Simulation, Snapshot
from trundle.sim.three_quarter_view import FIELD_OF_VIEW, scene_corners, three_quarter_pose
from trundle.spatial import Pose, normalized, subtract

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_MAX_PX = 3840 * 2160
_FOV_RAD = 0.9
_NEAR_M, _FAR_M = 0.01, 1e4


class FreeCamera:
    """Camera of one simulation; its pictures show spawned models, and no deleted ones."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._scene = CameraScene(simulation, RENDERERS["cpu"])

    def draw(
        self,
        snapshot: Snapshot,
        *,
        eye: "ArrayLike | None",
        target: "ArrayLike | None",
        size: tuple[int, int],
        fov_rad: float | None,
    ) -> CameraImage:
        """Draw a state; see `LoadedSimulation.picture`."""
        lens = _lens(size, fov_rad if fov_rad is not None else FIELD_OF_VIEW if eye is None else _FOV_RAD)
        if eye is None:
            pose = three_quarter_pose(scene_corners(self._scene.scene, snapshot.poses), lens)
        else:
            pose = looking_at(eye, (0.0, 0.0, 0.0) if target is None else target)
        request = self._scene.request(snapshot, [(pose, lens)], depth=True, segmentation=True, camera=self)
        (picture,) = self._scene.fetch(request)
        assert picture.segmentation is not None
        numbers, names = self._scene.visuals
        return CameraImage(
            time_ns=snapshot.time_ns,
            rgb=np.ascontiguousarray(picture.rgb),
            depth=picture.depth,
            segmentation=numbers[picture.segmentation],
            names=names,
        )


def looking_at(eye: "ArrayLike", target: "ArrayLike") -> Pose:
    """Return a camera's pose in the world: x points along the view, z up in the picture.

    Raises:
        UsageError: a point is not 3 numbers, or both are the same.
    """
    position = vector_of(eye, "eye [m]")
    direction = normalized(subtract(vector_of(target, "target [m]"), position))
    if direction is None:
        raise UsageError(f"eye and target are the same point, {position}: there is no direction to look in")
    x, y, z = direction
    return Pose(
        position, Pose.from_rpy(0.0, 0.0, 0.0, 0.0, -math.asin(max(-1.0, min(z, 1.0))), math.atan2(y, x)).quaternion
    )


def _lens(size: tuple[int, int], fov_rad: float) -> Intrinsics:
    try:
        width, height = size
    except (TypeError, ValueError):
        raise UsageError(f"size must be (width, height) [px], got {size!r}") from None
    width, height = count_of(width, "width [px]"), count_of(height, "height [px]")
    if not 0 < width * height <= _MAX_PX:
        raise UsageError(f"a picture of {width} x {height} px is not possible; it may have 1 to {_MAX_PX} pixels")
    if not 0.0 < number_of(fov_rad, "fov_rad [rad]") < math.pi:
        raise UsageError(f"fov_rad must be between 0 and π [rad], got {fov_rad}")
    return Intrinsics(width_px=width, height_px=height, horizontal_fov_rad=fov_rad, near_m=_NEAR_M, far_m=_FAR_M)
