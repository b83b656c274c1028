"""Short messages are written to sockets in one step; other cases take the general path, in the same order."""

import os
import socket
from collections.abc import Generator
from importlib import import_module
from typing import Any

import pytest

from trundle.ros._message_codec import NOT_SENT, SENT, SENT_IN_PART, DirectSender, DirectSocket
from trundle.ros.rospy.finder import install

install()
message_class: Any = import_module("trundle.ros.rospy.message_classes").message_class
codec: Any = import_module("trundle.ros.rospy.message_methods").codec
Twist, Header, Text = map(message_class, ("geometry_msgs/Twist", "std_msgs/Header", "std_msgs/String"))
Stamped = message_class("geometry_msgs/TwistStamped")


class Peer:
    """The other end of a socket."""

    def __init__(self) -> None:
        self.near, self.far = socket.socketpair()
        self.near.setblocking(False)
        self.direct = DirectSocket(self.near.fileno())
        self.direct.is_open = True

    def received(self) -> bytes:
        self.far.setblocking(False)
        try:
            return self.far.recv(65536)
        except BlockingIOError:
            return b""


@pytest.fixture
def peer() -> Generator[Peer]:
    peer = Peer()
    with peer.near, peer.far:
        yield peer


def _sender(cls: Any, *peers: Peer) -> DirectSender:
    sender = DirectSender(cls, codec(cls), cls._has_header)
    sender.sockets = [peer.direct for peer in peers]
    sender.is_active = True
    return sender


def _frame(message: Any) -> bytes:
    return b"".join(codec(type(message)).frame(message))


def test_a_message_arrives_as_a_frame(peer: Peer) -> None:
    message = Twist()
    message.linear.x = 0.5
    sender = _sender(Twist, peer)
    assert sender.send((message,), {}) == SENT
    assert peer.received() == _frame(message)
    assert (sender.sequence, peer.direct.frames_sent, peer.direct.bytes_sent) == (1, 1, 52)


def test_messages_with_a_header_are_numbered(peer: Peer) -> None:
    sender = _sender(Stamped, peer)
    message = Stamped()
    for number in (1, 2):
        assert sender.send((message,), {}) == SENT
        assert message.header.seq == number
        assert peer.received() == _frame(message)


@pytest.mark.parametrize(
    ("arguments", "keywords"),
    [((), {}), ((Twist(), 1), {}), ((Twist(),), {"linear": None}), ((Text(),), {}), (({},), {}), ((None,), {})],
)
def test_other_arguments_are_left_to_the_caller(
    peer: Peer, arguments: tuple[Any, ...], keywords: dict[str, Any]
) -> None:
    sender = _sender(Twist, peer)
    assert sender.send(arguments, keywords) == NOT_SENT
    assert (peer.received(), sender.sequence) == (b"", 0)


def test_a_message_with_a_wrong_value_is_left_to_the_caller(peer: Peer) -> None:
    message = Twist()
    message.linear.x = "fast"
    headless = Stamped()
    headless.header = None
    for invalid in (message, headless):
        assert _sender(type(invalid), peer).send((invalid,), {}) == NOT_SENT
    assert peer.received() == b""


def test_a_long_message_is_left_to_the_queue(peer: Peer) -> None:
    sender = _sender(Text, peer)
    assert sender.send((Text("x" * 40_000),), {}) == NOT_SENT
    assert sender.send((Text("x"),), {}) == NOT_SENT, "long messages were serialized here again"
    assert peer.received() == b""


def test_nothing_is_sent_directly_while_messages_are_queued(peer: Peer) -> None:
    sender = _sender(Twist, peer)
    peer.direct.is_open = False
    assert sender.send((Twist(),), {}) == NOT_SENT
    peer.direct.is_open, sender.is_active = True, False
    assert sender.send((Twist(),), {}) == NOT_SENT
    sender.sockets, sender.is_active = [], True
    assert sender.send((Twist(),), {}) == NOT_SENT
    assert peer.received() == b""


def test_the_rest_of_a_message_sent_in_part_is_kept(peer: Peer) -> None:
    sender = _sender(Twist, peer)
    while (sent := sender.send((Twist(),), {})) == SENT:
        pass
    assert sent == SENT_IN_PART
    assert not peer.direct.is_open
    assert sender.send((Twist(),), {}) == NOT_SENT
    arrived = b""
    while more := peer.received():
        arrived += more
    assert arrived + peer.direct.take_rest() == _frame(Twist()) * sender.sequence
    assert peer.direct.take_rest() == b""


def test_a_field_that_runs_code_cannot_mix_messages(peer: Peer) -> None:
    """A field's value publishes on the same topic when it is converted."""

    class Value:
        def __float__(self) -> float:
            assert sender.send((Twist(),), {}) == SENT
            return 1.0

    sender = _sender(Twist, peer)
    message = Twist()
    message.linear.x = Value()
    assert sender.send((message,), {}) == NOT_SENT
    assert (peer.received(), sender.sequence) == (_frame(Twist()), 1)


def test_a_message_to_a_closed_peer_is_left_to_the_queue(peer: Peer) -> None:
    os.close(peer.far.detach())
    assert _sender(Twist, peer).send((Twist(),), {}) == SENT_IN_PART
    assert peer.direct.take_rest() == _frame(Twist())
