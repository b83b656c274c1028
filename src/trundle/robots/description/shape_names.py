"""Names of collisions and visuals that Gazebo makes from a URDF; contact sensors refer to them."""

_LUMPED = "_fixed_joint_lump__"


def shape_name(lump: str, source: str, kind: str, number: int) -> str:
    """Return Gazebo's name of a shape (sdformat's CreateCollisions and CreateCollision).

    Args:
        lump: link that carries the shape.
        source: name of the shape, or of its link if it has none.
        kind: "collision" or "visual".
        number: index among the lump's shapes of that kind, from 0.
    """
    name = f"{source}_{kind}_{number}" if number else f"{source}_{kind}"
    return name if name.startswith(lump) else f"{lump}{_LUMPED}{name}"


def is_lumped_name(name: str) -> bool:
    """True if a shape was lumped from another link, which Gazebo tells by the name."""
    return _LUMPED in name
