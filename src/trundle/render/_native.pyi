from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

class Kind:
    PLANE: ClassVar[Kind]
    BOX: ClassVar[Kind]
    SPHERE: ClassVar[Kind]
    CYLINDER: ClassVar[Kind]
    CAPSULE: ClassVar[Kind]
    ELLIPSOID: ClassVar[Kind]
    MESH: ClassVar[Kind]

class Mesh:
    def __init__(self, vertices: NDArray[np.float32], faces: NDArray[np.int32]) -> None: ...

class Shape:
    def __init__(
        self,
        kind: Kind,
        *,
        body: int,
        mesh: int = -1,
        size: Sequence[float],
        body_from_shape: Sequence[float],
        colour: Sequence[float],
    ) -> None: ...

class Light:
    def __init__(self, *, direction: Sequence[float], diffuse: Sequence[float]) -> None: ...

class Renderer:
    def __init__(
        self,
        *,
        bodies: int,
        meshes: Sequence[Mesh],
        shapes: Sequence[Shape],
        lights: Sequence[Light],
        ambient: Sequence[float],
        background: Sequence[float],
    ) -> None: ...
    def update(self, poses: NDArray[np.float64]) -> None: ...
    def render(
        self,
        world_from_camera: Sequence[float],
        *,
        focal: float,
        near: float,
        far: float,
        rgb: NDArray[np.uint8],
        depth: NDArray[np.float32] | None = None,
        segmentation: NDArray[np.int32] | None = None,
    ) -> None: ...

def instruction_set() -> str: ...
