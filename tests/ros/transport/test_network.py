"""Addresses that nodes advertise."""

import pytest

from trundle.ros.transport.network import server_address


def test_advertised_addresses_resolve_to_the_bound_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ROS_HOSTNAME", raising=False)
    monkeypatch.setenv("ROS_IP", "localhost")
    assert server_address().advertise == "localhost"
    monkeypatch.setenv("ROS_IP", "192.0.2.1")
    assert server_address().advertise == "127.0.0.1"
    assert "192.0.2.1" in (server_address().warning or "")
    assert server_address("0.0.0.0").advertise == "192.0.2.1"
    monkeypatch.setenv("ROS_IP", "::1")
    assert (server_address().bind, server_address().authority(5)) == ("::1", "[::1]:5")
    assert server_address("127.0.0.1").bind == "127.0.0.1"
