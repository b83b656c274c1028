"""Playing of bags: pauses, /clock, latched topics, rate control."""

import itertools
from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from trundle.ros import BagConnection, BagMessage, Messages, Player, PlayerOptions, create_bag, open_bag, to_nsec

STRING = "std_msgs/String"
_CONNECTION = BagConnection(topic="/a", type=STRING, md5sum=Messages().md5(STRING), definition="string data\n")


class _StopPlayingError(Exception):
    """Raised to end a player."""


def _bag(path: Path, content: Sequence[tuple[str, str, bool, int]]) -> Path:
    """Write a bag from tuples of topic, publisher, latching and time [s]; a message is the letter of its second."""
    with create_bag(path) as out:
        for topic, caller, latching, second in content:
            connection = BagConnection(
                topic=topic,
                type=STRING,
                md5sum=_CONNECTION.md5sum,
                definition=_CONNECTION.definition,
                caller=caller,
                latching=latching,
            )
            out.write(BagMessage(connection, second * 10**9, b"\x01\0\0\0%c" % (64 + second)))
    return path


@pytest.mark.parametrize("start_s", [0.0, 2.5])
def test_late_subscribers_get_the_last_latched_message_of_each_publisher(
    graph: Any, tmp_path: Path, start_s: float
) -> None:
    """Many nodes publish /tf_static; a player repeats each node's last message."""
    content = [
        ("/map", "/one", True, 1),
        ("/map", "/two", True, 2),
        ("/map", "/one", True, 3),
        ("/map", "/three", True, 4),
    ]
    with open_bag(_bag(tmp_path / "x.bag", content)) as bag:
        player = Player(graph.node("play"), [bag], PlayerOptions(immediate=True, start_s=start_s))
        player.advertise()
        player.play(lambda: None)
        for name in ("late", "later"):
            got: list[str] = []
            graph.node(name).subscribe("/map", STRING, lambda m, got=got: got.append(m.data), queue_size=None)
            graph.until(lambda got=got: len(got) == 3)
            assert sorted(got) == ["B", "C", "D"]


def test_the_clock_is_published_in_a_pause_and_after_the_end(graph: Any, tmp_path: Path) -> None:
    """A node that starts while a bag is paused needs the time."""
    content = [("/a", "", False, second) for second in (1, 2, 3)]
    clock: list[int] = []
    node = graph.node("listener")
    following = node.subscribe(
        "/clock", "rosgraph_msgs/Clock", lambda m: clock.append(m.clock.sec * 10**9 + m.clock.nanosec), queue_size=None
    )
    with open_bag(_bag(tmp_path / "x.bag", content)) as bag:
        player = Player(graph.node("play"), [bag], PlayerOptions(clock_hz=200.0, rate=100.0))
        player.advertise()
        graph.until(lambda: following.publishers)
        player.is_paused = True

        def poll() -> None:
            second = 1 if player.played == 0 else player.played
            if clock[-3:] == [second * 10**9] * 3:
                player.steps = 1

        player.play(poll)
        player.is_paused = False

        def stop_after_the_end() -> None:
            if clock[-1] > 4 * 10**9:
                raise _StopPlayingError

        with pytest.raises(_StopPlayingError):
            player.keep_alive(stop_after_the_end)
    assert clock == sorted(clock)
    assert [clock.count(second * 10**9) >= 3 for second in (1, 2)] == [True, True]


def test_the_clock_never_goes_back_on_a_busy_machine(
    graph: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between two looks at the wall's clock, a program may stand still."""
    ticks = itertools.count()
    monkeypatch.setattr("trundle.ros.bags.play.time", SimpleNamespace(monotonic=lambda: next(ticks) * 0.07, sleep=id))
    content = [("/a", "", False, second) for second in range(1, 20)]
    clock: list[int] = []
    node = graph.node("listener")
    following = node.subscribe(
        "/clock", "rosgraph_msgs/Clock", lambda m: clock.append(to_nsec(m.clock)), queue_size=None
    )
    with open_bag(_bag(tmp_path / "x.bag", content)) as bag:
        player = Player(graph.node("play"), [bag], PlayerOptions(clock_hz=100.0))
        player.advertise()
        graph.until(lambda: following.publishers)
        player.play(lambda: graph.until(lambda: not clock or clock[-1] == player.now_ns))
        graph.until(lambda: clock and clock[-1] == 19 * 10**9)
    assert clock == sorted(clock)


def test_pause_topics_can_be_disabled(graph: Any, tmp_path: Path) -> None:
    content = [("/a", "", False, 1), ("/b", "", False, 2), ("/b", "", False, 3)]
    with open_bag(_bag(tmp_path / "x.bag", content)) as bag:
        player = Player(graph.node("play"), [bag], PlayerOptions(immediate=True, pause_topics=frozenset(["/b"])))
        player.advertise()
        paused_at: list[int] = []

        def poll() -> None:
            if player.is_paused:
                paused_at.append(player.played)
                player.is_paused = player.uses_pause_topics = False

        player.play(poll)
    assert (paused_at, player.played) == ([1], 3)


def test_playing_waits_for_the_rate_control_topic_except_in_a_gap(graph: Any, tmp_path: Path) -> None:
    """The follower's stamps give its progress; it publishes none in a long gap."""
    kind = "geometry_msgs/PointStamped"
    messages = Messages()
    connection = BagConnection(topic="/a", type=kind, md5sum=messages.md5(kind), definition=messages.definition(kind))
    seconds = [*range(1, 41), 100, 101]
    with create_bag(tmp_path / "x.bag") as out:
        for second in seconds:
            message = messages.new(kind, {"header": {"stamp": second * 10**9}})
            out.write(BagMessage(connection, second * 10**9, bytes(messages.serialize(message))))
    got: list[int] = []
    follower = graph.node("follower")
    done = follower.advertise("/done", kind, latch=True)
    follower.subscribe("/a", kind, lambda m: got.append(m.header.stamp.sec), queue_size=None)
    waits: list[int] = []
    with open_bag(tmp_path / "x.bag") as bag:
        options = PlayerOptions(immediate=True, queue_size=0, rate_control_topic="/done", rate_control_s=10.0)
        player = Player(graph.node("play"), [bag], options)
        (publisher,) = player.advertise()
        graph.until(lambda: publisher.has_subscribers and done.has_subscribers)

        def poll() -> None:
            waits.append(player.played)
            if len(got) in (12, 41) and waits.count(player.played) > 1:  # it waits
                done.publish({"header": {"stamp": (40 if len(got) == 12 else 100) * 10**9}})

        player.play(poll)
    graph.until(lambda: got == seconds)
    assert waits.count(12) > 1
    assert waits.count(41) > 1


def test_a_prefix_is_prepended_to_a_topic_as_written(graph: Any, tmp_path: Path) -> None:
    content = [("/a", "", False, 1), ("b", "", False, 2)]
    with open_bag(_bag(tmp_path / "x.bag", content)) as bag:
        for prefix, topics in (("", ["/a", "/b"]), ("x", ["/x/a", "/xb"]), ("/y/", ["/y/a", "/y/b"])):
            player = Player(graph.node(f"play_{len(prefix)}"), [bag], PlayerOptions(prefix=prefix))
            assert [publisher.topic for publisher in player.advertise()] == topics
