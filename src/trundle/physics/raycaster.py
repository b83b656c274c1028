"""Camera pictures by casting rays through the engine: flat shading, no GPU, no display.

It draws from a MuJoCo model of its own that holds a scene's shapes and nothing else; one mocap body carries each of
the scene's bodies.
"""

from functools import lru_cache

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.meshes import Mesh
from trundle.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.render import Intrinsics, Picture, Scene, Shape, ShapeGeometry
from trundle.spatial import Pose, Vector3

from .shapes import THINNEST, upright

_NO_GROUPS = np.ones(mujoco.mjNGROUP, dtype=np.uint8)
_AXES: tuple[Vector3, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_DEFAULT_LIGHT = (-0.3, 0.5, -0.8)


class RayRenderer:
    """Implements `render.Renderer` with `mj_multiRay`."""

    def __init__(self, scene: Scene) -> None:
        """Build the ray model of a scene."""
        spec = mujoco.MjSpec()
        spec.compiler.degree = False
        carriers = [spec.worldbody.add_body(name=f"body{i}", mocap=True) for i in range(len(scene.bodies))]
        drawn = [shape for shape in scene.shapes if _is_drawn(shape)]
        for i, shape in enumerate(drawn):
            _add_geom(spec, carriers[shape.body], shape, f"shape{i}")
        self._model = spec.compile()
        self._data = mujoco.MjData(self._model)
        colours = np.array([shape.rgba[:3] for shape in drawn], dtype=np.float32).reshape(-1, 3)
        self._ambient = colours * np.float32(255.0) * np.array(scene.ambient[:3], dtype=np.float32)
        lights = scene.lights or ()
        directions = [light.direction for light in lights] or [_DEFAULT_LIGHT]
        strengths = [light.diffuse[:3] for light in lights] or [(0.8, 0.8, 0.8)]
        self._to_lights = -np.array(directions, dtype=np.float64)
        self._lit = [colours * np.float32(255.0) * np.array(s, dtype=np.float32) for s in strengths]
        self._background = np.array([round(255 * c) for c in scene.background[:3]], dtype=np.uint8)
        mujoco.mj_kinematics(self._model, self._data)

    def update(self, poses: NDArray[np.float64]) -> None:
        """See `Renderer.update`."""
        self._data.mocap_pos[:] = poses[:, :3]
        self._data.mocap_quat[:] = poses[:, 3:]
        mujoco.mj_kinematics(self._model, self._data)

    def render(self, world_from_camera: Pose, intrinsics: Intrinsics, *, depth: bool = False) -> Picture:
        """See `Renderer.render`."""
        rays, cosines = _rays(intrinsics)
        axes = np.array([world_from_camera.direction(axis) for axis in _AXES])
        directions = rays @ axes
        count = len(directions)
        geoms = np.empty(count, dtype=np.int32)
        distances = np.empty(count)
        normals = np.empty((count, 3))
        origin = np.array(world_from_camera.position)
        mujoco.mj_multiRay(
            self._model,
            self._data,
            origin,
            directions.reshape(-1),
            _NO_GROUPS,
            True,
            -1,
            geoms,
            distances,
            normals.reshape(-1),
            count,
            intrinsics.far_m * 2.0,
        )
        along_axis = distances * cosines
        seen = (geoms >= 0) & (along_axis >= intrinsics.near_m) & (along_axis <= intrinsics.far_m)
        rgb = np.empty((count, 3), dtype=np.uint8)
        rgb[:] = self._background
        rgb[seen] = self._shade(geoms[seen], normals[seen])
        shape = (intrinsics.height_px, intrinsics.width_px)
        if not depth:
            return Picture(rgb.reshape(*shape, 3))
        ranges = np.where(seen, along_axis, np.inf).astype(np.float32)
        return Picture(rgb.reshape(*shape, 3), ranges.reshape(shape))

    def _shade(self, geoms: NDArray[np.int32], normals: NDArray[np.float64]) -> NDArray[np.uint8]:
        """Lambert's law for each light, over the ambient light."""
        colour = self._ambient[geoms]
        for to_light, lit in zip(self._to_lights, self._lit, strict=True):
            facing = np.maximum(normals @ to_light, 0.0).astype(np.float32)
            colour += lit[geoms] * facing[:, None]
        return np.minimum(colour, np.float32(255.0)).astype(np.uint8)


def _is_drawn(shape: Shape) -> bool:
    """Glass is looked through: rays know no half-seen shapes."""
    return shape.rgba[3] >= 0.5


@lru_cache(maxsize=16)
def _rays(intrinsics: Intrinsics) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Unit directions through the pixels' centres in the camera frame (N, 3), row by row, and their cosines (N,)."""
    focal = intrinsics.focal_px
    columns = (np.arange(intrinsics.width_px) + 0.5 - intrinsics.width_px / 2) / focal
    rows = (np.arange(intrinsics.height_px) + 0.5 - intrinsics.height_px / 2) / focal
    y, z = np.meshgrid(-columns, -rows)
    directions = np.stack([np.ones_like(y), y, z], axis=-1).reshape(-1, 3)
    lengths = np.linalg.norm(directions, axis=1)
    return directions / lengths[:, None], 1.0 / lengths


def _add_geom(spec: mujoco.MjSpec, body: mujoco.MjsBody, shape: Shape, name: str) -> None:
    pose = shape.body_from_shape
    geom = body.add_geom(name=name, pos=pose.position, quat=pose.quaternion, contype=0, conaffinity=0)
    geometry: ShapeGeometry = shape.geometry
    match geometry:
        case Box(size):
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_BOX, [max(s, THINNEST) / 2 for s in size]
        case Cylinder(radius, length):
            geom.type = mujoco.mjtGeom.mjGEOM_CYLINDER
            geom.size = [max(radius, THINNEST), max(length, THINNEST) / 2, 0]
        case Capsule(radius, length):
            geom.type = mujoco.mjtGeom.mjGEOM_CAPSULE
            geom.size = [max(radius, THINNEST), max(length, THINNEST) / 2, 0]
        case Sphere(radius):
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_SPHERE, [max(radius, THINNEST), 0, 0]
        case Ellipsoid(radii):
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_ELLIPSOID, [max(r, THINNEST) for r in radii]
        case Plane(normal, (width, height)):
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_PLANE, [width / 2, height / 2, 1]
            geom.quat = (pose @ Pose(quaternion=upright(normal))).quaternion
        case Mesh(vertices, faces):
            spec.add_mesh(
                name=name,
                uservert=vertices.reshape(-1).astype(float),
                userface=faces.reshape(-1),
                inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
            )
            geom.type, geom.meshname = mujoco.mjtGeom.mjGEOM_MESH, name
