"""Check for descriptions that show nothing because all meshes are missing."""

from trundle.robots.model import MeshFile, World, flattened


def empty_reason(world: World) -> str:
    """Return a message if no visual can be drawn because all meshes are missing; else an empty text.

    Args:
        world: world to check, except for added models.
    """
    models = [model for model in flattened(world).models if not model.added]
    shapes = [visual.geometry for model in models for link in model.links for visual in link.visuals]
    missing = [shape for shape in shapes if isinstance(shape, MeshFile) and shape.path is None]
    if not missing or len(missing) < len(shapes):
        return ""
    names = list(dict.fromkeys(shape.uri for shape in missing))
    more = f" and {len(names) - 1} more" if names[1:] else ""
    return f"nothing is visible: none of its meshes was found ({names[0]}{more})"
