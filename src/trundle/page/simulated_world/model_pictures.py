"""Pictures and shapes of the models that can be inserted, the pictures kept in the user's cache folder."""

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
"""Shapes farther out than this, such as ground planes, do not count for the view."""
_BACKGROUND = (0.5, 0.53, 0.56, 1.0)
_MAX_FILES = 1000
_MAX_GLB_BYTES = 32_000_000
_VERSION = 1
"""Version in every key; raised when the picture of the same model changes."""


class ModelPictures:
    """Draws on a thread of its own; `respond` is called there with a request's id, and the PNG, the GLB or an error."""

    def __init__(self, respond: Callable[[int, bytes | str], None], packages: Packages) -> None:
        self._respond, self._packages = respond, packages
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="trundle-page-models")

    def draw(self, request_id: int, request: RenderModel) -> None:
        """Ask for a picture or a shape; returns at once."""
        self._thread.submit(
            self._run, request_id, request.model, cached_picture if request.kind == "picture" else model_glb
        )

    def _run(self, request_id: int, model: str, draw: Callable[[str, Packages], bytes]) -> None:
        try:
            self._respond(request_id, draw(model, self._packages))
        except TrundleError as error:
            self._respond(request_id, reason_of(error))
        except Exception as error:  # a file of any kind lies on the model path; the simulation goes on
            self._respond(request_id, f"{model} cannot be drawn: {type(error).__name__}: {error}")

    def close(self) -> None:
        """Stop after the picture in the making."""
        self._thread.shutdown(wait=False, cancel_futures=True)


def cached_picture(model: str, packages: Packages) -> bytes:
    """Return a model's picture as PNG, from the cache if its files have not changed.

    Raises:
        TrundleError: there is no such model, or nothing of it can be drawn.
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
    except (OSError, UsageError):  # a cache that cannot be written costs time and nothing else
        return png
    return png


def _key(folder: Path) -> str:
    """Return a name for the state of a model's files: where they are, how large and how old."""
    state = [f"{_VERSION} {folder.resolve()}"]
    for each in sorted(folder.glob("*"))[:_MAX_FILES]:
        about = each.stat()
        state.append(f"{each.name} {about.st_size} {about.st_mtime_ns}")
    return hashlib.sha256("\n".join(state).encode()).hexdigest()[:32]


def _trim(cache: Path) -> None:
    """Remove the pictures that were used longest ago beyond the limit."""
    files = sorted(cache.glob("*.png"), key=lambda file: file.stat().st_mtime)
    for file in files[: max(0, len(files) - _MAX_FILES)]:
        file.unlink(missing_ok=True)


def model_glb(model: str, packages: Packages) -> bytes:
    """Return a model's visuals as GLB, in the world's frame.

    Raises:
        TrundleError: it cannot be read, or is too large to be shown before it is inserted.
    """
    if model not in packages.models():
        raise UsageError(f"no model {model!r} on the model path")
    world, poses = _read(model, packages)
    document = Document(embed=True)
    scene = replace(scene_from_world(world, Diagnostics()), lights=())
    glb = document.glb(add_scene(document, scene, rows_from_poses(poses), range(len(poses))))
    if len(glb) > _MAX_GLB_BYTES:
        raise UsageError(f"model {model!r} is too large to be shown before it is inserted")
    return glb


def _read(model: str, packages: Packages) -> tuple[World, list[Pose]]:
    """Return a world with a model alone, and the poses of its links in the world."""
    world = flattened(load(f"model://{model}", Diagnostics(), packages=packages).world)
    return world, [each.world_from_model @ link.model_from_link for each in world.models for link in each.links]


def draw_model(model: str, packages: Packages) -> bytes:
    """Return a model's picture as PNG.

    Raises:
        TrundleError: it cannot be read, or has nothing to see.
    """
    world, poses = _read(model, packages)
    scene = scene_from_world(world, Diagnostics())
    corners: list[Vector3] = []
    for shape in scene.shapes:
        world_from_shape, points = poses[shape.body] @ shape.body_from_shape, corners_of(shape.geometry)
        if max((max(map(abs, point)) for point in points), default=0.0) < _LARGEST_M:
            corners += map(world_from_shape.transform_point, points)
    if not scene.shapes:
        raise UsageError(f"model {model!r} has nothing to see")
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
    """Pose of the camera in the world; it looks along its x at the target."""
    level, x, y, z = distance * math.cos(_ELEVATION_RAD), *target
    position = (
        x + level * math.cos(_AZIMUTH_RAD),
        y + level * math.sin(_AZIMUTH_RAD),
        z + distance * math.sin(_ELEVATION_RAD),
    )
    return Pose(position, Pose.from_rpy(0.0, 0.0, 0.0, 0.0, _ELEVATION_RAD, _AZIMUTH_RAD + math.pi).quaternion)
