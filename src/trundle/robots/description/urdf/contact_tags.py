"""Contact parameters in the <gazebo> block of a link."""

from msgspec.structs import replace

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Collision

from ..sdf.context import Context

_NUMBERS = {"mu1": "mu", "mu2": "mu2", "kp": "kp", "kd": "kd", "minDepth": "min_depth", "maxVel": "max_vel"}
"""Tag → field of Surface."""
CONTACT_TAGS = ("collision", "fdir1", "laserRetro", "maxContacts", *_NUMBERS)


def with_contact_tags(collision: Collision, block: XmlNode, context: Context) -> Collision:
    """Return a collision with the values of its link's block, which apply to every collision of the link.

    <collision> is applied first, wherever it is: its <surface> replaces the whole surface; the other tags then change
    single values (sdformat's InsertSDFExtensionCollision).
    """
    for node in block.all("collision"):
        from ..sdf.link import with_contact  # lazy: few robots have such a block

        collision = with_contact(collision, node, context)
    surface = collision.surface
    values: dict[str, object] = {
        field: node.as_number(default=getattr(surface, field))
        for tag, field in _NUMBERS.items()
        if (node := last_value(block.all(tag))) is not None
    }
    node = last_value(block.all("fdir1"))
    if node is not None and (direction := node.as_numbers(3)) is not None:
        values["fdir1"] = tuple(direction)
    collision = replace(collision, surface=replace(surface, **values))
    if (node := last_value(block.all("laserRetro"))) is not None:
        collision = replace(collision, laser_retro=node.as_number(default=collision.laser_retro))
    if (node := last_value(block.all("maxContacts"))) is not None:
        collision = replace(collision, max_contacts=int(node.as_number(default=collision.max_contacts)))
    return collision


def last_value(nodes: list[XmlNode]) -> XmlNode | None:
    """Return the last of several elements of one tag; old files have `value="…"` instead of text (sdformat's
    GetKeyValueAsString).
    """
    return nodes[-1].with_text_of("value") if nodes else None
