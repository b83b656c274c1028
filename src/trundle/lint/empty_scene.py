"""Tells when a description shows nothing at all, and why: the user would look at an empty picture."""

from trundle.model import MeshFile, World, flattened


def empty_reason(world: World) -> str:
    """One sentence where visuals are written and none can be drawn, as their meshes are missing; else nothing.

    Args:
        world: what was added to it does not count.
    """
    models = [model for model in flattened(world).models if not model.added]
    shapes = [visual.geometry for model in models for link in model.links for visual in link.visuals]
    missing = [shape for shape in shapes if isinstance(shape, MeshFile) and shape.path is None]
    if not missing or len(missing) < len(shapes):
        return ""
    names = list(dict.fromkeys(shape.uri for shape in missing))
    more = f" and {len(names) - 1} more" if names[1:] else ""
    return f"nothing can be seen: none of its meshes was found ({names[0]}{more})"
