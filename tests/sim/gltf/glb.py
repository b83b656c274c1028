"""Reads a GLB without the writer's own code."""

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

_DTYPES = {5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Glb:
    """A GLB taken apart."""

    def __init__(self, data: bytes) -> None:
        magic, version, length, size, kind = struct.unpack_from("<4sII I4s", data)
        assert (magic, version, length, kind) == (b"glTF", 2, len(data), b"JSON")
        self.tree: dict[str, Any] = json.loads(data[20 : 20 + size])
        self.binary = data[20 + size + 8 :]

    def nodes(self) -> dict[str, dict[str, Any]]:
        return {node["name"]: node for node in self.tree["nodes"]}

    def view(self, number: int) -> bytes:
        view = self.tree["bufferViews"][number]
        return self.binary[view["byteOffset"] :][: view["byteLength"]]

    def array(self, number: int) -> NDArray[Any]:
        accessor = self.tree["accessors"][number]
        values = np.frombuffer(self.view(accessor["bufferView"]), _DTYPES[accessor["componentType"]])
        return values.reshape(accessor["count"], _WIDTHS[accessor["type"]])

    def attribute(self, node: str, name: str) -> NDArray[Any]:
        primitive = self.tree["meshes"][self.nodes()[node]["mesh"]]["primitives"][0]
        return self.array(primitive["attributes"][name])

    def triangles(self, node: str) -> NDArray[Any]:
        primitive = self.tree["meshes"][self.nodes()[node]["mesh"]]["primitives"][0]
        return self.array(primitive["indices"]).reshape(-1, 3)

    def material(self, node: str) -> dict[str, Any]:
        primitive = self.tree["meshes"][self.nodes()[node]["mesh"]]["primitives"][0]
        return self.tree["materials"][primitive["material"]]
