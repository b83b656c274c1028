"""The newest message wins, whole, across two processes."""

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
def box(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Mailbox]:
    if request.param == "named":
        monkeypatch.delattr(os, "memfd_create")
        monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    box = Mailbox.create(100_000)
    yield box
    box.unlink()


def test_an_empty_box_gives_nothing(box: Mailbox) -> None:
    assert box.read() is None


def test_the_newest_message_replaces_those_were_not_read(box: Mailbox) -> None:
    reader = Mailbox.open(box.address)
    for message in (b"first", b"second", b"third"):
        box.put([message])

    assert reader.read() == b"third"
    assert reader.read() is None


def test_a_message_that_does_not_fit_is_a_bug_of_the_caller(box: Mailbox) -> None:
    with pytest.raises(AssertionError, match="longer than the mailbox"):
        box.put([bytes(100_001)])


def test_messages_of_another_process_arrive_whole_and_in_order(box: Mailbox) -> None:
    """Each message repeats one byte: a torn one would hold two, and numbers only grow."""
    program = (
        "import sys; from trundle.page.mailbox import Mailbox; from trundle.page.shared_memory import MemoryAddress\n"
        "box = Mailbox.open(MemoryAddress(sys.argv[1], int(sys.argv[2])))\n"
        "for number in range(1, 251): box.put([bytes([number]) * 40_000, bytes([number]) * 60_000])\n"
    )
    writer = subprocess.Popen([sys.executable, "-c", program, box.address.path, str(box.address.inode)])
    seen = [0]
    while seen[-1] < 250:
        message = box.read()
        if message is not None:
            assert len(set(message)) == 1
            seen.append(message[0])
        assert writer.poll() in (None, 0)

    assert writer.wait() == 0
    assert seen == sorted(set(seen))


def test_a_file_without_a_name_still_carries_messages(box: Mailbox) -> None:
    reader = Mailbox.open(box.address)
    box.unlink()
    box.put([b"message"])

    assert not Path(box.address.path).exists()
    assert reader.read() == b"message"


def test_a_box_that_its_owner_let_go_of_is_not_mistaken_for_the_next_one(box: Mailbox) -> None:
    """The next file of that process gets the number of the last."""
    address = box.address
    box.unlink()
    with tempfile.TemporaryFile():
        next_box = Mailbox.create(1000)
        with pytest.raises(FileNotFoundError):
            Mailbox.open(address)
        next_box.unlink()


@pytest.mark.skipif(not hasattr(os, "memfd_create"), reason="this system has no files without a name")
def test_an_owner_that_is_killed_leaves_nothing() -> None:
    """Before the reader has found it: within the first moments of `trundle run`."""
    program = (
        "import os, signal; from trundle.page.mailbox import Mailbox\n"
        "box = Mailbox.create(1_000_000); os.kill(os.getpid(), signal.SIGKILL)"
    )
    owner = subprocess.Popen([sys.executable, "-c", program])

    assert owner.wait() == -signal.SIGKILL
    folders = (Path("/dev/shm"), Path(tempfile.gettempdir()))
    assert [path for folder in folders for path in folder.glob(f"trundle-{owner.pid}-*")] == []
