"""Warning of listening beyond loopback."""

from collections.abc import Callable

from trundle.base.http.page_address import is_loopback


def warn_of_network(host: str, say: Callable[[str], None]) -> None:
    """Warn that a host other than loopback opens the robot to every machine that reaches it."""
    if not is_loopback(host):
        say(f"listening on {host}: ROS 1 has no passwords; any machine that reaches it can drive the robot")
