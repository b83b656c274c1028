"""The room's public face."""

import pytest

import trundle.names
import trundle.ros
from trundle.ros.transport.network import server_address


def test_every_public_name_is_there_once() -> None:
    assert set(trundle.ros.__all__) == set(trundle.ros._HOMES)
    for room in (trundle.ros, trundle.names):
        assert len(set(room.__all__)) == len(room.__all__)
        for name in room.__all__:
            assert getattr(room, name) is not None


def test_addresses_given_out_lead_to_where_a_server_listens(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ROS_HOSTNAME", raising=False)
    monkeypatch.setenv("ROS_IP", "localhost")
    assert server_address().advertise == "localhost"
    monkeypatch.setenv("ROS_IP", "192.0.2.1")
    assert server_address().advertise == "127.0.0.1"
    assert "192.0.2.1" in (server_address().warning or "")
    assert server_address("0.0.0.0").advertise == "192.0.2.1"
    monkeypatch.setenv("ROS_IP", "::1")
    assert (server_address().bind, server_address().at(5)) == ("::1", "[::1]:5")
    assert server_address("127.0.0.1").bind == "127.0.0.1"
