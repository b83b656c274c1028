"""A graph on IPv6 alone."""

import socket
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import pytest
from tests.ros.conftest import PATIENCE_S, Graph

from trundle.ros import Core, GraphLoop, MasterProxy, Messages, Node


@pytest.fixture
def six(messages: Messages) -> Iterator[Graph]:
    with suppress(OSError), socket.create_server(("::1", 0), family=socket.AF_INET6):
        with GraphLoop(messages=messages) as loop:
            core = Core(loop, port=0, host="::1")
            loop.run(core.start(), PATIENCE_S)
            yield Graph(loop, core)
            loop.run(core.stop(), PATIENCE_S)
        return
    pytest.skip("this machine has no IPv6")


def test_messages_services_and_parameters_work(six: Graph, messages: Messages) -> None:
    got: list[str] = []
    with GraphLoop(messages=messages) as other:
        talker, far = six.node("talker", host="::1"), Node("far", loop=other, master_uri=six.core.uri, host="::1")
        talker.advertise("/a", "std_msgs/String", latch=True).publish({"data": "six"})
        talker.advertise_service("~ask", "std_srvs/Trigger", lambda _: {"success": True})
        six.ready(talker)
        far.subscribe("/a", "std_msgs/String", lambda m: got.append(m.data))
        six.until(lambda: got == ["six"])
        assert other.run(far.call_service("/talker/ask", "std_srvs/Trigger"), PATIENCE_S).success
        assert far.uri.startswith("http://[::1]:")


def test_light_commands_reach_it(six: Graph) -> None:
    proxy: Any = MasterProxy(six.core.uri)
    assert proxy.call("getUri") == six.core.uri
