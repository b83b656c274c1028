"""Playback of a bag on the page: messages, the state after a jump, the clock."""

import json
import os
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page_client import ProtocolClient, page_url

from trundle.app.play import PlayOptions, play
from trundle.base.diagnostics import DescriptionError
from trundle.base.http.page_address import PageAddress
from trundle.page import BagFile, PageServer, Session
from trundle.page.bag.reader import BagCursor
from trundle.ros import BagConnection, BagMessage, Messages, create_bag, open_bag

S = 1_000_000_000
START = 100 * S
TYPES = Messages()


def connection(topic: str, type_name: str, *, latching: bool = False, caller: str = "/a") -> BagConnection:
    return BagConnection(
        topic=topic,
        type=type_name,
        md5sum=TYPES.md5(type_name),
        definition=TYPES.definition(type_name),
        caller=caller,
        latching=latching,
    )


TEXT = connection("/text", "std_msgs/String")
RARE = connection("/rare", "std_msgs/String")
MAP = connection("/map", "std_msgs/String", latching=True)
TF = connection("/tf", "tf2_msgs/TFMessage")
STATIC = [connection("/tf_static", "tf2_msgs/TFMessage", caller=caller) for caller in ("/a", "/b")]


@pytest.fixture(scope="module", params=["bag", "mcap"])
def bag(request: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Ten seconds: /text at 10 Hz, /tf at 1 Hz, the others near the start."""
    path = tmp_path_factory.mktemp("bag") / f"drive.{request.param}"
    with create_bag(path) as writer:
        for static in STATIC:
            writer.write(BagMessage(static, START, b"\0\0\0\0"))
        writer.write(BagMessage(MAP, START, text("map")))
        writer.write(BagMessage(RARE, START + S // 2, text("rare")))
        for tick in range(101):
            stamp = START + tick * S // 10
            writer.write(BagMessage(TEXT, stamp, text(str(tick))))
            if tick % 10 == 0:
                writer.write(BagMessage(TF, stamp, b"\0\0\0\0"))
    return path


def text(value: str) -> bytes:
    """Return the bytes of a std_msgs/String."""
    return len(value).to_bytes(4, "little") + value.encode()


@pytest.fixture
def client(bag: Path) -> Iterator[ProtocolClient]:
    playing = BagFile(path=os.fsencode(bag), speed=1.0, paused=True)
    session = Session(title="drive", kind="bag")
    with (
        PageServer.start(session, at=PageAddress(port=0), bag=playing) as server,
        ProtocolClient(server.url) as client,
    ):
        yield client


def times(client: ProtocolClient, topic: str) -> list[float]:
    """Return the times of a topic's messages since the start [s]."""
    return [(time_ns - START) / S for name, time_ns, _ in client.messages if name == topic]


def ask(client: ProtocolClient, number: int, **fields: Any) -> dict[str, Any]:
    client.send("trundle/request", id=number, **fields)
    client.until(lambda: any(message.get("id") == number for message in client.jsons))
    return next(message for message in client.jsons if message.get("id") == number)


def test_pictures_of_a_bag_are_refused(bag: Path) -> None:
    playing = BagFile(path=os.fsencode(bag), speed=1.0, paused=True)
    with (
        PageServer.start(Session(title="b", kind="bag"), at=PageAddress(port=0), bag=playing) as page,
        pytest.raises(urllib.error.HTTPError, match="503") as refusal,
    ):
        urllib.request.urlopen(page_url(page.url, "/camera.png?width=64&height=48"))
    with refusal.value as answer:
        assert answer.read() == b"only browsers with WebGL can draw a bag\n"


def test_topics_are_advertised_with_their_types(client: ProtocolClient) -> None:
    client.until(lambda: {"/text", "/rare", "/map", "/tf", "/tf_static"} <= client.channels.keys())

    offer = client.channels["/text"]
    assert (offer["encoding"], offer["schemaName"], offer["schemaEncoding"]) == ("ros1", "std_msgs/String", "ros1msg")
    assert offer["schema"] == TYPES.definition("std_msgs/String")


def test_the_state_at_the_new_time_is_sent_after_a_jump(client: ProtocolClient) -> None:
    for topic in ("/text", "/rare", "/map", "/tf", "/tf_static", "trundle/state"):
        client.subscribe(topic)
    client.until(lambda: times(client, "/text") and len(times(client, "/tf_static")) == 2)
    client.messages.clear()

    assert ask(client, 1, request="seek", time_ns=START + 55 * S // 10)["ok"]
    client.until(lambda: times(client, "/text") and times(client, "trundle/state"))
    client.until(lambda: len(times(client, "/tf")) == 2 and times(client, "/rare") and times(client, "/map"))
    client.until(lambda: len(times(client, "/tf_static")) == 2)

    assert times(client, "/text") == [5.5]
    assert times(client, "/rare") == [0.5]
    assert times(client, "/map") == [0.0]
    assert times(client, "/tf") == [4.0, 5.0]
    assert times(client, "/tf_static") == [0.0, 0.0]
    state = json.loads(client.payloads("trundle/state")[-1])
    assert (state["time_ns"], state["paused"]) == (START + 55 * S // 10, True)
    assert state["timeline"] == {"start_ns": START, "end_ns": START + 10 * S}


def test_messages_are_played_in_order_with_unchanged_bytes(client: ProtocolClient) -> None:
    client.subscribe("/text")
    client.until(lambda: times(client, "/text"))
    ask(client, 1, request="speed", factor=4.0)  # a server that is held up for 1 s still has 40 before the end
    ask(client, 2, request="seek", time_ns=START + S)
    client.messages.clear()

    ask(client, 3, request="play")
    client.until(lambda: len(times(client, "/text")) > 40)

    ticks = [round(10 * time_s) for time_s in times(client, "/text")[:40]]
    assert ticks == list(range(ticks[0], ticks[0] + 40))
    assert client.payloads("/text")[:40] == [text(str(tick)) for tick in ticks]


def test_later_clients_get_the_state_and_a_step_is_a_tenth_of_a_second(client: ProtocolClient) -> None:
    client.subscribe("/text")
    client.until(lambda: times(client, "/text"))
    ask(client, 1, request="seek", time_ns=START + 3 * S)
    client.until(lambda: times(client, "/text")[-1] == 3.0)

    client.subscribe("/map")
    client.until(lambda: times(client, "/map"))
    ask(client, 2, request="step", count=2)
    client.until(lambda: times(client, "/text")[-1] == 3.2)

    assert times(client, "/text")[-3:] == [3.0, 3.1, 3.2]
    assert client.payloads("/map") == [text("map")]


def test_requests_to_move_joints_are_refused(client: ProtocolClient) -> None:
    answer = ask(client, 1, request="joint", model="m", joint="j", position=1.0)

    assert (answer["ok"], answer["error"]) == (False, "a recording does not support this request")


def test_reading_continues_without_seeking(bag: Path) -> None:
    with open_bag(bag) as reader:
        cursor = BagCursor(reader)
        topics = frozenset({"/text"})
        parts = [cursor.read(topics, START + i * S, START + (i + 1) * S) for i in range(3)]
        again = cursor.read(topics, START, START + S)

    assert [len(part) for part in parts] == [10, 10, 10]
    assert [message.data for message in again] == [message.data for message in parts[0]]


def test_an_empty_bag_is_refused(tmp_path: Path) -> None:
    with create_bag(tmp_path / "empty.bag"):
        pass

    with pytest.raises(DescriptionError, match="nothing was recorded"):
        play(tmp_path / "empty.bag", PlayOptions())


@pytest.mark.parametrize("suffix", ["bag", "mcap"])
def test_a_bag_with_a_stamp_of_zero_can_be_played(tmp_path: Path, suffix: str) -> None:
    """Recorders write such stamps before simulated time starts."""
    path = tmp_path / f"long.{suffix}"
    with create_bag(path) as writer:
        writer.write(BagMessage(TEXT, 0, text("early")))
        writer.write(BagMessage(TEXT, 1_700_000_000 * S, text("late")))
    playing = BagFile(path=os.fsencode(path), speed=1.0, paused=True)
    with (
        PageServer.start(Session(title="long", kind="bag"), at=PageAddress(port=0), bag=playing) as page,
        ProtocolClient(page.url) as client,
    ):
        client.subscribe("/text")
        assert ask(client, 1, request="seek", time_ns=1_700_000_000 * S)["ok"]
        client.until(lambda: text("late") in client.payloads("/text"))
