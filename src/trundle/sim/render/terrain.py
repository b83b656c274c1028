"""Terrain with painted layers."""

from io import BytesIO

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from trundle.base.diagnostics import Diagnostics, Source
from trundle.robots.meshes import Mesh, MeshError, MeshPart, read_heights, terrain_mesh
from trundle.robots.model import Heightmap, TerrainLayer
from trundle.spatial import Vector3

from .textures import load_texture

_MAX_SAMPLES = 257
"""Maximum number of height samples per side."""
_SIDE_PX = 1024
"""Size of the texture over the whole terrain [px]."""


def painted_terrain(terrain: Heightmap, at: Source, report: Diagnostics) -> Mesh | None:
    """Return terrain with its layers as one texture; None with a warning if it cannot be drawn."""
    assert terrain.path is not None
    try:
        heights = read_heights(terrain.path, max_samples=_MAX_SAMPLES)
    except MeshError as error:
        report.warn(at, f"heightmap {terrain.uri!r}: {error}; it is not drawn", error.id)
        return None
    mesh = terrain_mesh(heights, terrain.size)
    image = _painted(heights, terrain.size, terrain.layers, at, report)
    parts = () if image is None else (MeshPart(name="layers", first_face=0, face_count=len(mesh.faces), texture=image),)
    return Mesh(
        mesh.vertices + np.array(terrain.position, dtype=np.float32),
        mesh.faces,
        uv=mesh.uv,
        normals=mesh.normals,
        parts=parts,
    )


def _painted(
    heights: NDArray[np.float32], size: Vector3, layers: tuple[TerrainLayer, ...], at: Source, report: Diagnostics
) -> bytes | None:
    picture: NDArray[np.float32] | None = None
    large = Image.fromarray(heights).resize((_SIDE_PX, _SIDE_PX), Image.Resampling.BILINEAR)
    above = np.asarray(large)[..., None] * np.float32(size[2])
    for layer in layers:
        if layer.diffuse is None:
            continue
        image = load_texture(layer.diffuse)
        if isinstance(image, str):
            report.warn(
                at, f"heightmap texture {layer.diffuse.name} cannot be read: {image}; the layer is left out", "texture"
            )
            continue
        colors = _repeated(image, layer.size, size)
        if picture is None:
            picture = colors
            continue
        weight = np.clip((above - layer.from_height) / max(layer.fade, 1e-6), 0.0, 1.0)
        picture = np.asarray(picture + weight * (colors - picture), dtype=np.float32)
    if picture is None:
        return None
    file = BytesIO()
    Image.fromarray(np.rint(picture).astype(np.uint8)).save(file, "BMP")
    return file.getvalue()


def _repeated(image: NDArray[np.uint8], side_m: float, size: Vector3) -> NDArray[np.float32]:
    """Return an image tiled over the terrain, (px, px, 3), upper edge first, at the texture's resolution."""
    side_m = side_m if side_m > 0.0 else size[0]
    wide, high = (min(max(round(_SIDE_PX * side_m / size[axis]), 1), image.shape[1 - axis]) for axis in (0, 1))
    tile = np.asarray(Image.fromarray(image).resize((wide, high), Image.Resampling.BOX), dtype=np.float32)
    middles = (np.arange(_SIDE_PX) + 0.5) / _SIDE_PX
    columns = ((middles * size[0] / side_m) % 1.0 * wide).astype(int)
    rows = high - 1 - ((middles[::-1] * size[1] / side_m) % 1.0 * high).astype(int)
    return tile[rows[:, None], columns]
