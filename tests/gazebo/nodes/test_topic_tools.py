"""Messages of any type are relayed, throttled, multiplexed and transformed."""

from itertools import pairwise

import pytest
from tests.gazebo.nodes.conftest import PATIENCE_S

from trundle.gazebo.nodes.topic_tools.throttle import BandwidthLimiter, MessageRateLimiter

STRING = "std_msgs/String"


def test_relay_forwards_messages_of_any_type(graph) -> None:
    messages = graph.listen("/out", STRING)
    graph.start("topic_tools/relay", "in out")
    graph.advertise("/in", STRING, latch=True).publish({"data": "hello"})

    graph.until(lambda: [m.data for m in messages] == ["hello"])


def test_a_lazy_relay_subscribes_only_while_it_has_subscribers(graph) -> None:
    graph.start("topic_tools/relay", "in", lazy=True)
    source = graph.advertise("/in", STRING)
    source.publish({"data": "to learn the type"})
    graph.until(lambda: not source.has_subscribers)
    messages = graph.listen("/in_relay", STRING)
    graph.until(lambda: source.has_subscribers)
    source.publish({"data": "forwarded"})

    graph.until(lambda: [m.data for m in messages] == ["forwarded"])


def test_drop_drops_x_of_y_messages(graph) -> None:
    messages = graph.listen("/in_drop", STRING)
    graph.start("topic_tools/drop", "in 1 3")
    source = graph.advertise("/in", STRING)
    source.publish({"data": "0"})
    source.publish({"data": "dropped: the type becomes known"})
    graph.until(lambda: "/in_drop" in dict(graph.loop.run(graph.client.master.call("getTopicTypes"))))
    graph.until(lambda: graph.connected("/in_drop"))
    for number in range(2, 9):
        source.publish({"data": str(number)})

    graph.until(lambda: [m.data for m in messages] == ["2", "4", "5", "7", "8"])


def test_mux_forwards_only_the_selected_topic(graph) -> None:
    messages = graph.listen("/out", STRING)
    selected = graph.listen("/mux/selected", STRING)
    graph.start("topic_tools/mux", "out a b")
    a, b = graph.advertise("/a", STRING), graph.advertise("/b", STRING)
    a.publish({"data": "dropped"})
    graph.until(lambda: graph.connected("/out"))
    a.publish({"data": "a"})
    graph.until(lambda: messages)
    assert graph.call("/mux/select", "topic_tools/MuxSelect", topic="b").prev_topic == "/a"
    a.publish({"data": "not this"})
    b.publish({"data": "b"})
    graph.until(lambda: len(messages) == 2)

    assert [m.data for m in messages] == ["a", "b"]
    assert [m.data for m in selected] == ["/a", "b"]
    assert list(graph.call("/mux/list", "topic_tools/MuxList").topics) == ["/a", "/b"]


def test_transform_computes_fields_of_fields(graph) -> None:
    messages = graph.listen("/length", "std_msgs/Float64")
    source = graph.client.advertise("/pose", "geometry_msgs/PoseStamped")
    # One word: `start` splits at spaces.
    graph.start("topic_tools/transform", "/pose/pose/position /length std_msgs/Float64 numpy.hypot(m.x,m.y)")
    graph.until(lambda: source.has_subscribers and graph.connected("/length") and graph.linked("/length"))
    source.publish({"pose": {"position": {"x": 3.0, "y": 4.0}}})

    graph.until(lambda: [m.data for m in messages] == [5.0])


@pytest.mark.parametrize(
    "command",
    [
        "relay",
        "relay a b c",
        "drop in 1",
        "drop in 1 0",
        "mux out",
        "throttle",
        "throttle messages in zero",
        "throttle messages in 0",
        "throttle bytes in 1",
        "transform a b std_msgs/String",
        "transform a b no/Type m",
        "transform a b std_msgs/String m.(",
    ],
)
def test_an_invalid_command_line_ends_the_node_with_an_error(graph, capsys, command: str) -> None:
    name, _, arguments = command.partition(" ")
    assert graph.start(f"topic_tools/{name}", arguments).result(PATIENCE_S) == 1
    assert "[ERROR]" in capsys.readouterr().err


def test_throttled_messages_are_at_least_a_period_apart() -> None:
    now = [10_000_000_000]
    gate = MessageRateLimiter(2.0, lambda: now[0])
    passed: list[int] = []
    for _ in range(100):
        if gate.allows(1):
            passed.append(now[0])
        now[0] += 100_000_000
    assert {b - a for a, b in pairwise(passed)} == {600_000_000}  # more than 500 ms, not as much

    now[0] = 1_000_000_000
    assert not gate.allows(1)  # time went back: a period counts from here
    now[0] += 500_000_001
    assert gate.allows(1)


def test_bytes_are_throttled_by_the_rule_of_the_original() -> None:
    """A message passes while fewer bytes than allowed lie in the window, however long that is."""
    now = [10_000_000_000]
    gate = BandwidthLimiter(100.0, 2.0, lambda: now[0])
    assert [gate.allows(80) for _ in range(3)] == [True, True, False]
    now[0] += 2_000_000_001
    assert gate.allows(200)
    assert not gate.allows(1)


def test_a_lazy_mux_subscribes_to_the_selected_topic_while_it_has_subscribers(graph) -> None:
    graph.start("topic_tools/mux", "out a b", lazy=True)
    a, b = graph.advertise("/a", STRING), graph.advertise("/b", STRING)
    a.publish({"data": "to learn the type"})
    graph.until(lambda: not a.has_subscribers and not b.has_subscribers)
    messages = graph.listen("/out", STRING)
    graph.until(lambda: a.has_subscribers)
    assert graph.call("/out_select", "topic_tools/MuxSelect", topic="b").prev_topic == "/a"
    graph.until(lambda: b.has_subscribers and not a.has_subscribers)
    b.publish({"data": "b"})
    graph.until(lambda: [m.data for m in messages] == ["b"])


def test_a_mux_with_an_unknown_initial_topic_forwards_nothing(graph) -> None:
    selected = graph.listen("/mux/selected", STRING)
    graph.start("topic_tools/mux", "out a b", initial_topic="c")
    graph.until(lambda: [m.data for m in selected] == ["__none"])
    assert graph.call("/mux/select", "topic_tools/MuxSelect", topic="a").prev_topic == ""


def test_a_lazy_throttle_and_a_stealth_relay_subscribe_while_others_do(graph) -> None:
    graph.start("topic_tools/throttle", "messages in 1000 out", lazy=True)
    graph.start("topic_tools/relay", "in copy", stealth=True, monitor_rate=0.1)
    source = graph.advertise("/in", STRING)
    graph.until(lambda: source.subscribers == 2)
    source.publish({"data": "to learn the type"})
    graph.until(lambda: not source.has_subscribers)
    messages, others = graph.listen("/out", STRING), graph.listen("/in", STRING)
    graph.until(lambda: source.subscribers == 3)
    source.publish({"data": "forwarded"})
    graph.until(lambda: [m.data for m in messages] == ["forwarded"])
    assert others


def test_a_stealth_relay_stays_subscribed_until_its_first_message(graph) -> None:
    """A relay without subscribers does not subscribe either; it still has to learn the type from a first message."""
    calls: list[str] = []
    graph.start("topic_tools/relay", "in copy", stealth=True, monitor_topic="other", monitor_rate=0.1)
    (node,) = (node for _, node in graph._running)
    poll = node.master.poll

    def counted_poll(method: str, *arguments: object):
        calls.append(method)
        return poll(method, *arguments)

    node.master.poll = counted_poll
    graph.until(lambda: calls.count("getSystemState") >= 3)
    source = graph.advertise("/in", STRING)
    source.publish({"data": "to learn the type"})
    graph.until(lambda: not source.has_subscribers)
    copies = graph.listen("/copy", STRING)
    graph.listen("/other", STRING)
    graph.until(lambda: source.has_subscribers)
    graph.until(lambda: source.publish({"data": "forwarded"}) or copies)
    assert copies[0].data == "forwarded"


def test_a_stealth_relay_unsubscribes_when_it_knows_the_type(graph) -> None:
    """The next check is an hour away; until then a subscriber to its output gets nothing."""
    graph.start("topic_tools/relay", "in copy", stealth=True, monitor_topic="other", monitor_rate=3600.0)
    source = graph.advertise("/in", STRING)
    source.publish({"data": "to learn the type"})
    graph.until(lambda: not source.has_subscribers)
