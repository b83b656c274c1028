"""Reader of COLLADA scenes through pycollada: transformed triangles per material."""

import io
from collections.abc import Iterator
from typing import Any
from urllib.parse import unquote

import numpy as np
from msgspec import Struct, field
from numpy.typing import NDArray

from trundle.base.diagnostics import DescriptionError
from trundle.base.xmlnode import XmlNode, parse_xml

from ..mesh import MeshError, Rgba
from ..raw import MAX_TRIANGLES, RawPart, at_corners, triangle_fans, used_vertices
from .skin import read_skin

_MAX_DEPTH = 64
_MAX_NODES = 100_000
"""Maximum number of visited nodes; a small file can instantiate nodes repeatedly and expand without bound."""
_Material = tuple[Rgba | None, str | None]
_Corners = NDArray[np.float32] | None
_Triangles = list[tuple[str, NDArray[np.float64], NDArray[np.int64], _Corners, _Corners, NDArray[np.int64]]]
"""Per material: symbol, vertices (N, 3), faces (M, 3), corner uv (M, 3, 2) and normals (M, 3, 3), and indices of the
vertices in the geometry (N,).
"""


def read_collada(data: bytes, *, skins: bool = False) -> list[RawPart]:
    """Read a COLLADA file; lengths are converted to metres by its <unit>.

    Its <up_axis> is ignored: Gazebo (gazebo-classic#1305) and RViz (rviz#1045) never read it, and published robots look
    right in them.

    Args:
        data: contents of the file.
        skins: also read the vertices' bone weights, in the file's own unit.

    Raises:
        MeshError: the file is not well-formed, or has no scene.
        Exception: any other exception of pycollada.
    """
    import collada
    from collada.common import DaeError, DaeMalformedError

    if data[:2] == b"PK":
        raise MeshError("a zipped COLLADA file; unpack it")
    try:
        document: Any = collada.Collada(io.BytesIO(data), ignore=[DaeError])
    except DaeMalformedError:
        read_tree(data)
        raise
    scene = document.scene or (document.scenes[0] if document.scenes else None)
    if scene is None:
        raise MeshError("no scene")
    walk = _SceneWalk(float(document.assetInfo.unitmeter or 1.0), skins)
    return [part for node in scene.nodes for part in walk.parts(node, np.eye(4), "", 0)]


def read_tree(data: bytes) -> XmlNode:
    """Parse a COLLADA file to XML elements.

    Raises:
        MeshError: the file is not well-formed.
    """
    try:
        return parse_xml(data, name="")
    except DescriptionError as error:
        raise MeshError(f"line {error.at.line}: {error.what}") from None


class _SceneWalk(Struct):
    """Traversal of a scene with its totals."""

    metres: float
    skins: bool
    nodes: int = 0
    triangles: int = 0
    geometries: dict[int, _Triangles] = field(default_factory=dict[int, _Triangles])

    def parts(self, node: Any, world_from_parent: NDArray[np.float64], name: str, depth: int) -> Iterator[RawPart]:
        self.nodes += 1
        if depth > _MAX_DEPTH or self.nodes > _MAX_NODES:
            raise MeshError("recursive nodes, or too many of them")
        if hasattr(node, "geometry"):
            yield from self._geometry(node.geometry, node.materials, world_from_parent, name)
        elif hasattr(node, "controller"):
            skin = node.controller
            matrix = getattr(skin, "bind_shape_matrix", None)
            bound = world_from_parent if matrix is None else world_from_parent @ np.asarray(matrix).reshape(4, 4)
            yield from self._geometry(
                skin.geometry, node.materials, bound, name, skin if self.skins and matrix is not None else None
            )
        elif hasattr(node, "children"):
            world_from_node = world_from_parent @ np.asarray(node.matrix, dtype=np.float64)
            element = getattr(node, "node", node).xmlnode
            for child in node.children:
                yield from self.parts(
                    child, world_from_node, element.get("name") or element.get("id") or name, depth + 1
                )

    def _geometry(
        self, geometry: Any, materials: Any, world_from_node: NDArray[np.float64], name: str, skin: Any = None
    ) -> Iterator[RawPart]:
        targets = {str(binding.symbol): binding.target for binding in materials or ()}
        if id(geometry) not in self.geometries:
            self.geometries[id(geometry)] = _triangles(geometry)
        normals_from_node = np.linalg.pinv(world_from_node[:3, :3]).astype(np.float32)  # normals are rows
        for symbol, vertices, faces, uv, normals, used in self.geometries[id(geometry)]:
            self.triangles += len(faces)
            if self.triangles > MAX_TRIANGLES:
                raise MeshError(f"more than {MAX_TRIANGLES} triangles")
            rgba, texture = _material(targets.get(symbol))
            outwards = -1 if np.linalg.det(world_from_node[:3, :3]) < 0 else 1
            yield RawPart(
                names=tuple(str(binding) for binding in (name, geometry.name, geometry.id) if binding),
                vertices=(vertices @ world_from_node[:3, :3].T + world_from_node[:3, 3]) * self.metres,
                faces=faces[:, ::outwards],
                rgba=rgba,
                texture=texture if uv is not None else None,
                tint=(1.0, 1.0, 1.0, 1.0 if rgba is None else rgba[3]),
                uv=None if uv is None else uv[:, ::outwards],
                normals=None if normals is None else normals[:, ::outwards] @ normals_from_node,
                skin=None if skin is None else read_skin(skin, vertices, used),
            )


def _triangles(geometry: Any) -> _Triangles:
    result: _Triangles = []
    for primitive in geometry.primitives:
        if primitive.vertex is None or primitive.vertex_index is None or not len(primitive.vertex_index):
            continue
        corners = np.asarray(primitive.vertex_index, dtype=np.int64)
        triangles = None
        if hasattr(primitive, "vcounts"):
            triangles = triangle_fans(corners.ravel(), np.asarray(primitive.vcounts, dtype=np.int64))
            corners = corners.ravel()[triangles]
        if corners.ndim != 2 or corners.shape[1] != 3:
            continue  # lines have no faces
        uv = normals = None
        if len(primitive.texcoordset):
            uv = _corners(primitive.texcoordset[0], primitive.texcoord_indexset[0], corners, triangles, 2)
        if primitive.normal is not None and primitive.normal_index is not None:
            normals = _corners(primitive.normal, primitive.normal_index, corners, triangles, 3)
        points = np.asarray(primitive.vertex, dtype=np.float64)
        result.append((str(primitive.material), *used_vertices(points, corners), uv, normals, np.unique(corners)))
    return result


def _corners(
    values: Any, indices: Any, corners: NDArray[np.int64], triangles: NDArray[np.int64] | None, size: int
) -> _Corners:
    numbers = np.asarray(indices, dtype=np.int64)
    numbers = numbers if triangles is None else numbers.ravel()[triangles]
    return at_corners(np.asarray(values, dtype=np.float64), numbers, size) if numbers.shape == corners.shape else None


def _material(material: Any) -> _Material:
    """Return the visible color and the texture's path."""
    effect = getattr(material, "effect", None)
    if effect is None:
        return None, None
    shade = effect.emission if effect.shadingtype == "constant" else effect.diffuse
    sampler = getattr(shade, "sampler", None)
    if sampler is not None:
        image = getattr(getattr(sampler, "surface", None), "image", None)
        path = unquote(str(image.path)).removeprefix("file://") if image is not None else None
        return (0.8, 0.8, 0.8, _opacity(effect)), path
    if shade is None:
        return None, None
    values = [min(max(float(value), 0.0), 1.0) for value in shade]
    r, g, b, a = (*values, 1.0)[:4] if len(values) >= 3 else (0.8, 0.8, 0.8, 1.0)
    return (r, g, b, a * _opacity(effect)), None


def _opacity(effect: Any) -> float:
    """Return the opacity by COLLADA's two rules; some exporters write 0 for opaque."""
    transparent = effect.transparent
    if transparent is None or not hasattr(transparent, "__len__") or len(transparent) < 3:
        return 1.0
    amount = effect.transparency if isinstance(effect.transparency, float) else 1.0
    if effect.opaque_mode == "RGB_ZERO":
        r, g, b = (float(value) for value in transparent[:3])
        opacity = 1.0 - (0.212671 * r + 0.715160 * g + 0.072169 * b) * amount
    else:
        opacity = (float(transparent[3]) if len(transparent) > 3 else 1.0) * amount
    return opacity if 0.05 < opacity < 1.0 else 1.0
