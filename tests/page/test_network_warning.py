"""Listening beyond loopback is warned of."""

import pytest

from trundle.page.network_warning import warn_of_network


@pytest.mark.parametrize(
    ("host", "said"), [("127.0.0.1", 0), ("localhost", 0), ("::1", 0), ("0.0.0.0", 1), ("10.0.0.3", 1)]
)
def test_only_an_open_host_is_said(host: str, said: int) -> None:
    lines: list[str] = []

    warn_of_network(host, lines.append)

    assert len(lines) == said
    assert all(host in line for line in lines)
