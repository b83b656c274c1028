from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

class ShapeKind:
    PLANE: ClassVar[ShapeKind]
    BOX: ClassVar[ShapeKind]
    SPHERE: ClassVar[ShapeKind]
    CYLINDER: ClassVar[ShapeKind]
    CAPSULE: ClassVar[ShapeKind]
    ELLIPSOID: ClassVar[ShapeKind]
    MESH: ClassVar[ShapeKind]

class LightKind:
    DIRECTIONAL: ClassVar[LightKind]
    POINT: ClassVar[LightKind]
    SPOT: ClassVar[LightKind]

class FogKind:
    NONE: ClassVar[FogKind]
    LINEAR: ClassVar[FogKind]
    EXPONENTIAL: ClassVar[FogKind]
    SQUARED: ClassVar[FogKind]

class Mesh:
    def __init__(
        self,
        vertices: NDArray[np.float32],
        faces: NDArray[np.int32],
        *,
        uv: NDArray[np.float32] | None = None,
        normals: NDArray[np.float32] | None = None,
    ) -> None: ...

class Texture:
    def __init__(self, rgb: NDArray[np.uint8]) -> None: ...

class Material:
    def __init__(
        self,
        *,
        ambient: Sequence[float],
        diffuse: Sequence[float],
        specular: Sequence[float],
        emissive: Sequence[float],
        shininess: float,
        opacity: float,
        texture: int = -1,
        repeat: Sequence[float] = (1.0, 1.0),
    ) -> None: ...

class Shape:
    def __init__(
        self,
        kind: ShapeKind,
        *,
        body: int,
        mesh: int = -1,
        size: Sequence[float],
        body_from_shape: Sequence[float],
        material: Material,
        casts_shadow: bool = True,
    ) -> None: ...

class Light:
    def __init__(
        self,
        kind: LightKind,
        *,
        body: int = -1,
        position: Sequence[float],
        direction: Sequence[float],
        diffuse: Sequence[float],
        specular: Sequence[float],
        attenuation: Sequence[float],
        range: float,
        inner_angle: float,
        outer_angle: float,
        falloff: float,
        casts_shadows: bool,
    ) -> None: ...

class Fog:
    def __init__(self, kind: FogKind, *, color: Sequence[float], start: float, end: float, density: float) -> None: ...

class Renderer:
    def __init__(
        self,
        *,
        bodies: int,
        meshes: Sequence[Mesh],
        textures: Sequence[Texture],
        shapes: Sequence[Shape],
        lights: Sequence[Light],
        ambient: Sequence[float],
        horizon: Sequence[float],
        zenith: Sequence[float],
        fog: Fog | None = None,
        threads: int = 1,
    ) -> None: ...
    def update(self, poses: NDArray[np.float64]) -> None: ...
    def set_mesh(self, index: int, mesh: Mesh) -> None: ...
    def set_material(self, shape: int, material: Material) -> None: ...
    def set_lighting(
        self, lights: Sequence[Light], *, ambient: Sequence[float], horizon: Sequence[float], zenith: Sequence[float]
    ) -> None: ...
    def render(
        self,
        world_from_cameras: Sequence[Sequence[float]],
        *,
        lenses: Sequence[Sequence[float]],
        rgb: NDArray[np.uint8],
        depth: NDArray[np.float32] | None = None,
        segmentation: NDArray[np.int32] | None = None,
    ) -> None: ...
    def cast_rays(
        self,
        world_from_origin: Sequence[float],
        directions: NDArray[np.float64],
        max_range: float,
        exclude: int,
        ranges: NDArray[np.float64],
        shapes: NDArray[np.int32],
        /,
    ) -> None: ...

def instruction_set() -> str: ...
def add_depth_noise(depths: NDArray[np.float32], *, seed: int, mean: float, stddev: float) -> None: ...
def add_color_noise(rgb: NDArray[np.uint8], *, seed: int, mean: float, stddev: float) -> None: ...
def clip_depths(depths: NDArray[np.float32], *, near: float, far: float, clipped: NDArray[np.float32]) -> None: ...
def fill_cloud(
    points: NDArray[np.float32],
    *,
    depth: NDArray[np.float32],
    rgb: NDArray[np.uint8],
    right: NDArray[np.float32],
    down: NDArray[np.float32],
) -> None: ...
