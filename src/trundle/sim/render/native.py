"""Trundle's own renderer, on the CPU in C++, without GPU or display."""

from collections.abc import Callable, Sequence
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from trundle.base.built import refuse_stale
from trundle.robots.meshes import Mesh, Texture
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Fog, Plane, Sphere
from trundle.spatial import Pose, rotation_from_z

from . import _native
from .renderer import Intrinsics, Picture, size_of
from .scene import DEFAULT_LIGHTS, Scene, SceneLight, Shape
from .textures import load_texture

refuse_stale(_native)

_THINNEST = 1e-4
"""Smallest thickness of a shape [m]."""
_LIGHTS = {
    "directional": _native.LightKind.DIRECTIONAL,
    "point": _native.LightKind.POINT,
    "spot": _native.LightKind.SPOT,
}
_FOGS = {
    "linear": _native.FogKind.LINEAR,
    "exponential": _native.FogKind.EXPONENTIAL,
    "quadratic": _native.FogKind.SQUARED,
}
_INDEX = np.dtype(np.int32)


Key = TypeVar("Key")
Item = TypeVar("Item")


class _Registry(Generic[Key, Item]):
    """Objects shared by shapes, each created once."""

    def __init__(self) -> None:
        self._numbers: dict[Key, int] = {}
        self.items: list[Item] = []

    def __contains__(self, key: Key) -> bool:
        return key in self._numbers

    def number(self, key: Key, make: Callable[[], Item]) -> int:
        if key not in self._numbers:
            self._numbers[key] = len(self.items)
            self.items.append(make())
        return self._numbers[key]


class NativeRenderer:
    """`Renderer` by exact ray intersection of primitives and rasterisation of meshes."""

    def __init__(self, scene: Scene, *, threads: int = 1, textures: Sequence[Texture] = ()) -> None:
        """Pass a scene to C++.

        Args:
            scene: shapes and lights.
            threads: number of threads that share the rows of all images of a call, at most 64; results are independent.
            textures: further textures, for shapes in `restyle`.
        """
        meshes = _Registry[int, _native.Mesh]()
        self._textures = _Registry[Texture, _native.Texture]()
        for texture in textures:
            self._texture_number(texture)

        def native(shape: Shape) -> _native.Shape:
            geometry, mesh = shape.geometry, -1
            if isinstance(geometry, Mesh):
                mesh = meshes.number(id(geometry), lambda: _native_mesh(geometry))
            return _native_shape(shape, mesh, self._material(shape))

        shapes = [native(shape) for shape in scene.shapes]
        self._meshes = {
            number: (meshes.number(id(shape.geometry), _no_mesh), shape.geometry)
            for number, shape in enumerate(scene.shapes)
            if isinstance(shape.geometry, Mesh)
        }
        """Shape number → mesh number in C++ and the initial mesh."""
        self._scene = scene
        horizon, zenith = scene.sky or (scene.background, scene.background)
        self._renderer = _native.Renderer(
            bodies=len(scene.bodies),
            meshes=meshes.items,
            textures=self._textures.items,
            shapes=shapes,
            lights=[_native_light(light) for light in scene.lights or DEFAULT_LIGHTS],
            ambient=scene.ambient[:3],
            horizon=horizon[:3],
            zenith=zenith[:3],
            fog=_native_fog(scene.fog),
            threads=threads,
        )

    def _texture_number(self, texture: Texture) -> int:
        """Return the number of a texture in C++; −1 if it cannot be read."""

        def native() -> _native.Texture:
            assert isinstance(image, np.ndarray)
            return _native.Texture(image)

        image = None if texture in self._textures else load_texture(texture)
        return -1 if isinstance(image, str) else self._textures.number(texture, native)

    def _material(self, shape: Shape) -> _native.Material:
        return _native.Material(
            ambient=(shape.ambient or shape.rgba)[:3],
            diffuse=shape.rgba[:3],
            specular=shape.specular[:3],
            emissive=shape.emissive[:3],
            shininess=shape.shininess,
            opacity=shape.rgba[3],
            texture=-1 if shape.texture is None else self._texture_number(shape.texture),
            repeat=tuple(1.0 / scale if scale else 1.0 for scale in shape.texture_scale),
        )

    def restyle(self, scene: Scene) -> None:
        """Use the materials, lights, ambient light and background of a scene with the same shapes.

        Args:
            scene: scene with textures that were passed to the constructor.
        """
        for number, (old, new) in enumerate(zip(self._scene.shapes, scene.shapes, strict=True)):
            if old is not new:
                self._renderer.set_material(number, self._material(new))
        horizon, zenith = scene.sky or (scene.background, scene.background)
        self._renderer.set_lighting(
            [_native_light(light) for light in scene.lights or DEFAULT_LIGHTS],
            ambient=scene.ambient[:3],
            horizon=horizon[:3],
            zenith=zenith[:3],
        )
        self._scene = scene

    def update(self, poses: NDArray[np.float64]) -> None:
        """See `Renderer.update`."""
        self._renderer.update(np.ascontiguousarray(poses, dtype=np.float64))

    def set_vertices(self, shape: int, vertices: NDArray[np.float32]) -> None:
        """See `Renderer.set_vertices`."""
        number, mesh = self._meshes[shape]
        self._renderer.set_mesh(number, _native_mesh(mesh.with_vertices(vertices)))

    def render(
        self, views: Sequence[tuple[Pose, Intrinsics]], *, depth: bool = False, segmentation: bool = False
    ) -> list[Picture]:
        """See `Renderer.render`."""
        # One allocation: the memory of many small images would go back to the system after each call.
        shape = (len(views), *size_of(views))
        rgb = np.empty((*shape, 3), dtype=np.uint8)
        depths = np.empty(shape, dtype=np.float32) if depth else None
        segments = np.empty(shape, dtype=np.int32) if segmentation else None
        self._renderer.render(
            [(*world_from_camera.position, *world_from_camera.quaternion) for world_from_camera, _ in views],
            lenses=[(lens.focal_px, lens.near_m, lens.far_m) for _, lens in views],
            rgb=rgb,
            depth=depths,
            segmentation=segments,
        )
        return [
            Picture(rgb[i], None if depths is None else depths[i], None if segments is None else segments[i])
            for i in range(len(views))
        ]

    def cast(
        self,
        world_from_origin: Pose,
        directions: NDArray[np.float64],
        *,
        max_range_m: float,
        exclude: int | None = None,
    ) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """Cast rays from one origin.

        Args:
            world_from_origin: frame of the origin.
            directions: (N, 3) unit vectors in that frame.
            max_range_m: largest distance.
            exclude: body that rays ignore.

        Returns:
            (N,) distances to the first shape [m], infinite without a hit; a ray that starts inside a shape does not hit
            it. (N,) indices of the shapes in the scene, −1 for none.
        """
        count = len(directions)
        ranges, shapes = np.empty(count), np.empty(count, _INDEX)
        self._renderer.cast_rays(
            (*world_from_origin.position, *world_from_origin.quaternion),
            directions,
            max_range_m,
            -1 if exclude is None else exclude,
            ranges,
            shapes,
        )
        return ranges, shapes


def _no_mesh() -> _native.Mesh:
    raise AssertionError("every mesh of the scene is registered")


def _native_mesh(mesh: Mesh) -> _native.Mesh:
    def reals(values: NDArray[np.float32]) -> NDArray[np.float32]:
        return np.ascontiguousarray(values, dtype=np.float32)

    return _native.Mesh(
        reals(mesh.vertices),
        np.ascontiguousarray(mesh.faces, dtype=np.int32),
        uv=None if mesh.uv is None else reals(mesh.uv),
        normals=None if mesh.normals is None else reals(mesh.normals),
    )


def _native_light(light: SceneLight) -> _native.Light:
    return _native.Light(
        _LIGHTS[light.kind],
        body=-1 if light.body is None else light.body,
        position=light.position,
        direction=light.direction,
        diffuse=light.diffuse[:3],
        specular=light.specular[:3],
        attenuation=light.attenuation,
        range=light.range_m,
        inner_angle=light.inner_angle_rad,
        outer_angle=light.outer_angle_rad,
        falloff=light.falloff,
        casts_shadows=light.casts_shadows,
    )


def _native_fog(fog: Fog) -> _native.Fog | None:
    kind = _FOGS.get(fog.type)
    if kind is None:
        return None
    return _native.Fog(kind, color=fog.color[:3], start=fog.start_m, end=fog.end_m, density=fog.density)


def _native_shape(shape: Shape, mesh: int, material: _native.Material) -> _native.Shape:
    pose = shape.body_from_shape
    size = (0.0, 0.0, 0.0)
    match shape.geometry:
        case Box((x, y, z)):
            kind, size = _native.ShapeKind.BOX, (_thickness(x) / 2, _thickness(y) / 2, _thickness(z) / 2)
        case Cylinder(radius, length):
            kind, size = _native.ShapeKind.CYLINDER, (_thickness(radius), _thickness(length) / 2, 0.0)
        case Capsule(radius, length):
            kind, size = _native.ShapeKind.CAPSULE, (_thickness(radius), _thickness(length) / 2, 0.0)
        case Sphere(radius):
            kind, size = _native.ShapeKind.SPHERE, (_thickness(radius), 0.0, 0.0)
        case Ellipsoid((x, y, z)):
            kind, size = _native.ShapeKind.ELLIPSOID, (_thickness(x), _thickness(y), _thickness(z))
        case Plane(normal, (width, height)):
            kind, size = _native.ShapeKind.PLANE, (width / 2, height / 2, 0.0)
            pose = pose @ Pose(quaternion=rotation_from_z(normal))
        case Mesh():
            kind = _native.ShapeKind.MESH
    return _native.Shape(
        kind,
        body=shape.body,
        mesh=mesh,
        size=size,
        body_from_shape=(*pose.position, *pose.quaternion),
        material=material,
        casts_shadow=shape.casts_shadow,
    )


def _thickness(length: float) -> float:
    return max(length, _THINNEST)
