"""A graph on IPv6 alone."""

import socket
import subprocess
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from tests.ros.conftest import PATIENCE_S, Graph

from trundle.ros import Core, GraphLoop, MasterProxy, Messages, Node, RosError, host_and_port, uri_host


@pytest.fixture
def ipv6_graph(messages: Messages) -> Iterator[Graph]:
    with suppress(OSError), socket.create_server(("::1", 0), family=socket.AF_INET6):
        with GraphLoop(messages=messages) as loop:
            core = Core(loop, port=0, host="::1")
            loop.run(core.start(), PATIENCE_S)
            yield Graph(loop, core)
            loop.run(core.stop(), PATIENCE_S)
        return
    pytest.skip("this machine has no IPv6")


def test_messages_and_services_work_over_ipv6(ipv6_graph: Graph, messages: Messages) -> None:
    got: list[str] = []
    with GraphLoop(messages=messages) as other:
        talker, listener = (
            ipv6_graph.node("talker", host="::1"),
            Node("listener", loop=other, master_uri=ipv6_graph.core.uri, host="::1"),
        )
        talker.advertise("/a", "std_msgs/String", latch=True).publish({"data": "six"})
        talker.advertise_service("~ask", "std_srvs/Trigger", lambda _: {"success": True})
        ipv6_graph.ready(talker)
        listener.subscribe("/a", "std_msgs/String", lambda m: got.append(m.data))
        ipv6_graph.until(lambda: got == ["six"])
        assert other.run(listener.call_service("/talker/ask", "std_srvs/Trigger"), PATIENCE_S).success
        assert listener.uri.startswith("http://[::1]:")


def test_the_blocking_proxy_reaches_the_master(ipv6_graph: Graph) -> None:
    proxy: Any = MasterProxy(ipv6_graph.core.uri)
    assert proxy.call("getUri") == ipv6_graph.core.uri


@pytest.mark.parametrize(
    ("uri", "host", "port"),
    [
        ("http://::1:41234/", "::1", 41234),
        ("http://[::1]:41234/", "::1", 41234),
        ("http://fe80::1%eth0:80", "fe80::1%eth0", 80),
        ("rosrpc://2001:db8::7:65535", "2001:db8::7", 65535),
        ("http://Robot:11311/RPC2", "robot", 11311),
    ],
)
def test_the_last_colon_separates_the_port(uri: str, host: str, port: int) -> None:
    """rospy writes IPv6 addresses without brackets."""
    assert host_and_port(uri) == (host, port)
    assert uri_host(uri) == host


@pytest.mark.parametrize(
    "uri", ["", "http://", "http://::1", "http://[::1]", "http://a:65536/", "http://[::1:5/", "a:1"]
)
def test_invalid_addresses_are_refused(uri: str) -> None:
    with pytest.raises(RosError, match="not a node's address"):
        host_and_port(uri)
    assert uri_host(uri) == ""


ROSPY = """
import rospy, std_msgs.msg, std_srvs.srv
rospy.init_node("bare")
up = rospy.Publisher("up", std_msgs.msg.String, queue_size=10, latch=True)
rospy.Subscriber("down", std_msgs.msg.String, lambda m: up.publish(m.data + "!"))
rospy.Service("ask", std_srvs.srv.Trigger, lambda _: std_srvs.srv.TriggerResponse(True, "six"))
rospy.spin()
"""


@pytest.mark.real_ros
@pytest.mark.skipif(not Path("/usr/bin/rostopic").exists(), reason="Debian's ROS 1 tools are not installed")
def test_a_rospy_node_with_an_address_without_brackets_is_reached(ipv6_graph: Graph, tmp_path: Path) -> None:
    node, got = ipv6_graph.node("ours", host="::1"), list[str]()
    node.subscribe("/up", "std_msgs/String", lambda m: got.append(m.data))
    node.advertise("/down", "std_msgs/String", latch=True).publish({"data": "hi"})
    env = {"ROS_MASTER_URI": ipv6_graph.core.uri, "ROS_IPV6": "on", "ROS_IP": "::1", "HOME": str(tmp_path)}
    with subprocess.Popen(["/usr/bin/python3", "-c", ROSPY], env=env, stderr=subprocess.DEVNULL) as process:
        try:
            ipv6_graph.loop.run(node.wait_for_service("/ask"), PATIENCE_S)
            answer = ipv6_graph.loop.run(node.call_service("/ask", "std_srvs/Trigger"), PATIENCE_S)
            assert answer.message == "six"
            ipv6_graph.until(lambda: got == ["hi!"])
            proxy = MasterProxy(ipv6_graph.core.uri)
            assert str(proxy.call("lookupNode", "/bare")).startswith("http://::1:")
        finally:
            process.kill()
