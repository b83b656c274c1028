"""Queued messages of one stream: which of them newer ones replace."""

from collections.abc import Iterable

from trundle.page.clients.frames import BINARY
from trundle.page.clients.send_flow import KEPT, NEWEST, Flow, Keys, Message


def _flow(*keys: Keys) -> Flow:
    """Return a flow with a message each second."""
    flow = Flow("tf", 1)
    flow.messages.extend(Message(number, BINARY, (b"x",), key, float(number)) for number, key in enumerate(keys))
    return flow


def _of(*frames: str) -> Keys:
    return lambda: frozenset(frames)


def _numbers(messages: Iterable[Message]) -> list[int]:
    return [message.number for message in messages]


def test_messages_that_newer_ones_replace_are_dropped_once_one_is_late() -> None:
    flow = _flow(_of("base", "wheel"), _of("base"), _of("wheel"), _of("arm"), _of("base"))

    assert flow.drop_late(0.05) == []
    assert _numbers(flow.drop_late(9.0)) == [0, 1]
    assert _numbers(flow.messages) == [2, 3, 4]


def test_only_the_newest_message_of_a_whole_state_is_left() -> None:
    flow = _flow(NEWEST, NEWEST, NEWEST)

    assert _numbers(flow.drop_late(9.0)) == [0, 1]


def test_kept_messages_are_never_dropped_and_replace_none() -> None:
    flow = _flow(NEWEST, KEPT, NEWEST, KEPT)

    assert _numbers(flow.drop_late(9.0)) == [0]
    assert _numbers(flow.messages) == [1, 2, 3]


def test_a_message_of_which_a_part_was_sent_is_sent_whole() -> None:
    flow = Flow("image", 1)
    for number in range(3):
        flow.messages.append(Message(number, BINARY, (bytes(100),), NEWEST, 0.0))
    flow.messages[0].part(10, flow.number)

    assert _numbers(flow.drop_late(9.0)) == [1]
    assert _numbers(flow.messages) == [0, 2]
