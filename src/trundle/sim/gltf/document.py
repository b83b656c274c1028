"""Document of glTF 2.0 (Khronos): its JSON, and the bytes of its meshes and images, each stored once.

A GLB may embed the bytes; otherwise they are separate files, named by their content, which documents share.
"""

import json
from collections.abc import Callable, Hashable, Mapping

import numpy as np
from numpy.typing import NDArray

from trundle.robots.meshes import Texture

from .images import EncodedImage, encode_image
from .packing import FLOAT, PackedTriangles, content_name

_LINEAR, _MIPMAPPED = 9729, 9987


class Document:
    """Document under construction."""

    def __init__(self, *, embed: bool) -> None:
        """Start an empty document.

        Args:
            embed: put meshes and images into `glb`; False: into `files`.
        """
        self._embed = embed
        self._lists: dict[str, list[Mapping[str, object]]] = {}
        self._indices: dict[tuple[str, Hashable], int] = {}
        self._lights: list[Mapping[str, object]] = []
        self._binary = bytearray()
        self._extensions: set[str] = set()
        self.files: dict[str, bytes] = {}
        """Name → content of each file next to the document."""

    def add(self, kind: str, item: Mapping[str, object]) -> int:
        """Append to a list of the document, such as `nodes`; return the index."""
        items = self._lists.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    def shared(self, kind: str, key: Hashable, make: Callable[[], Mapping[str, object]]) -> int:
        """Return the index of the item of a list with this key; add it if there is none."""
        if (kind, key) not in self._indices:
            self._indices[kind, key] = self.add(kind, make())
        return self._indices[kind, key]

    def use(self, extension: str) -> None:
        """List an extension as used."""
        self._extensions.add(extension)

    def add_light(self, light: Mapping[str, object]) -> int:
        """Append a light of KHR_lights_punctual; return the index."""
        self.use("KHR_lights_punctual")
        self._lights.append(light)
        return len(self._lights) - 1

    def mesh(self, triangles: PackedTriangles, material: int) -> int:
        """Return the index of a mesh; meshes of the same triangles share their accessors."""

        def make() -> dict[str, object]:
            first = self._indices.get(("triangles", triangles.name))
            if first is None:
                first = self._indices["triangles", triangles.name] = self._add_arrays(triangles)
            attributes = {array.attribute: first + i for i, array in enumerate(triangles.arrays) if array.attribute}
            primitive = {"attributes": attributes, "indices": first, "material": material}
            return {"primitives": [primitive | {"extras": {"content": triangles.name}}]}

        return self.shared("meshes", (triangles.name, material), make)

    def _add_arrays(self, triangles: PackedTriangles) -> int:
        """Add the accessors of triangles, indices first; return the index of the first accessor."""
        buffer, start = self._add_bytes(triangles.name, triangles.data)
        first = len(self._lists.get("accessors", []))
        for array in triangles.arrays:
            view = {"buffer": buffer, "byteOffset": start + array.offset, "byteLength": array.size}
            number = self.add("bufferViews", view | {"target": array.target})
            self.add("accessors", {"bufferView": number} | array.accessor)
        return first

    def _add_bytes(self, name: str, data: bytes) -> tuple[int, int]:
        """Add bytes; return the index of their buffer, and their offset in it."""
        if self._embed:
            return 0, self._append(data)
        uri = f"{name}.bin"
        self.files[uri] = data
        return self.add("buffers", {"uri": uri, "byteLength": len(data)}), 0

    def matrices(self, matrices: NDArray[np.float64]) -> int:
        """Return the index of an accessor of matrices (N, 4, 4)."""
        return self._accessor(matrices.transpose(0, 2, 1), "MAT4")  # glTF's are column by column

    def numbers(self, rows: NDArray[np.float64], *, bounded: bool = False) -> int:
        """Return the index of an accessor of numbers (N,), or of vectors (N, 3) or (N, 4); equal ones are shared.

        Args:
            rows: values.
            bounded: write the smallest and the largest value, required for the times of an animation.
        """
        kind = "SCALAR" if rows.ndim == 1 else f"VEC{rows.shape[1]}"
        key = (rows.astype("<f4").tobytes(), kind, bounded)
        if ("numbers", key) not in self._indices:
            single = rows.astype(np.float32)
            bounds: dict[str, object] = {}
            if bounded:
                bounds = {"min": [float(single.min())], "max": [float(single.max())]}
            self._indices["numbers", key] = self._accessor(rows, kind, bounds)
        return self._indices["numbers", key]

    def _accessor(self, rows: NDArray[np.float64], kind: str, bounds: dict[str, object] | None = None) -> int:
        data = rows.astype("<f4").tobytes()
        buffer, start = self._add_bytes(content_name(data), data)
        view = self.add("bufferViews", {"buffer": buffer, "byteOffset": start, "byteLength": len(data)})
        fields: dict[str, object] = {"bufferView": view, "componentType": FLOAT, "count": len(rows), "type": kind}
        return self.add("accessors", fields | (bounds or {}))

    def body_nodes(self) -> dict[int, int]:
        """Return the node of each body, by its `extras.body`."""
        nodes: dict[int, int] = {}
        for index, node in enumerate(self._lists.get("nodes", [])):
            extras = node.get("extras")
            if isinstance(extras, dict) and "body" in extras:
                nodes[extras["body"]] = index
        return nodes

    def texture(self, texture: Texture) -> int | None:
        """Return the index of a texture; None if its image cannot be read."""
        image = encode_image(texture)
        if image is None:
            return None
        name = content_name(image.data)
        source = self.shared("images", name, lambda: self._image(name, image))
        sampler = self.shared("samplers", "", lambda: {"magFilter": _LINEAR, "minFilter": _MIPMAPPED})
        return self.shared("textures", source, lambda: {"sampler": sampler, "source": source})

    def _image(self, name: str, image: EncodedImage) -> dict[str, object]:
        if not self._embed:
            self.files[name + image.suffix] = image.data
            return {"uri": name + image.suffix}
        view = {"buffer": 0, "byteOffset": self._append(image.data), "byteLength": len(image.data)}
        return {"bufferView": self.add("bufferViews", view), "mimeType": image.mime}

    def _append(self, data: bytes) -> int:
        offset = len(self._binary)
        self._binary += data + bytes(-len(data) % 4)
        return offset

    def glb(self, root: int) -> bytes:
        """Return the document as a binary glTF; `root` is its only root node."""
        tree: dict[str, object] = {"asset": {"version": "2.0", "generator": "Trundle"}, "scene": 0}
        tree |= {"scenes": [{"nodes": [root]}], **self._lists}
        if self._binary:
            tree["buffers"] = [{"byteLength": len(self._binary)}]
        if self._extensions:
            tree["extensionsUsed"] = sorted(self._extensions)
        if self._lights:
            tree["extensions"] = {"KHR_lights_punctual": {"lights": self._lights}}
        text = json.dumps(tree, separators=(",", ":"), allow_nan=False).encode()
        chunks = _chunk(b"JSON", text + b" " * (-len(text) % 4))
        if self._binary:
            chunks += _chunk(b"BIN\0", self._binary)
        return b"glTF" + _uint(2) + _uint(12 + len(chunks)) + chunks


def _chunk(kind: bytes, data: bytes | bytearray) -> bytes:
    return _uint(len(data)) + kind + data


def _uint(value: int) -> bytes:
    return value.to_bytes(4, "little")
