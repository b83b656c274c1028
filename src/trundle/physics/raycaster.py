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

_Indices = NDArray[np.intp]
_PLANE_GROUP = 1
_SOLIDS = np.array([group != _PLANE_GROUP for group in range(mujoco.mjNGROUP)], dtype=np.uint8)
_AXES: tuple[Vector3, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_BOX = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
"""A box's corners, in half lengths."""
_EDGES = np.array([(i, i | bit) for i in range(8) for bit in (1, 2, 4) if not i & bit])
"""Its twelve edges, as pairs of corners."""
_DEFAULT_LIGHT = (-0.3, 0.5, -0.8)


class RayRenderer:
    """Implements `render.Renderer` with `mj_multiRay`.

    Rays are cast only through the pixels that a shape's bounding box may cover; endless ground, which fills most of
    most pictures, is one division a pixel.
    """

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
        is_plane = self._model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE
        self._planes, self._solids = np.flatnonzero(is_plane), np.flatnonzero(~is_plane)
        boxes = self._model.geom_aabb[self._solids]
        self._corners = boxes[:, None, :3] + _BOX * boxes[:, None, 3:]
        colours = np.array([shape.rgba[:3] for shape in drawn], dtype=np.float32).reshape(-1, 3)
        self._ambient = colours * np.float32(255.0) * np.array(scene.ambient[:3], dtype=np.float32)
        directions = [light.direction for light in scene.lights] or [_DEFAULT_LIGHT]
        strengths = [light.diffuse[:3] for light in scene.lights] or [(0.8, 0.8, 0.8)]
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
        rays = _rays(intrinsics)
        axes = np.array([world_from_camera.direction(axis) for axis in _AXES])
        origin = np.array(world_from_camera.position)
        rgb = np.empty((len(rays), 3), dtype=np.uint8)
        rgb[:] = self._background
        ranges = np.full(len(rays), np.inf)
        for plane in self._planes:
            self._draw_plane(int(plane), origin, axes, rays, intrinsics, rgb, ranges)
        pixels = self._covered(origin, axes, intrinsics)
        if len(pixels):
            self._draw_solids(pixels, origin, axes, rays, intrinsics, rgb, ranges)
        shape = (intrinsics.height_px, intrinsics.width_px)
        picture = rgb.reshape(*shape, 3)
        return Picture(picture, ranges.astype(np.float32).reshape(shape) if depth else None)

    def _draw_plane(
        self,
        geom: int,
        origin: NDArray[np.float64],
        axes: NDArray[np.float64],
        rays: NDArray[np.float64],
        intrinsics: Intrinsics,
        rgb: NDArray[np.uint8],
        ranges: NDArray[np.float64],
    ) -> None:
        """Draw one plane, seen from its front only, as MuJoCo's rays do; its light is the same everywhere."""
        frame = self._data.geom_xmat[geom].reshape(3, 3)
        seen_from = frame.T @ (origin - self._data.geom_xpos[geom])
        if not seen_from[2] > 0.0:  # nor where a body is nowhere (NaN)
            return
        # Rays have length 1 along the view axis, so what divides out here is the depth.
        falls = rays @ (axes @ frame[:, 2])
        with np.errstate(divide="ignore"):
            depths = np.where(falls < 0.0, -seen_from[2] / falls, np.inf)
        hit = (depths >= intrinsics.near_m) & (depths <= intrinsics.far_m) & (depths < ranges)
        half = self._model.geom_size[geom]
        if half[0] > 0 or half[1] > 0:
            inside = np.flatnonzero(hit)
            across = rays[inside] @ (axes @ frame[:, :2]) * depths[inside, None] + seen_from[:2]
            hit[inside] = (np.abs(across) <= np.where(half[:2] > 0, half[:2], np.inf)).all(axis=1)
        rgb[hit] = self._shade(np.array([geom]), frame[:, 2][None])[0]
        ranges[hit] = depths[hit]

    def _covered(self, origin: NDArray[np.float64], axes: NDArray[np.float64], intrinsics: Intrinsics) -> _Indices:
        """The pixels that some solid may be seen in: the rectangles around their boxes, cut off at the near plane."""
        rotations = self._data.geom_xmat[self._solids].reshape(-1, 3, 3)
        world = np.einsum("nij,nkj->nki", rotations, self._corners) + self._data.geom_xpos[self._solids][:, None]
        corners = (world - origin) @ axes.T
        near = intrinsics.near_m
        a, b = corners[:, _EDGES[:, 0]], corners[:, _EDGES[:, 1]]
        with np.errstate(divide="ignore", invalid="ignore"):
            share = (near - a[..., :1]) / (b[..., :1] - a[..., :1])
            cuts = a + share * (b - a)
            points = np.concatenate([corners, cuts], axis=1)
            points[~((points[..., 0] >= near * (1 - 1e-9)) & np.isfinite(points).all(axis=-1))] = np.nan
            cut_outside = ~((share[..., 0] >= 0.0) & (share[..., 0] <= 1.0))
            points[:, 8:][cut_outside] = np.nan
            slopes = points[..., 1:] / points[..., :1]
        seen = ~np.isnan(slopes[..., 0]).all(axis=1)
        width, height, focal = intrinsics.width_px, intrinsics.height_px, intrinsics.focal_px
        middle = np.array([width / 2, height / 2])
        first = middle - focal * np.nanmax(slopes[seen], axis=1) - 1.0
        last = middle - focal * np.nanmin(slopes[seen], axis=1) + 2.0
        bounds = np.clip(np.hstack([first, last]), 0, [width, height, width, height]).astype(int)
        mask = np.zeros((height, width), dtype=bool)
        for left, top, right, bottom in bounds.tolist():
            mask[top:bottom, left:right] = True
        return np.flatnonzero(mask)

    def _draw_solids(
        self,
        pixels: _Indices,
        origin: NDArray[np.float64],
        axes: NDArray[np.float64],
        rays: NDArray[np.float64],
        intrinsics: Intrinsics,
        rgb: NDArray[np.uint8],
        ranges: NDArray[np.float64],
    ) -> None:
        """Draw what the rays through these pixels meet, where it is nearer than what is drawn."""
        directions = rays[pixels] @ axes
        count = len(pixels)
        geoms = np.empty(count, dtype=np.int32)
        depths = np.empty(count)
        normals = np.empty((count, 3))
        mujoco.mj_multiRay(
            self._model,
            self._data,
            origin,
            directions.reshape(-1),
            _SOLIDS,
            True,
            -1,
            geoms,
            depths,
            normals.reshape(-1),
            count,
            mujoco.mjMAXVAL,
        )
        nearer = (geoms >= 0) & (depths >= intrinsics.near_m) & (depths <= intrinsics.far_m) & (depths < ranges[pixels])
        rgb[pixels[nearer]] = self._shade(geoms[nearer], normals[nearer])
        ranges[pixels[nearer]] = depths[nearer]

    def _shade(self, geoms: NDArray[np.int32] | _Indices, normals: NDArray[np.float64]) -> NDArray[np.uint8]:
        """Lambert's law for each light, over the ambient light."""
        colour = self._ambient[geoms]
        for to_light, lit in zip(self._to_lights, self._lit, strict=True):
            facing = np.maximum(normals @ to_light, 0.0).astype(np.float32)
            colour += lit[geoms] * facing[:, None]
        return np.minimum(colour, np.float32(255.0)).astype(np.uint8)


def _is_drawn(shape: Shape) -> bool:
    """Glass is looked through, as rays know no half-seen shapes; a mesh without any area is nothing to see."""
    return shape.rgba[3] >= 0.5 and not (isinstance(shape.geometry, Mesh) and _area(shape.geometry) == 0.0)


def _area(mesh: Mesh) -> float:
    """[m²]"""
    a, b, c = (mesh.vertices[mesh.faces[:, i]].astype(float) for i in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2


@lru_cache(maxsize=16)
def _rays(intrinsics: Intrinsics) -> NDArray[np.float64]:
    """Directions through the pixels' centres in the camera frame, (pixels, 3) row by row, each of length 1 along x."""
    focal = intrinsics.focal_px
    columns = (np.arange(intrinsics.width_px) + 0.5 - intrinsics.width_px / 2) / focal
    rows = (np.arange(intrinsics.height_px) + 0.5 - intrinsics.height_px / 2) / focal
    y, z = np.meshgrid(-columns, -rows)
    return np.stack([np.ones_like(y), y, z], axis=-1).reshape(-1, 3).astype(np.float64)


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
            geom.group = _PLANE_GROUP
            geom.quat = (pose @ Pose(quaternion=upright(normal))).quaternion
        case Mesh(vertices, faces):
            # MuJoCo wants four corners at least, though a triangle has three.
            vertices = np.concatenate([vertices, vertices[: max(0, 4 - len(vertices))]])
            spec.add_mesh(
                name=name,
                uservert=vertices.reshape(-1).astype(float),
                userface=faces.reshape(-1),
                inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
            )
            geom.type, geom.meshname = mujoco.mjtGeom.mjGEOM_MESH, name
