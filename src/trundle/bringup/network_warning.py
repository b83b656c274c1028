"""Says what it means to listen beyond this machine."""

from collections.abc import Callable

from trundle.page_address import is_loopback


def warn_of_network(host: str, say: Callable[[str], None]) -> None:
    """Say, once, that a host other than loopback opens the robot to everybody who reaches it."""
    if not is_loopback(host):
        say(f"listening on {host}: ROS 1 has no passwords; whoever reaches it can drive the robot")
