"""A thread reads its sockets; others add, remove and wake."""

import logging
import socket
import threading
from collections.abc import Generator

import pytest
from tests.graphs import until

from trundle.ros.transport.thread_selector import ThreadSelector

_WAITS: None = None


@pytest.fixture
def pair() -> Generator[tuple[socket.socket, socket.socket]]:
    sender, receiver = socket.socketpair()
    with sender, receiver:
        receiver.setblocking(False)
        yield sender, receiver


@pytest.fixture
def selector() -> Generator[ThreadSelector]:
    selector = ThreadSelector()
    yield selector
    selector.close()


def test_sockets_are_read_in_the_thread_that_waits(
    selector: ThreadSelector, pair: tuple[socket.socket, socket.socket]
) -> None:
    sender, receiver = pair
    threads: list[object] = []
    has_ended = threading.Event()

    def read() -> None:
        threads.append(threading.current_thread())
        receiver.recv(1)

    def run() -> None:
        while not has_ended.is_set():
            selector.is_waiting = True
            selector.read(_WAITS)

    thread = threading.Thread(target=run)
    thread.start()
    selector.add_reader(receiver, read)
    for count in (1, 2):
        sender.send(b"x")
        until(lambda count=count: len(threads) == count)
    selector.remove_reader(receiver)
    sender.send(b"x")
    has_ended.set()
    until(lambda: selector.is_waiting)
    selector.wake()
    thread.join()
    assert threads == [thread, thread]


def test_reading_without_a_wait_says_if_anything_was_readable(
    selector: ThreadSelector, pair: tuple[socket.socket, socket.socket]
) -> None:
    sender, receiver = pair
    selector.add_reader(receiver, lambda: receiver.recv(1))
    assert not selector.read(0.0)
    sender.send(b"x")
    assert selector.read(0.0)
    assert not selector.read(0.0)


def test_a_socket_that_a_reader_removes_is_not_read(
    selector: ThreadSelector, pair: tuple[socket.socket, socket.socket]
) -> None:
    read: list[socket.socket] = []

    def remove_both(sock: socket.socket) -> None:
        read.append(sock)
        for each in pair:
            selector.remove_reader(each)
            selector.remove_reader(each)

    for sock in pair:
        selector.add_reader(sock, lambda sock=sock: remove_both(sock))
        sock.send(b"x")
    assert selector.read(0.0)
    assert len(read) == 1
    assert not selector.read(0.0)


def test_a_reader_that_fails_stops_no_other(
    selector: ThreadSelector, pair: tuple[socket.socket, socket.socket], caplog: pytest.LogCaptureFixture
) -> None:
    sender, receiver = pair

    def fail() -> None:
        sender.recv(1)
        raise ValueError("broken")

    selector.add_reader(sender, fail)
    selector.add_reader(receiver, lambda: receiver.recv(1))
    sender.send(b"x")
    receiver.send(b"x")
    with caplog.at_level(logging.ERROR):
        while selector.read(0.0):
            pass
    assert "a connection could not be read" in caplog.text
    with pytest.raises(BlockingIOError):
        receiver.recv(1)


def test_a_closed_selector_takes_no_sockets(pair: tuple[socket.socket, socket.socket]) -> None:
    selector = ThreadSelector()
    selector.is_waiting = True
    selector.close()
    selector.wake()
    selector.add_reader(pair[0], lambda: None)
    selector.remove_reader(pair[0])
