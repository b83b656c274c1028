"""Pictures of the running world and the model being edited for browsers without WebGL, drawn on their own thread."""

import io
import logging
import math
import queue
import threading
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray
from PIL import Image

from trundle.base.diagnostics import Diagnostics
from trundle.page import RenderView
from trundle.robots.model import AnimationState, Model, World
from trundle.sim.render import Intrinsics, NativeRenderer, scene_from_world, update_skins
from trundle.spatial import Pose, Vector3, rows_from_poses

from .drafting import NO_DRAFT, ShownDraft
from .manifest import find_robot

_FOV_RAD = 0.9
"""Field of view of the shorter side."""
_FAR_M = 1e5
_log = logging.getLogger(__name__)


class _Job(NamedTuple):
    id: int
    view: RenderView
    world: World
    poses: NDArray[np.float64]
    states: Mapping[str, AnimationState]
    target: Vector3


class WorldPictures:
    """Draws requested views."""

    def __init__(self, respond: Callable[[int, bytes | str], None]) -> None:
        """Create it; `respond` is called on the drawing thread with a request's id and the PNG, or the error."""
        self._respond = respond
        self._jobs: queue.SimpleQueue[_Job | None] = queue.SimpleQueue()
        self._thread: threading.Thread | None = None
        self._edited: tuple[World, Model, World] | None = None
        """World, model being edited, and the world in which it is drawn."""

    def draw(
        self,
        request_id: int,
        view: RenderView,
        world: World,
        poses: NDArray[np.float64],
        states: Mapping[str, AnimationState],
        draft: ShownDraft = NO_DRAFT,
    ) -> None:
        """Queue a request for a picture of the robot, the model being edited or the origin; return at once.

        Args:
            request_id: request to answer.
            view: size and direction.
            world: flat world; its scene is reused while the world is the same object.
            poses: (links, 7) in the world.
            states: animation state of each actor by name.
            draft: model being edited, drawn in place of its original.
        """
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="trundle-page-pictures", daemon=True)
            self._thread.start()
        target = _target(world, poses)
        if draft.info is not None and draft.model is not None:
            rows = rows_from_poses(_link_poses(draft.model))
            poses = np.concatenate((poses[~_rows_of(draft.info.original, world, len(poses))], rows))
            world = self._with_draft(world, draft.model, draft.info.original)
            target = _center(rows) if len(rows) else target
        self._jobs.put(_Job(request_id, view, world, poses, states, target))

    def _with_draft(self, world: World, model: Model, original: str | None) -> World:
        """Return the world with a model in place of another; the same object for the same arguments."""
        if self._edited is None or self._edited[0] is not world or self._edited[1] is not model:
            others = tuple(other for other in world.models if other.name != original)
            self._edited = world, model, replace(world, models=(*others, model))
        return self._edited[2]

    def close(self) -> None:
        """Stop after the current picture."""
        self._jobs.put(None)

    def _run(self) -> None:
        drawn: _DrawnWorld | None = None
        while (job := self._jobs.get()) is not None:
            try:
                if drawn is None or drawn.world is not job.world:
                    drawn = _DrawnWorld(job.world)
                picture: bytes | str = drawn.png(job)
            except Exception as error:  # a model that cannot be drawn must not end the pictures
                _log.exception("the world cannot be drawn")
                picture = f"the world cannot be drawn: {type(error).__name__}: {error}"
            self._respond(job.id, picture)


class _DrawnWorld:
    """Renderer of one world."""

    def __init__(self, world: World) -> None:
        self.world = world
        self._scene = scene_from_world(world, Diagnostics())
        self._renderer = NativeRenderer(self._scene, threads=1)

    def png(self, job: _Job) -> bytes:
        self._renderer.update(job.poses)
        update_skins(self._renderer, self._scene, lambda actor: job.states.get(actor, AnimationState()))
        (picture,) = self._renderer.render([(_eye(job.view, job.target), _lens(job.view))])
        png = io.BytesIO()
        Image.fromarray(picture.rgb).save(png, "PNG", compress_level=1)
        return png.getvalue()


def _target(world: World, poses: NDArray[np.float64]) -> Vector3:
    """Return the center of the robot's links, or the origin [m]."""
    robot = find_robot(world)
    return (0.0, 0.0, 0.0) if robot is None else _center(poses[_rows_of(robot.name, world, len(poses))])


def _center(poses: NDArray[np.float64]) -> Vector3:
    positions = poses[:, :3]
    x, y, z = ((positions.min(axis=0) + positions.max(axis=0)) / 2).tolist()
    return (x, y, z)


def _rows_of(name: str | None, world: World, count: int) -> NDArray[np.bool_]:
    """Return which of `count` rows of poses are a model's."""
    rows = np.zeros(count, dtype=np.bool_)
    start = 0
    for model in world.models:
        rows[start : start + len(model.links)] = model.name == name
        start += len(model.links)
    return rows


def _link_poses(model: Model) -> list[Pose]:
    return [model.world_from_model @ link.model_from_link for link in model.links]


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
