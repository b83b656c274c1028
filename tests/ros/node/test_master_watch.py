"""Nodes whose master is killed and started again."""

from typing import Any

import pytest
from tests.graphs import PATIENCE_S, free_port, until

from trundle.ros import Core, GraphLoop, MasterProxy, Node

STRING = "std_msgs/String"


@pytest.fixture(autouse=True)
def _frequent_look_ups(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.ros.node.master_watch._PERIOD_S", 0.1)


def _core(loop: GraphLoop, port: int) -> Core:
    core = Core(loop, port=port)
    loop.run(core.start(), PATIENCE_S)
    return core


def test_nodes_go_on_without_their_master_and_register_again(capfd: pytest.CaptureFixture[str]) -> None:
    got: list[str] = []
    changes: list[object] = []
    with GraphLoop() as talking, GraphLoop() as listening:
        with GraphLoop() as mastering:
            core = _core(mastering, free_port())  # where no other test's master begins once it has ended
            uri, port = core.uri, core.port
            talker = Node("talker", loop=talking, master_uri=uri, params={"gain": 3}, rosout=False)
            listener = Node("listener", loop=listening, master_uri=uri, rosout=False)
            publisher = talker.advertise("/a", STRING)
            talker.advertise_service("/ask", "std_srvs/Empty", lambda _: {})
            listener.subscribe("/a", STRING, lambda message: got.append(message.data))
            listening.run(listener.params.watch("/rate", lambda _, value: changes.append(value)), PATIENCE_S)
            until(lambda: publisher.has_subscribers)
            talking.run(talker.wait_registered(), PATIENCE_S)
            listening.run(listener.wait_registered(), PATIENCE_S)
            mastering.run(core.stop(), PATIENCE_S)
        output = ""

        def is_logged(text: str) -> bool:
            nonlocal output
            output += capfd.readouterr().err
            return text in output

        until(lambda: is_logged("/talker goes on without it") and is_logged("/listener goes on without it"))
        publisher.publish({"data": "without"})
        until(lambda: got == ["without"])
        with GraphLoop() as mastering:
            core = _core(mastering, port)
            master = MasterProxy(uri)

            def state() -> Any:
                return [
                    {name: nodes for name, nodes in part if name in ("/a", "/ask")}
                    for part in master.call("getSystemState")
                ]

            until(lambda: state() == [{"/a": ["/talker"]}, {"/a": ["/listener"]}, {"/ask": ["/talker"]}])
            until(lambda: is_logged("/talker registers again"))
            until(lambda: master.call("hasParam", "/talker/gain"))
            publisher.publish({"data": "again"})
            until(lambda: got == ["without", "again"])

            def is_notified() -> bool:
                master.call("setParam", "/rate", len(changes))
                return bool(changes)

            until(is_notified)
            late = Node("late", loop=mastering, master_uri=uri, rosout=False)
            late.advertise("/a", STRING, latch=True).publish({"data": "late"})
            until(lambda: got[-1] == "late")
            assert not is_logged("/late goes on without it")
            assert output.count("goes on without it") == 2
            talking.stop()
            listening.stop()
            mastering.run(core.stop(), PATIENCE_S)


def test_waiting_for_registration_ends_when_the_node_shuts_down() -> None:
    with GraphLoop() as loop:
        node = Node("alone", loop=loop, master_uri="http://127.0.0.1:1/", rosout=False)
        node.advertise("/a", STRING)
        waiting = loop.spawn(node.wait_registered())
        loop.run(node.shutdown())
        waiting.result(PATIENCE_S)
        loop.run(node.wait_registered(), PATIENCE_S)
