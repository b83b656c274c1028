"""Names of collisions and visuals that Gazebo makes from a URDF; contact sensors refer to them."""

_LUMPED = "_fixed_joint_lump__"


def shape_name(lump: str, source: str, kind: str, number: int) -> str:
    """Return Gazebo's name of a shape (sdformat's CreateCollisions and CreateCollision).

    Args:
        lump: link that carries the shape.
        source: the shape's own name, or that of its link.
        kind: "collision" or "visual".
        number: of the shape among those of its kind in the lump, from 0.
    """
    name = f"{source}_{kind}_{number}" if number else f"{source}_{kind}"
    return name if name.startswith(lump) else f"{lump}{_LUMPED}{name}"


def is_lumped_name(name: str) -> bool:
    """Return False for the name of a lumped shape that begins like its new link: to Gazebo it is the link's own."""
    return _LUMPED in name
