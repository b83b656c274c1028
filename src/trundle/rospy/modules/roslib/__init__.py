"""Old base library: `load_manifest`, and where packages are."""

from .launcher import load_manifest as load_manifest

_is_interactive = False


def set_interactive(interactive: bool) -> None:
    """Declare that this is an interactive shell, whose signals rospy leaves alone."""
    global _is_interactive
    _is_interactive = interactive


def is_interactive() -> bool:
    """True in an interactive shell."""
    return _is_interactive
