"""State of plugins and controllers, restored in place while the rest continues."""

from collections.abc import Iterable

from .inside import is_outside
from .saved_objects import SavedObjects

_ROOMS = ("gazebo.plugins.", "sim.control.")


def save_plugins(plugins: Iterable[object]) -> SavedObjects:
    """Save the state of plugins, reachable from objects or methods.

    Handles, sensors, nodes and publishers, which are shared, are not restored.
    """
    return SavedObjects(plugins, is_outside=is_outside, is_shared=_is_shared)


def _is_shared(obj: object) -> bool:
    room, _, rest = type(obj).__module__.partition(".")
    return room == "trundle" and not f"{rest}.".startswith(_ROOMS)
