"""The newest message wins, whole, across two processes."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from trundle.viewer.mailbox import Mailbox


@pytest.fixture
def box() -> Iterator[Mailbox]:
    box = Mailbox.create(100_000)
    yield box
    box.unlink()


def test_an_empty_box_gives_nothing(box: Mailbox) -> None:
    assert box.take() is None


def test_the_newest_message_replaces_those_nobody_took(box: Mailbox) -> None:
    reader = Mailbox.open(box.path)
    for message in (b"first", b"second", b"third"):
        box.put(message)

    assert reader.take() == b"third"
    assert reader.take() is None


def test_a_message_that_does_not_fit_is_a_bug_of_the_caller(box: Mailbox) -> None:
    with pytest.raises(AssertionError, match="100001 bytes do not fit"):
        box.put(bytes(100_001))


def test_messages_of_another_process_arrive_whole_and_in_order(box: Mailbox) -> None:
    """Each message repeats one byte: a torn one would hold two, and numbers only grow."""
    program = (
        "import sys; from pathlib import Path; from trundle.viewer.mailbox import Mailbox\n"
        "box = Mailbox.open(Path(sys.argv[1]))\n"
        "for number in range(1, 251): box.put(bytes([number]) * 100_000)\n"
    )
    writer = subprocess.Popen([sys.executable, "-c", program, str(box.path)])
    seen = [0]
    while seen[-1] < 250:
        message = box.take()
        if message is not None:
            assert len(set(message)) == 1
            seen.append(message[0])
        assert writer.poll() in (None, 0)

    assert writer.wait() == 0
    assert seen == sorted(set(seen))


def test_a_file_without_a_name_still_carries_messages(box: Mailbox) -> None:
    reader = Mailbox.open(box.path)
    box.unlink()
    box.put(b"message")

    assert not Path(box.path).exists()
    assert reader.take() == b"message"
