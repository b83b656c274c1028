"""Debian's ROS 1 tools and rospy against our graph, and our nodes against Debian's master."""

import os
import re
import signal
import socket
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from trundle.ros import Node, WallClock
from trundle.ros.xmlrpc.rpc_client import call, call_value

pytestmark = [
    pytest.mark.real_ros,
    pytest.mark.skipif(not Path("/usr/bin/rostopic").exists(), reason="Debian's ROS 1 tools are not installed"),
]
PATIENCE_S = 100.0
"""rospy alone takes a second to import on a busy machine."""


class Real:
    """Runs programs of the installed ROS in a clean environment."""

    def __init__(self, uri: str, home: Path) -> None:
        self._environment = {
            "PATH": "/usr/bin:/bin",
            "HOME": str(home),
            "ROS_MASTER_URI": uri,
            "ROS_IP": "127.0.0.1",
            "ROS_DISTRO": "noetic",
            "PYTHONUNBUFFERED": "1",
            "PYTHONWARNINGS": "ignore",
        }

    def run(self, command: str, *arguments: str) -> str:
        """Run a tool to its end; return its standard output."""
        done = subprocess.run(
            [f"/usr/bin/{command}", *arguments],
            env=self._environment,
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    @contextmanager
    def started(self, command: str, *arguments: str) -> Iterator["subprocess.Popen[str]"]:
        """Run a tool until the end of the block, then kill it."""
        with subprocess.Popen(
            [f"/usr/bin/{command}", *arguments],
            env=self._environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        ) as process:
            try:
                yield process
            finally:
                process.send_signal(signal.SIGKILL)


@pytest.fixture
def real(graph: Any, tmp_path: Path) -> Real:
    return Real(graph.core.uri, tmp_path)


@pytest.fixture
def talker(graph: Any) -> Node:
    node: Node = graph.node("talker", params={"rate": 20})
    node.advertise("/chatter", "std_msgs/String", latch=True).publish({"data": "hello"})
    graph.ready(node)
    return node


def test_rostopic_lists_and_describes(real: Real, talker: Node) -> None:
    assert real.run("rostopic", "list").split() == ["/chatter", "/rosout", "/rosout_agg"]
    assert " * /chatter [std_msgs/String] 1 publisher\n" in real.run("rostopic", "list", "-v")
    assert f"Type: std_msgs/String\n\nPublishers: \n * /talker ({talker.uri})" in real.run(
        "rostopic", "info", "/chatter"
    )


def test_rostopic_echoes(real: Real, talker: Node) -> None:
    assert real.run("rostopic", "echo", "-n1", "/chatter") == 'data: "hello"\n---\n'


def test_rostopic_measures(graph: Any, real: Real) -> None:
    publisher = graph.node("ticker").advertise("/tick", "std_msgs/Empty")

    async def tick() -> None:
        while True:
            publisher.publish({})
            await WallClock().sleep(0.02)

    ticking = graph.loop.spawn(tick())
    with real.started("rostopic", "hz", "/tick") as process:
        assert process.stdout is not None
        lines = iter(process.stdout.readline, "")
        assert any("subscribed to [/tick]" in line for line in lines)
        rate = next(m for line in lines if (m := re.match(r"average rate: ([\d.]+)", line)))
    ticking.cancel()
    assert float(rate[1]) > 0


@pytest.mark.parametrize("arguments", [["-1"], ["-r", "20"]], ids=["once", "rate"])
def test_rostopic_publishes_to_a_node(graph: Any, real: Real, arguments: list[str]) -> None:
    got: list[float] = []
    node = graph.node("n")
    node.subscribe("/cmd_vel", "geometry_msgs/Twist", lambda m: got.append(m.linear.x))
    graph.ready(node)
    with real.started("rostopic", "pub", *arguments, "/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.5}}"):
        graph.until(lambda: got)
    assert got[0] == 0.5


def test_rosnode_lists_describes_and_pings(real: Real, talker: Node) -> None:
    assert real.run("rosnode", "list").split() == ["/rosout", "/talker"]
    text = real.run("rosnode", "info", "/talker")
    assert " * /chatter [std_msgs/String]\n * /rosout [rosgraph_msgs/Log]" in text
    assert " * /talker/get_loggers\n * /talker/set_logger_level" in text
    assert f"contacting node {talker.uri} ...\nPid: {os.getpid()}\n" in text
    assert f"xmlrpc reply from {talker.uri}" in real.run("rosnode", "ping", "-c", "1", "/talker")


def test_rosnode_shows_connections_over_sockets(graph: Any, real: Real, talker: Node) -> None:
    with real.started("rostopic", "echo", "/chatter") as process:
        assert process.stdout is not None
        assert process.stdout.readline() == 'data: "hello"\n'
        text = real.run("rosnode", "info", "/talker")
    link = re.search(
        r"topic: /chatter\n    \* to: /rostopic_\S+\n    \* direction: outbound \(\d+ - 127.0.0.1:\d+\) \[\d+\]", text
    )
    assert link, text


def test_rosparam_reads_and_writes(real: Real, talker: Node) -> None:
    assert real.run("rosparam", "get", "/talker/rate") == "20\n"
    real.run("rosparam", "set", "/a", "{b: 1, c: [x, 2.5, true]}")
    assert real.run("rosparam", "get", "/a") == "b: 1\nc:\n- x\n- 2.5\n- true\n\n"
    assert "/a/b\n/a/c\n" in real.run("rosparam", "list")
    real.run("rosparam", "delete", "/a/b")
    assert "a:\n  c:\n" in real.run("rosparam", "dump")


def test_rosservice_calls(real: Real, graph: Any, talker: Node) -> None:
    talker.advertise_service("~enable", "std_srvs/SetBool", lambda r: {"success": r.data, "message": "hi"})
    graph.ready(talker)
    assert 'name: "rosout"\n    level: "info"' in real.run("rosservice", "call", "/talker/get_loggers")
    assert real.run("rosservice", "call", "/talker/enable", "true") == 'success: True\nmessage: "hi"\n'
    assert real.run("rosservice", "type", "/talker/enable") == "std_srvs/SetBool\n"


ROSPY = """
import rospy, std_msgs.msg, std_srvs.srv, sensor_msgs.msg
rospy.init_node("real")
publisher = rospy.Publisher("up", std_msgs.msg.String, queue_size=10)
def echo(message):
    kind = message._connection_header["type"]
    publisher.publish(f"{message.name} {list(message.position)} {message.header.seq} {kind}")
rospy.Subscriber("down", sensor_msgs.msg.JointState, echo)
def answer(request):
    ours = rospy.ServiceProxy("/ours", std_srvs.srv.Trigger, persistent=True)
    return std_srvs.srv.SetBoolResponse(request.data, ours().message + ours().message)
rospy.Service("real_service", std_srvs.srv.SetBool, answer)
rospy.loginfo("real node is up")
rospy.spin()
"""


def test_a_rospy_node_publishes_subscribes_serves_and_calls(graph: Any, real: Real) -> None:
    node = graph.node("ours")
    got: list[str] = []
    logs: list[str] = []
    publisher = node.advertise("/down", "sensor_msgs/JointState")
    node.subscribe("/up", "std_msgs/String", lambda m: got.append(m.data))
    node.subscribe("/rosout_agg", "rosgraph_msgs/Log", lambda m: logs.append(m.name))
    node.advertise_service("/ours", "std_srvs/Trigger", lambda _: {"success": True, "message": "x"})
    graph.ready(node)
    with real.started("python3", "-c", ROSPY):
        graph.loop.run(node.wait_for_service("/real_service"), PATIENCE_S)
        answer = graph.loop.run(node.call_service("/real_service", "std_srvs/SetBool", {"data": True}), PATIENCE_S)
        assert (answer.success, answer.message) == (True, "xx")
        graph.until(lambda: publisher.has_subscribers)

        def is_echoed() -> bool:
            publisher.publish({"name": ["a"], "position": [1.5]})
            return bool(got)

        graph.until(is_echoed)
        assert re.fullmatch(r"\['a'\] \[1\.5\] \d+ sensor_msgs/JointState", got[0])
        assert ["/up", "std_msgs/String"] in graph.loop.run(_topics(node))
    graph.until(lambda: not publisher.has_subscribers)


NODE_CALLS: list[tuple[Any, ...]] = [
    ("getName",),
    ("getName", 3),
    ("getName", "/x"),
    ("getMasterUri", "/x"),
    ("getPid", "/x", 1),
    ("getSubscriptions", "/x"),
    ("requestTopic", "/x", "/up"),
    ("requestTopic", "/x", "", [["TCPROS"]]),
    ("requestTopic", "/x", 5, [["TCPROS"]]),
    ("requestTopic", "/x", "a:b", [["TCPROS"]]),
    ("requestTopic", "/x", "/up", []),
    ("requestTopic", "/x", "/up", [["UDPROS", "", "host", 1, 1500]]),
    ("requestTopic", "/x", "/nope", [["TCPROS"]]),
    ("publisherUpdate", "/x", "/down"),
    ("publisherUpdate", "/x", "/down", 3),
    ("publisherUpdate", "/x", "/down", [3]),
    ("publisherUpdate", "/x", "/down", ["here"]),
    ("publisherUpdate", "/x", "/down", []),
    ("paramUpdate", "/x", 3, 3),
    ("paramUpdate", "/x", "relative", 3),
    ("paramUpdate", "/x", "/nobody_watches", 3),
]


def test_a_node_answers_slave_api_calls_like_rospys(graph: Any, real: Real) -> None:
    node = graph.node("ours")
    node.advertise("/up", "std_msgs/String")
    node.subscribe("/down", "sensor_msgs/JointState", lambda _: None)
    graph.ready(node)

    def answers(name: str) -> list[Any]:
        uri = graph.loop.run(call_value(node.master_uri, "lookupNode", "/x", name))
        results = [[*words, *graph.loop.run(call(uri, *words))] for words in NODE_CALLS]
        return [str(result).replace(name, "NAME") for result in results]

    with real.started("python3", "-c", ROSPY):
        graph.loop.run(node.wait_for_service("/real_service"), PATIENCE_S)
        assert answers("/ours") == answers("/real")


def test_a_roscpp_node_that_prefers_udpros_gets_tcpros(graph: Any, real: Real) -> None:
    if not Path("/usr/lib/topic_tools/relay").exists():
        pytest.skip("Debian's topic-tools is not installed")
    node = graph.node("talker")
    node.advertise("/a", "std_msgs/String", latch=True).publish({"data": "over TCP"})
    got: list[str] = []
    node.subscribe("/copy", "std_msgs/String", lambda m: got.append(m.data))
    graph.ready(node)
    with real.started("../lib/topic_tools/relay", "/a", "/copy", "_unreliable:=true"):
        graph.until(lambda: got)
    assert got[0] == "over TCP"


async def _topics(node: Node) -> list[list[str]]:
    return await call_value(node.master_uri, "getPublishedTopics", node.name, "")


def test_nodes_work_with_debians_rosmaster(graph: Any, tmp_path: Path) -> None:
    if not Path("/usr/bin/rosmaster").exists():
        pytest.skip("Debian's python3-rosmaster is not installed")
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    uri = f"http://127.0.0.1:{port}"
    with Real(uri, tmp_path).started("rosmaster", "--core", "-p", str(port)):
        one, two = (Node(name, loop=graph.loop, master_uri=uri) for name in ("one", "two"))
        got: list[str] = []
        publisher = one.advertise("/a", "std_msgs/String")
        two.subscribe("/a", "std_msgs/String", lambda m: got.append(m.data))
        graph.until(lambda: publisher.has_subscribers)
        publisher.publish({"data": "hi"})
        graph.until(lambda: got == ["hi"])
        graph.loop.run(one.params.set("/x", {"y": 1}), PATIENCE_S)
        assert graph.loop.run(two.params.get("/x/y"), PATIENCE_S) == 1
        for node in (one, two):
            graph.loop.run(node.shutdown(), PATIENCE_S)
