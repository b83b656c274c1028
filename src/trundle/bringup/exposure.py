"""Says what it means to listen beyond this machine."""

from collections.abc import Callable

_LOOPBACK = ("localhost", "127.", "::1")


def warn_of_exposure(host: str, say: Callable[[str], None]) -> None:
    """Say, once, that a host other than loopback opens the robot to everybody who reaches it."""
    if not host.startswith(_LOOPBACK):
        say(f"listening on {host}: ROS 1 and the page have no passwords; whoever reaches it can drive the robot")
