"""State of plugins and controllers, to be put back in place while all else goes on."""

from collections.abc import Iterable

from .inside import is_outside
from .saved_objects import SavedObjects

_ROOMS = ("gazebo.plugins.", "sim.control.")


def save_plugins(plugins: Iterable[object]) -> SavedObjects:
    """Save what plugins remember, by the objects or methods that lead to it.

    Handles, sensors, nodes and publishers, which they share with others, are left as they are.
    """
    return SavedObjects(plugins, is_outside=is_outside, is_shared=_is_shared)


def _is_shared(each: object) -> bool:
    room, _, rest = type(each).__module__.partition(".")
    return room == "trundle" and not f"{rest}.".startswith(_ROOMS)
