"""`trundle node`, with rosnode's output."""

import os
import subprocess
import sys
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from tests.app.cli.conftest import PATIENCE_S

from trundle.ros import MasterProxy, open_bag

STRING = "std_msgs/String"


def test_nodes_are_listed_with_and_without_addresses(graph: Any) -> None:
    node = graph.node("driver", namespace="/r")
    graph.ready(node)
    assert graph.trundle("node", "list") == (0, "/r/driver\n/rosout\n", "")
    assert graph.trundle("node", "list", "/r")[1] == "/r/driver\n"
    assert graph.trundle("node", "list", "-u", "/r")[1] == f"{node.uri}\n"
    assert graph.trundle("node", "list", "-a", "/r")[1] == f"{node.uri} \t/r/driver\n"


def test_a_node_is_described_as_by_rosnode(graph: Any) -> None:
    node, other = graph.node("one"), graph.node("two")
    graph.ready(node)
    publisher = node.advertise("/a", STRING)
    other.subscribe("/a", STRING, print)
    node.subscribe("/b", STRING, print)
    graph.until(lambda: publisher.has_subscribers)
    graph.until(lambda: len(node.endpoints.connections()) == 2)
    graph.ready(node)

    code, out, _ = graph.trundle("node", "info", "/one")

    assert code == 0
    assert out == (
        "-" * 80 + "\nNode [/one]\nPublications: \n"
        " * /a [std_msgs/String]\n * /rosout [rosgraph_msgs/Log]\n\n"
        "Subscriptions: \n * /b [unknown type]\n\n"
        "Services: \n * /one/get_loggers\n * /one/set_logger_level\n\n"
        f"\ncontacting node {node.uri} ...\nPid: {os.getpid()}\nConnections:\n"
        " * topic: /rosout\n    * to: /rosout\n    * direction: outbound\n    * transport: INTRAPROCESS\n"
        " * topic: /a\n    * to: /two\n    * direction: outbound\n    * transport: INTRAPROCESS\n\n"
    )


def test_an_unknown_node_is_an_error(graph: Any) -> None:
    code, _, error = graph.trundle("node", "info", "/nobody")
    assert (code, error) == (1, "cannot contact [/nobody]: unknown node\n")
    assert graph.trundle("node", "kill", "/nobody") == (1, "", "ERROR: Unknown node(s):\n * /nobody\n")
    assert graph.trundle("node", "ping", "/nobody")[0] == 1


def test_nodes_are_pinged(graph: Any) -> None:
    code, out, _ = graph.trundle("node", "ping", "-c", "1", "/rosout")
    assert code == 0
    assert out.startswith(
        "rosnode: node is [/rosout]\npinging /rosout with a timeout of 3.0s\nxmlrpc reply from http://"
    )
    assert graph.trundle("node", "ping", "-a")[1].startswith("Will ping the following nodes: \n * /rosout\n\n")


def test_a_node_is_killed(graph: Any) -> None:
    node = graph.node("victim")
    graph.ready(node)
    assert graph.trundle("node", "kill", "/victim")[:2] == (0, "killing /victim\nkilled\n")
    graph.until(lambda: node.closed.is_set())
    assert graph.trundle("node", "list")[1] == "/rosout\n"


def test_the_node_to_kill_is_prompted_for(graph: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    node = graph.node("victim")
    graph.ready(node)

    monkeypatch.setattr("sys.stdin", StringIO("no\n3\n"))
    code, out, error = graph.trundle("node", "kill")
    assert (code, out.count("ERROR: please enter a number from 1 to 2")) == (1, 2)
    assert "standard input ended before there was an answer" in error

    monkeypatch.setattr("sys.stdin", StringIO("2\n"))
    code, out, _ = graph.trundle("node", "kill")
    assert code == 0
    assert out == (
        "1. /rosout\n2. /victim\n\nPlease enter the number of the node you wish to kill.\n> killing /victim\nkilled\n"
    )
    graph.until(lambda: node.closed.is_set())


def test_cleanup_without_an_answer_exits_with_1(graph: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    MasterProxy(graph.core.uri, "/gone").call("registerPublisher", "/a", STRING, "http://127.0.0.1:9/")
    monkeypatch.setattr("sys.stdin", StringIO(""))
    assert graph.trundle("node", "cleanup")[0] == 1


def test_machines_are_listed(graph: Any) -> None:
    assert graph.trundle("node", "machine")[1] == "127.0.0.1\n"
    assert graph.trundle("node", "machine", "127.0.0.1")[1] == "/rosout\n"


@pytest.mark.parametrize(
    "command",
    ["topic pub -r 10 /chatter std_msgs/String x", "topic echo /chatter", "tf echo a b", "bag record -a -O a.bag"],
)
def test_a_command_ends_when_its_node_is_killed(graph: Any, tmp_path: Path, command: str) -> None:
    words = [sys.executable, "-m", "trundle", *command.split(), "__name:=tool"]
    node = graph.node("talker")
    node.advertise("/chatter", STRING, latch=True).publish({"data": "hello"})
    graph.ready(node)
    with subprocess.Popen(words, cwd=tmp_path, stdout=subprocess.DEVNULL) as process:
        try:
            graph.until(lambda: "/tool" in graph.trundle("node", "list")[1])
            if "record" in words:
                graph.until(lambda: b"hello" in (tmp_path / "a.bag.active").read_bytes())
            assert graph.trundle("node", "kill", "/tool")[:2] == (0, "killing /tool\nkilled\n")
            assert process.wait(PATIENCE_S) == 0
        finally:
            process.kill()
    if "record" in words:
        with open_bag(tmp_path / "a.bag") as bag:
            assert "/chatter" in [connection.topic for connection in bag.connections]
