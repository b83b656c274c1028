"""A file that one program writes cannot be overwritten, damaged or removed by another."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.base.atomic_write import replaced_atomically, write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.file_lock import FileLock
from trundle.sim.simulation import read_state_log

_HOLD = """
import sys
from pathlib import Path
from trundle.base.file_lock import FileLock
with FileLock(Path(sys.argv[1])):
    print("held", flush=True)
    sys.stdin.read()
"""
WORLD = '<sdf version="1.6"><world name="w"><model name="m"><link name="l"/></model></world></sdf>'


@contextmanager
def _holder(path: Path) -> Generator[subprocess.Popen[str]]:
    """Start another process that locks a file."""
    words = [sys.executable, "-c", _HOLD, str(path)]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "held\n"
        try:
            yield process
        finally:
            process.kill()


def test_a_locked_file_is_refused_with_the_holders_name(tmp_path: Path) -> None:
    file, link = tmp_path / "a.bag", tmp_path / "link.bag"
    link.symlink_to(file)
    with _holder(file) as process, pytest.raises(OSError, match="choose another name") as caught:
        FileLock(link)
    holder = "another program" if sys.platform != "linux" else rf"process {process.pid} \(python.*\)"
    assert re.fullmatch(rf"{holder} writes it: end that, or choose another name", caught.value.strerror or "")
    assert caught.value.filename == str(file)


def test_a_killed_process_releases_its_lock(tmp_path: Path) -> None:
    with _holder(tmp_path / "a.bag") as process:
        process.kill()
        process.wait()
        with FileLock(tmp_path / "a.bag"):
            assert [path.name for path in tmp_path.iterdir()] == [".a.bag.lock"]
    assert list(tmp_path.iterdir()) == []


def test_only_one_of_many_processes_holds_a_lock(tmp_path: Path) -> None:
    """Each removes the lock file when done, while others may have it open."""
    code = f"""
import os
from pathlib import Path
from trundle.base.file_lock import FileLock
for i in range(300):
    try:
        lock = FileLock(Path({str(tmp_path / "a")!r}))
    except OSError:
        continue
    with lock:
        os.close(os.open({str(tmp_path / "held")!r}, os.O_CREAT | os.O_EXCL))
        os.unlink({str(tmp_path / "held")!r})
"""
    processes = [subprocess.Popen([sys.executable, "-c", code]) for _ in range(3)]
    assert [process.wait() for process in processes] == [0, 0, 0]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(os.name != "posix", reason="this system has no links and devices")
def test_links_are_not_followed_and_devices_not_locked(tmp_path: Path) -> None:
    (tmp_path / ".a.lock").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(OSError, match="Too many levels of symbolic links"):
        FileLock(tmp_path / "a")
    assert not (tmp_path / "elsewhere").exists()
    with FileLock(Path(os.devnull)), FileLock(Path(os.devnull)):
        pass


def test_concurrent_writes_are_refused(tmp_path: Path) -> None:
    """Without the lock, the first writer would install the second's incomplete file."""
    file = tmp_path / "a.gif"
    with replaced_atomically(file) as partial:
        partial.write_text("first")
        with pytest.raises(OSError, match="writes it"), replaced_atomically(file):
            pass
        with pytest.raises(UsageError, match=r"cannot write .*a\.gif: .* writes it: end that, or choose another name"):
            write_atomically(file, "second")
    assert file.read_text() == "first"
    assert [path.name for path in tmp_path.iterdir()] == ["a.gif"]


def test_a_run_does_not_overwrite_the_recording_of_another(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "w.sdf").write_text(WORLD)
    log = tmp_path / "run.log"
    words = ["run", str(tmp_path / "w.sdf"), "--headless", "--record", str(log)]
    with subprocess.Popen([sys.executable, "-m", "trundle", *words], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        while not (log.exists() and log.stat().st_size > 100):
            assert process.poll() is None
        assert main([*words, "--duration", "0.1"]) == 1
        process.send_signal(signal.SIGINT)
        process.communicate()
    assert re.search(rf"error: {log}: .* writes it: end that, or choose another name\n", capsys.readouterr().err)
    assert read_state_log(log).times_s[0] == 0.0
    assert main([*words, "--duration", "0.1"]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["run.log", "w.sdf"]
