"""Files referenced by a mesh."""

from pathlib import Path

from .load import load_mesh, material_libraries
from .mesh import MeshError

_ENDINGS = frozenset({".dae", ".glb", ".obj", ".stl"})


def referenced_files(path: Path) -> set[Path]:
    """Return the textures and material libraries of a mesh; none for an unreadable mesh or another file."""
    if path.suffix.lower() not in _ENDINGS:
        return set()
    try:
        parts = load_mesh(path).parts
    except MeshError:
        return set()
    return {*material_libraries(path), *(part.texture for part in parts if isinstance(part.texture, Path))}
