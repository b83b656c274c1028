"""Notice of the meshes that a world names and that were not found."""

from trundle.robots.model import MeshFile, World

_MOST_NAMES = 12


def missing_meshes(world: World) -> str | None:
    """Return how many meshes of visuals are missing, and which; None if all were found."""
    geometries = (visual.geometry for model in world.models for link in model.links for visual in link.visuals)
    missing = sorted({each.uri for each in geometries if isinstance(each, MeshFile) and each.path is None})
    if not missing:
        return None
    count = "1 mesh is missing" if len(missing) == 1 else f"{len(missing)} meshes are missing"
    more = f" and {len(missing) - _MOST_NAMES} more" if len(missing) > _MOST_NAMES else ""
    return f"{count}: {', '.join(missing[:_MOST_NAMES])}{more}"
