"""The newest message replaces unread ones, whole, between two processes."""

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from trundle.page.mailbox import Mailbox


@pytest.fixture(params=["without a name", "named"])
def mailbox(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Mailbox]:
    if request.param == "named":
        monkeypatch.delattr(os, "memfd_create")
        monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    mailbox = Mailbox.create(100_000)
    yield mailbox
    mailbox.unlink()


def test_an_empty_mailbox_has_no_message(mailbox: Mailbox) -> None:
    assert mailbox.read() is None


def test_the_newest_message_replaces_unread_ones(mailbox: Mailbox) -> None:
    reader = Mailbox.open(mailbox.address)
    for message in (b"first", b"second", b"third"):
        mailbox.put([message])

    assert reader.read() == b"third"
    assert reader.read() is None


def test_a_message_beyond_the_capacity_fails_an_assertion(mailbox: Mailbox) -> None:
    with pytest.raises(AssertionError, match="longer than the mailbox"):
        mailbox.put([bytes(100_001)])


def test_messages_of_another_process_arrive_whole_and_in_order(mailbox: Mailbox) -> None:
    """Each message repeats one byte: a torn one would contain two, and numbers only increase."""
    program = (
        "import sys; from trundle.page.mailbox import Mailbox; from trundle.page.shared_memory import MemoryAddress\n"
        "mailbox = Mailbox.open(MemoryAddress(sys.argv[1], int(sys.argv[2])))\n"
        "for number in range(1, 251): mailbox.put([bytes([number]) * 40_000, bytes([number]) * 60_000])\n"
    )
    writer = subprocess.Popen([sys.executable, "-c", program, mailbox.address.path, str(mailbox.address.inode)])
    numbers = [0]
    while numbers[-1] < 250:
        message = mailbox.read()
        if message is not None:
            assert len(set(message)) == 1
            numbers.append(message[0])
        assert writer.poll() in (None, 0)

    assert writer.wait() == 0
    assert numbers == sorted(set(numbers))


def test_messages_arrive_after_the_file_is_unlinked(mailbox: Mailbox) -> None:
    reader = Mailbox.open(mailbox.address)
    mailbox.unlink()
    mailbox.put([b"message"])

    assert not Path(mailbox.address.path).exists()
    assert reader.read() == b"message"


def test_the_address_of_a_released_mailbox_does_not_open_the_next_one(mailbox: Mailbox) -> None:
    """The process's next file gets the same descriptor number."""
    address = mailbox.address
    mailbox.unlink()
    with tempfile.TemporaryFile():
        next_mailbox = Mailbox.create(1000)
        with pytest.raises(FileNotFoundError):
            Mailbox.open(address)
        next_mailbox.unlink()


@pytest.mark.skipif(not hasattr(os, "memfd_create"), reason="this system has no files without a name")
def test_a_killed_owner_leaves_no_files() -> None:
    """It is killed before the reader has opened the mailbox."""
    program = (
        "import os, signal; from trundle.page.mailbox import Mailbox\n"
        "mailbox = Mailbox.create(1_000_000); os.kill(os.getpid(), signal.SIGKILL)"
    )
    owner = subprocess.Popen([sys.executable, "-c", program])

    assert owner.wait() == -signal.SIGKILL
    folders = (Path("/dev/shm"), Path(tempfile.gettempdir()))
    assert [path for folder in folders for path in folder.glob(f"trundle-{owner.pid}-*")] == []
