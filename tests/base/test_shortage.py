"""Errors of a process that exhausts a resource name it, its limit and the remedy."""

import errno
import os
import re
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.base.shortage import shortage

_FEW_THREADS = """
import sys, threading
left, start = int(sys.argv[1]), threading.Thread.start
def limited(thread):
    global left
    left -= 1
    if left < 0:
        raise RuntimeError("can't start new thread")
    start(thread)
threading.Thread.start = limited
sys.argv[1:2] = []
from trundle.__main__ import main
sys.exit(main())
"""
"""Lets starts of threads fail as under RLIMIT_NPROC, which does not apply to root."""

pytestmark = pytest.mark.skipif(os.name != "posix", reason="this system has no limits of processes")


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (OSError(errno.EMFILE, "x", "w.sdf"), "trundle: error: this process has as many files open as it may ("),
        (MemoryError(), "trundle: error: no memory is left (limit of this process [MiB]: "),
        (ImportError("libx.so: failed to map segment from shared object"), "trundle: error: no memory is left ("),
    ],
)
def test_an_exhausted_resource_is_reported_in_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], error: Exception, sentence: str
) -> None:
    def fail(_: object) -> int:
        raise error

    monkeypatch.setattr("trundle.app.cli.check.main", fail)
    assert main(["check", "w.sdf"]) == 1
    no_files, errors = capsys.readouterr()
    assert (no_files, errors.count("\n")) == ("", 1)
    assert errors.startswith(sentence)


@pytest.mark.parametrize("count", [0, 1])
def test_missing_threads_are_reported_in_one_line(tmp_path: Path, count: int) -> None:
    words = [sys.executable, "-c", _FEW_THREADS, str(count), "core", "-p", "0"]
    env = {**os.environ, "ROS_LOG_DIR": str(tmp_path)}
    process = subprocess.run(words, env=env, capture_output=True, text=True, timeout=100)
    assert process.returncode == 1
    assert "Traceback" not in process.stderr
    assert "no further thread or process can be started (limits: " in process.stderr


@pytest.mark.parametrize(
    ("file", "count"), [("w.sdf", 5), ("w.sdf", 7), ("w.sdf", 12), ("a.launch", 8), ("a.launch", 12), ("a.launch", 14)]
)
def test_too_few_file_descriptors_are_reported_in_one_line(tmp_path: Path, file: str, count: int) -> None:
    """Neither a launch nor a run waits for a master that cannot accept connections."""
    node = '<node pkg="topic_tools" type="relay" name="r" args="a b"/>'
    (tmp_path / "a.launch").write_text(f"<launch>{node}</launch>")
    (tmp_path / "w.sdf").write_text('<sdf version="1.6"><model name="m"><link name="l"/></model></sdf>')
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        env = {**os.environ, "ROS_MASTER_URI": f"http://127.0.0.1:{probe.getsockname()[1]}"}
    command = "run" if file == "w.sdf" else "launch"
    words = [sys.executable, "-m", "trundle", command, file, "--headless", "--duration", "0.1"]
    limited = ["sh", "-c", f'ulimit -n {count}; exec "$@"', "sh", *words]
    process = subprocess.run(limited, cwd=tmp_path, env=env, capture_output=True, text=True, timeout=100)
    assert process.returncode == 1
    assert "Traceback" not in process.stderr
    no_files = rf"this process has as many files open as it may \({count}; ulimit -n\): .*"
    too_few = rf"32 open files are needed, and this process may have {count} \(ulimit -n\): raise the limit"
    assert re.fullmatch(rf"trundle( \w+)?: error: .*({no_files}|{too_few})", process.stderr.splitlines()[-1])


def test_other_errors_are_not_shortages() -> None:
    incomplete_write = BlockingIOError(errno.EAGAIN, "write could not complete without blocking", 0)
    assert [
        shortage(error)
        for error in (None, ValueError("x"), incomplete_write, ImportError("x"), OSError(errno.EIO, "x"))
    ] == [None] * 5
    assert "can be started" in str(shortage(BlockingIOError(errno.EAGAIN, os.strerror(errno.EAGAIN))))
