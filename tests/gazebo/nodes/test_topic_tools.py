"""Messages of any type are relayed, throttled, multiplexed and transformed."""

from itertools import pairwise

import pytest
from tests.gazebo.nodes.conftest import PATIENCE_S

from trundle.gazebo.nodes.topic_tools.throttle import BandwidthLimiter, MessageRateLimiter

STRING = "std_msgs/String"


def test_relay_passes_on_what_it_knows_nothing_of(stage) -> None:
    heard = stage.listen("/out", STRING)
    stage.start("topic_tools/relay", "in out")
    stage.speak("/in", STRING, latch=True).publish({"data": "hello"})

    stage.until(lambda: [m.data for m in heard] == ["hello"])


def test_a_lazy_relay_listens_only_while_it_is_listened_to(stage) -> None:
    stage.start("topic_tools/relay", "in", lazy=True)
    source = stage.speak("/in", STRING)
    source.publish({"data": "to learn the type"})
    stage.until(lambda: not source.has_subscribers)
    heard = stage.listen("/in_relay", STRING)
    stage.until(lambda: source.has_subscribers)
    source.publish({"data": "wanted"})

    stage.until(lambda: [m.data for m in heard] == ["wanted"])


def test_drop_leaves_out_x_of_y(stage) -> None:
    heard = stage.listen("/in_drop", STRING)
    stage.start("topic_tools/drop", "in 1 3")
    source = stage.speak("/in", STRING)
    source.publish({"data": "0"})
    source.publish({"data": "unheard: the type becomes known"})
    stage.until(lambda: "/in_drop" in dict(stage.loop.run(stage.client.master.call("getTopicTypes"))))
    stage.until(lambda: stage.connected("/in_drop"))
    for number in range(2, 9):
        source.publish({"data": str(number)})

    stage.until(lambda: [m.data for m in heard] == ["2", "4", "5", "7", "8"])


def test_mux_passes_on_the_selected_topic_alone(stage) -> None:
    heard = stage.listen("/out", STRING)
    chosen = stage.listen("/mux/selected", STRING)
    stage.start("topic_tools/mux", "out a b")
    a, b = stage.speak("/a", STRING), stage.speak("/b", STRING)
    a.publish({"data": "unheard"})
    stage.until(lambda: stage.connected("/out"))
    a.publish({"data": "a"})
    stage.until(lambda: heard)
    assert stage.call("/mux/select", "topic_tools/MuxSelect", topic="b").prev_topic == "/a"
    a.publish({"data": "not this"})
    b.publish({"data": "b"})
    stage.until(lambda: len(heard) == 2)

    assert [m.data for m in heard] == ["a", "b"]
    assert [m.data for m in chosen] == ["/a", "b"]
    assert list(stage.call("/mux/list", "topic_tools/MuxList").topics) == ["/a", "/b"]


def test_transform_computes_fields_of_fields(stage) -> None:
    heard = stage.listen("/length", "std_msgs/Float64")
    source = stage.client.advertise("/pose", "geometry_msgs/PoseStamped")
    # One word: the test's helper splits at spaces.
    stage.start("topic_tools/transform", "/pose/pose/position /length std_msgs/Float64 numpy.hypot(m.x,m.y)")
    stage.until(lambda: source.has_subscribers and stage.connected("/length") and stage.linked("/length"))
    source.publish({"pose": {"position": {"x": 3.0, "y": 4.0}}})

    stage.until(lambda: [m.data for m in heard] == [5.0])


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
def test_a_wrong_command_line_is_said_and_ends_the_node(stage, capsys, command: str) -> None:
    name, _, arguments = command.partition(" ")
    assert stage.start(f"topic_tools/{name}", arguments).result(PATIENCE_S) == 1
    assert "[ERROR]" in capsys.readouterr().err


def test_throttled_messages_are_a_period_apart() -> None:
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


def test_bytes_are_throttled_as_the_original_counts_them() -> None:
    """A message passes while fewer bytes than allowed lie in the window, however long that is."""
    now = [10_000_000_000]
    gate = BandwidthLimiter(100.0, 2.0, lambda: now[0])
    assert [gate.allows(80) for _ in range(3)] == [True, True, False]
    now[0] += 2_000_000_001
    assert gate.allows(200)
    assert not gate.allows(1)


def test_a_lazy_mux_listens_to_the_selected_topic_while_it_is_listened_to(stage) -> None:
    stage.start("topic_tools/mux", "out a b", lazy=True)
    a, b = stage.speak("/a", STRING), stage.speak("/b", STRING)
    a.publish({"data": "to learn the type"})
    stage.until(lambda: not a.has_subscribers and not b.has_subscribers)
    heard = stage.listen("/out", STRING)
    stage.until(lambda: a.has_subscribers)
    assert stage.call("/out_select", "topic_tools/MuxSelect", topic="b").prev_topic == "/a"
    stage.until(lambda: b.has_subscribers and not a.has_subscribers)
    b.publish({"data": "b"})
    stage.until(lambda: [m.data for m in heard] == ["b"])


def test_a_mux_that_starts_with_no_input_it_has_passes_on_nothing(stage) -> None:
    chosen = stage.listen("/mux/selected", STRING)
    stage.start("topic_tools/mux", "out a b", initial_topic="c")
    stage.until(lambda: [m.data for m in chosen] == ["__none"])
    assert stage.call("/mux/select", "topic_tools/MuxSelect", topic="a").prev_topic == ""


def test_a_lazy_throttle_and_a_hidden_relay_listen_while_others_do(stage) -> None:
    stage.start("topic_tools/throttle", "messages in 1000 out", lazy=True)
    stage.start("topic_tools/relay", "in copy", stealth=True, monitor_rate=0.1)
    source = stage.speak("/in", STRING)
    stage.until(lambda: source.subscribers == 2)
    source.publish({"data": "to learn the type"})
    stage.until(lambda: not source.has_subscribers)
    heard, others = stage.listen("/out", STRING), stage.listen("/in", STRING)
    stage.until(lambda: source.subscribers == 3)
    source.publish({"data": "wanted"})
    stage.until(lambda: [m.data for m in heard] == ["wanted"])
    assert others


def test_a_hidden_relay_waits_for_its_first_message_however_long_it_takes(stage) -> None:
    """A relay without subscribers does not subscribe either; it still has to learn the type from a first message."""
    looks: list[str] = []
    stage.start("topic_tools/relay", "in copy", stealth=True, monitor_topic="other", monitor_rate=0.1)
    (node,) = (node for _, node in stage._running)
    ask = node.master.poll

    def asked(method: str, *arguments: object):
        looks.append(method)
        return ask(method, *arguments)

    node.master.poll = asked
    stage.until(lambda: looks.count("getSystemState") >= 3)
    source = stage.speak("/in", STRING)
    source.publish({"data": "to learn the type"})
    stage.until(lambda: not source.has_subscribers)
    copies = stage.listen("/copy", STRING)
    stage.listen("/other", STRING)
    stage.until(lambda: source.has_subscribers)
    stage.until(lambda: source.publish({"data": "wanted"}) or copies)
    assert copies[0].data == "wanted"


def test_a_hidden_relay_lets_go_as_soon_as_it_knows_the_type(stage) -> None:
    """The next check is an hour away; until then a subscriber to its output gets nothing."""
    stage.start("topic_tools/relay", "in copy", stealth=True, monitor_topic="other", monitor_rate=3600.0)
    source = stage.speak("/in", STRING)
    source.publish({"data": "to learn the type"})
    stage.until(lambda: not source.has_subscribers)
