"""trimesh's exporter with one return type."""

from typing import Any

import trimesh


def exported(shape: trimesh.Trimesh | trimesh.Scene, file_type: str, **options: Any) -> bytes:
    """Return the content of a mesh file; `options` are the exporter's own."""
    data = shape.export(file_type=file_type, **options)
    if isinstance(data, str):
        return data.encode()
    assert isinstance(data, bytes)
    return data
