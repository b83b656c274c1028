"""Warning about listening on other addresses than loopback."""

from collections.abc import Callable

from trundle.base.http.page_address import is_loopback


def warn_of_network(host: str, warn: Callable[[str], None]) -> None:
    """Warn that any machine that reaches a host other than loopback can drive the robot."""
    if not is_loopback(host):
        warn(f"listening on {host}: ROS 1 has no passwords; any machine that reaches it can drive the robot")
