"""Pictures, cached in the user's cache folder, and shapes of the models that can be inserted."""

import hashlib
import io
import math
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from msgspec.structs import replace
from PIL import Image

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import Diagnostics, TrundleError, UsageError
from trundle.base.ownership import is_owned_by_user
from trundle.page import RenderModel
from trundle.robots.description import load
from trundle.robots.meshes import cache_folder
from trundle.robots.model import World, flattened
from trundle.robots.packages import Packages
from trundle.sim.gltf import Document, add_scene
from trundle.sim.render import DEFAULT_LIGHTS, Intrinsics, NativeRenderer, corners_of, scene_from_world
from trundle.spatial import Pose, Vector3, rows_from_poses

from .controls import reason_of

SIZE_PX = 96
_FOV_RAD = 0.6
_AZIMUTH_RAD, _ELEVATION_RAD = 0.7, 0.45
_LARGEST_M = 50.0
"""Larger shapes, such as ground planes, are ignored when the camera is placed."""
_BACKGROUND = (0.5, 0.53, 0.56, 1.0)
_MAX_FILES = 1000
_MAX_GLB_BYTES = 32_000_000
_VERSION = 1
"""Part of every cache key; raise it when pictures of unchanged models change."""


class ModelPictures:
    """Draws on its own thread; `respond` is called there with a request's id, and the PNG, the GLB or an error."""

    def __init__(self, respond: Callable[[int, bytes | str], None], packages: Packages) -> None:
        self._respond, self._packages = respond, packages
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="trundle-page-models")

    def draw(self, request_id: int, request: RenderModel) -> None:
        """Queue a request for a picture or a shape; return at once."""
        self._thread.submit(
            self._run, request_id, request.model, cached_picture if request.kind == "picture" else model_glb
        )

    def _run(self, request_id: int, model: str, draw: Callable[[str, Packages], bytes]) -> None:
        try:
            self._respond(request_id, draw(model, self._packages))
        except TrundleError as error:
            self._respond(request_id, reason_of(error))
        except Exception as error:  # a fault of a reader must not end the simulation
            self._respond(request_id, f"{model} cannot be drawn: {type(error).__name__}: {error}")

    def close(self) -> None:
        """Stop after the current picture."""
        self._thread.shutdown(wait=False, cancel_futures=True)


def cached_picture(model: str, packages: Packages) -> bytes:
    """Return a model's picture as PNG, from the cache if its files have not changed.

    Raises:
        TrundleError: there is no such model, or it has nothing to draw.
    """
    folder = packages.models().get(model)
    if folder is None:
        raise UsageError(f"no model {model!r} on the model path")
    cache = cache_folder().with_name("models")
    file = cache / f"{_key(folder)}.png"
    if is_owned_by_user(cache) and file.is_file():  # another user's file could be any picture
        os.utime(file)  # marks it as recently used
        return file.read_bytes()
    png = draw_model(model, packages)
    try:
        cache.mkdir(mode=0o700, parents=True, exist_ok=True)
        if is_owned_by_user(cache):
            write_atomically(file, png)
            _trim(cache)
    except (OSError, UsageError):  # without a cache, only time is lost
        return png
    return png


def _key(folder: Path) -> str:
    """Return the cache key of a model's files: a hash of their paths, sizes and times of change."""
    state = [f"{_VERSION} {folder.resolve()}"]
    for file in sorted(folder.glob("*"))[:_MAX_FILES]:
        status = file.stat()
        state.append(f"{file.name} {status.st_size} {status.st_mtime_ns}")
    return hashlib.sha256("\n".join(state).encode()).hexdigest()[:32]


def _trim(cache: Path) -> None:
    """Remove the least recently used pictures beyond the limit."""
    files = sorted(cache.glob("*.png"), key=lambda file: file.stat().st_mtime)
    for file in files[: max(0, len(files) - _MAX_FILES)]:
        file.unlink(missing_ok=True)


def model_glb(model: str, packages: Packages) -> bytes:
    """Return a model's visuals as GLB, in the world's frame.

    Raises:
        TrundleError: the model cannot be read, or is too large for a preview.
    """
    if model not in packages.models():
        raise UsageError(f"no model {model!r} on the model path")
    world, poses = _read(model, packages)
    document = Document(embed=True)
    scene = replace(scene_from_world(world, Diagnostics()), lights=())
    glb = document.glb(add_scene(document, scene, rows_from_poses(poses), range(len(poses))))
    if len(glb) > _MAX_GLB_BYTES:
        raise UsageError(f"model {model!r} is too large for a preview")
    return glb


def _read(model: str, packages: Packages) -> tuple[World, list[Pose]]:
    """Return a world that has only this model, and the poses of its links in the world."""
    world = flattened(load(f"model://{model}", Diagnostics(), packages=packages).world)
    return world, [part.world_from_model @ link.model_from_link for part in world.models for link in part.links]


def draw_model(model: str, packages: Packages) -> bytes:
    """Return a model's picture as PNG.

    Raises:
        TrundleError: the model cannot be read, or has nothing to draw.
    """
    world, poses = _read(model, packages)
    scene = scene_from_world(world, Diagnostics())
    corners: list[Vector3] = []
    for shape in scene.shapes:
        world_from_shape, points = poses[shape.body] @ shape.body_from_shape, corners_of(shape.geometry)
        if max((max(map(abs, point)) for point in points), default=0.0) < _LARGEST_M:
            corners += map(world_from_shape.transform_point, points)
    if not scene.shapes:
        raise UsageError(f"model {model!r} has nothing to draw")
    points = np.array(corners or [(-1.0, -1.0, 0.0), (1.0, 1.0, 0.0)])
    low, high = points.min(axis=0), points.max(axis=0)
    radius = max(float(np.linalg.norm(high - low)) / 2, 1e-3)
    lens = Intrinsics(
        width_px=SIZE_PX,
        height_px=SIZE_PX,
        horizontal_fov_rad=_FOV_RAD,
        near_m=radius / 50,
        far_m=radius * 100,
    )
    lit = replace(scene, lights=DEFAULT_LIGHTS, background=_BACKGROUND)
    renderer = NativeRenderer(lit, threads=1)
    renderer.update(rows_from_poses(poses))
    (picture,) = renderer.render([(_eye(((low + high) / 2).tolist(), radius / math.sin(_FOV_RAD / 2)), lens)])
    png = io.BytesIO()
    Image.fromarray(picture.rgb).save(png, "PNG")
    return png.getvalue()


def _eye(target: list[float], distance: float) -> Pose:
    """Return the camera's pose in the world; its x axis points at the target."""
    level, x, y, z = distance * math.cos(_ELEVATION_RAD), *target
    position = (
        x + level * math.cos(_AZIMUTH_RAD),
        y + level * math.sin(_AZIMUTH_RAD),
        z + distance * math.sin(_ELEVATION_RAD),
    )
    return Pose(position, Pose.from_rpy(0.0, 0.0, 0.0, 0.0, _ELEVATION_RAD, _AZIMUTH_RAD + math.pi).quaternion)
