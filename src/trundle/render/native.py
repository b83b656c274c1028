"""Trundle's own renderer: pictures made on the CPU, in C++; no GPU, no display."""

import numpy as np
from numpy.typing import NDArray

from trundle.meshes import Mesh
from trundle.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.spatial import Pose, upright

from . import _native
from .renderer import Intrinsics, Picture
from .scene import Scene, SceneLight, Shape

_THINNEST = 1e-4
"""[m] What a thickness of zero becomes: 0.1 mm."""
_OPAQUE_FROM = 0.5
"""Opacity below which a shape is not drawn: half-seen shapes are not drawn yet."""
_DEFAULT_LIGHTS = (SceneLight(direction=(-0.3, 0.5, -0.8)),)


class NativeRenderer:
    """Implements `Renderer`: what is seen is found by exact ray intersection, of meshes by rasterising."""

    def __init__(self, scene: Scene) -> None:
        """Hand a scene to C++."""
        meshes: dict[int, int] = {}
        native_meshes: list[_native.Mesh] = []
        shapes: list[_native.Shape] = []
        drawn: list[int] = []
        for number, shape in enumerate(scene.shapes):
            if shape.rgba[3] < _OPAQUE_FROM:
                continue
            mesh = -1
            if isinstance(shape.geometry, Mesh):
                mesh = meshes.setdefault(id(shape.geometry), len(meshes))
                if mesh == len(native_meshes):
                    native_meshes.append(_native_mesh(shape.geometry))
            shapes.append(_native_shape(shape, mesh))
            drawn.append(number)
        self._numbers = np.array([*drawn, -1], dtype=np.int32)  # the last one for what no shape covers, -1
        self._renderer = _native.Renderer(
            bodies=len(scene.bodies),
            meshes=native_meshes,
            shapes=shapes,
            lights=[
                _native.Light(direction=light.direction, diffuse=light.diffuse[:3])
                for light in scene.lights or _DEFAULT_LIGHTS
            ],
            ambient=scene.ambient[:3],
            background=scene.background[:3],
        )

    def update(self, poses: NDArray[np.float64]) -> None:
        """See `Renderer.update`."""
        self._renderer.update(np.ascontiguousarray(poses, dtype=np.float64))

    def render(
        self, world_from_camera: Pose, intrinsics: Intrinsics, *, depth: bool = False, segmentation: bool = False
    ) -> Picture:
        """See `Renderer.render`."""
        size = (intrinsics.height_px, intrinsics.width_px)
        rgb = np.empty((*size, 3), dtype=np.uint8)
        depths = np.empty(size, dtype=np.float32) if depth else None
        segments = np.empty(size, dtype=np.int32) if segmentation else None
        self._renderer.render(
            (*world_from_camera.position, *world_from_camera.quaternion),
            focal=intrinsics.focal_px,
            near=intrinsics.near_m,
            far=intrinsics.far_m,
            rgb=rgb,
            depth=depths,
            segmentation=segments,
        )
        return Picture(rgb, depths, None if segments is None else self._numbers[segments])


def _native_mesh(mesh: Mesh) -> _native.Mesh:
    return _native.Mesh(
        np.ascontiguousarray(mesh.vertices, dtype=np.float32), np.ascontiguousarray(mesh.faces, dtype=np.int32)
    )


def _native_shape(shape: Shape, mesh: int) -> _native.Shape:
    pose = shape.body_from_shape
    size = (0.0, 0.0, 0.0)
    match shape.geometry:
        case Box((x, y, z)):
            kind, size = _native.Kind.BOX, (_thick(x) / 2, _thick(y) / 2, _thick(z) / 2)
        case Cylinder(radius, length):
            kind, size = _native.Kind.CYLINDER, (_thick(radius), _thick(length) / 2, 0.0)
        case Capsule(radius, length):
            kind, size = _native.Kind.CAPSULE, (_thick(radius), _thick(length) / 2, 0.0)
        case Sphere(radius):
            kind, size = _native.Kind.SPHERE, (_thick(radius), 0.0, 0.0)
        case Ellipsoid((x, y, z)):
            kind, size = _native.Kind.ELLIPSOID, (_thick(x), _thick(y), _thick(z))
        case Plane(normal, (width, height)):
            kind, size = _native.Kind.PLANE, (width / 2, height / 2, 0.0)
            pose = pose @ Pose(quaternion=upright(normal))
        case Mesh():
            kind = _native.Kind.MESH
    return _native.Shape(
        kind,
        body=shape.body,
        mesh=mesh,
        size=size,
        body_from_shape=(*pose.position, *pose.quaternion),
        colour=shape.rgba[:3],
    )


def _thick(length: float) -> float:
    return max(length, _THINNEST)
