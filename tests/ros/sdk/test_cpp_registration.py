"""Registrations of C++ nodes, whose answers may be late."""

import threading
from xmlrpc.client import ServerProxy
from xmlrpc.server import SimpleXMLRPCServer

import pytest
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import Running

from trundle.ros import Messages
from trundle.ros.xmlrpc.rpc_client import call_value

pytestmark = pytest.mark.slow


def test_an_answer_that_is_older_than_an_update_drops_no_publisher(
    running: Running, graph: Graph, messages: Messages
) -> None:
    """The master's answer to a registration may arrive after the update of a publisher that came since."""
    talker = graph.node("talker")
    echoed: list[str] = []
    talker.subscribe("/echo", "std_msgs/String", lambda message: echoed.append(message.data))
    graph.ready(talker)

    class LateMaster:
        def _dispatch(self, method: str, arguments: tuple[object, ...]) -> object:
            with ServerProxy(graph.core.uri) as master:
                answer = getattr(master, method)(*arguments)
            if method == "registerSubscriber" and arguments[1] == "/words":
                words = talker.advertise("/words", "std_msgs/String", latch=True)
                words.publish(messages.new("std_msgs/String", {"data": "world"}))
                # The node hears of the talker, and connects.
                uri = str(arguments[3])
                until(lambda: "/words" in [row[4] for row in graph.loop.run(call_value(uri, "getBusInfo", "/test"))])
            return answer

    with SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False, allow_none=True) as proxy:
        proxy.register_instance(LateMaster())
        thread = threading.Thread(target=proxy.serve_forever)
        thread.start()
        running.environment["ROS_MASTER_URI"] = f"http://127.0.0.1:{proxy.server_address[1]}/"
        running.start("add_two_ints_server", "_greeting:=good day")
        until(lambda: echoed)
        proxy.shutdown()
        thread.join()
    assert echoed[0] == "good day world"
