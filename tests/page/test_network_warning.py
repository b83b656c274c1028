"""Warning about listening on other addresses than loopback."""

import pytest

from trundle.page.network_warning import warn_of_network


@pytest.mark.parametrize(
    ("host", "count"), [("127.0.0.1", 0), ("localhost", 0), ("::1", 0), ("0.0.0.0", 1), ("10.0.0.3", 1)]
)
def test_only_hosts_beyond_loopback_are_warned_about(host: str, count: int) -> None:
    lines: list[str] = []

    warn_of_network(host, lines.append)

    assert len(lines) == count
    assert all(host in line for line in lines)
