"""Pictures of the running world for browsers without WebGL, drawn on their own thread."""

import io
import math
import queue
import threading
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from trundle.base.diagnostics import Diagnostics
from trundle.page import RenderView
from trundle.robots.model import AnimationState, World
from trundle.sim.render import Intrinsics, NativeRenderer, Scene, scene_from_world, update_skins
from trundle.spatial import Pose, Vector3

from .manifest import find_robot

_FOV_RAD = 0.9
"""Field of view of the shorter side."""
_FAR_M = 1e5


class _Job(NamedTuple):
    id: int
    view: RenderView
    world: World
    poses: NDArray[np.float64]
    states: Mapping[str, AnimationState]
    target: Vector3


class WorldPictures:
    """Draws requested views; `respond` is called on the drawing thread with a request's id and the PNG."""

    def __init__(self, respond: Callable[[int, bytes], None]) -> None:
        self._respond = respond
        self._jobs: queue.SimpleQueue[_Job | None] = queue.SimpleQueue()
        self._thread: threading.Thread | None = None

    def draw(
        self,
        request_id: int,
        view: RenderView,
        world: World,
        poses: NDArray[np.float64],
        states: Mapping[str, AnimationState],
    ) -> None:
        """Queue a request for a picture; return at once.

        Args:
            request_id: request to answer.
            view: size and direction.
            world: flat world; its scene is reused while the world is the same object.
            poses: (links, 7) in the world.
            states: animation state of each actor by name.
        """
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="trundle-page-pictures", daemon=True)
            self._thread.start()
        self._jobs.put(_Job(request_id, view, world, poses, states, _target(world, poses)))

    def close(self) -> None:
        """Stop after the current picture."""
        self._jobs.put(None)

    def _run(self) -> None:
        world: World | None = None
        scene: Scene | None = None
        renderer: NativeRenderer | None = None
        while (job := self._jobs.get()) is not None:
            if renderer is None or scene is None or job.world is not world:
                world = job.world
                scene = scene_from_world(world, Diagnostics())
                renderer = NativeRenderer(scene, threads=1)
            renderer.update(job.poses)
            update_skins(renderer, scene, lambda actor, job=job: job.states.get(actor, AnimationState()))
            view = job.view
            (picture,) = renderer.render([(_eye(view, job.target), _lens(view))])
            png = io.BytesIO()
            Image.fromarray(picture.rgb).save(png, "PNG", compress_level=1)
            self._respond(job.id, png.getvalue())


def _target(world: World, poses: NDArray[np.float64]) -> Vector3:
    """Return the centre of the robot's links, or the origin [m]."""
    robot, row = find_robot(world), 0
    for model in world.models:
        if model is robot:
            positions = poses[row : row + len(model.links), :3]
            x, y, z = ((positions.min(axis=0) + positions.max(axis=0)) / 2).tolist()
            return (x, y, z)
        row += len(model.links)
    return (0.0, 0.0, 0.0)


def _lens(view: RenderView) -> Intrinsics:
    half = math.tan(_FOV_RAD / 2) * view.width / min(view.width, view.height)
    return Intrinsics(
        width_px=view.width,
        height_px=view.height,
        horizontal_fov_rad=2 * math.atan(half),
        near_m=0.01,
        far_m=_FAR_M,
    )


def _eye(view: RenderView, target: Vector3) -> Pose:
    """Return the camera's pose in the world; its x axis points at the target."""
    level = view.distance * math.cos(view.elevation)
    x, y, z = target
    position = (
        x + level * math.cos(view.azimuth),
        y + level * math.sin(view.azimuth),
        z + view.distance * math.sin(view.elevation),
    )
    turned = Pose.from_rpy(0.0, 0.0, 0.0, 0.0, view.elevation, view.azimuth + math.pi)
    return Pose(position, turned.quaternion)
