"""`trundle exec`: which of several programs of one name runs."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.cli.conftest import PATIENCE_S

COMMAND = [sys.executable, "-m", "trundle", "exec", "my_robot", "fly"]


@pytest.fixture
def programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Two of one name, each of which says where it is."""
    (tmp_path / "package.xml").write_text("<package><name>my_robot</name></package>")
    paths = [tmp_path / folder / "fly" for folder in ("new", "old")]
    for path in paths:
        path.parent.mkdir()
        path.write_text('#!/bin/sh\necho "$0"\n')
        path.chmod(0o755)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    return paths


def test_without_a_terminal_the_first_runs_and_the_others_are_named(programs: list[Path]) -> None:
    first, other = programs
    done = subprocess.run(
        COMMAND, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE_S, check=True
    )
    assert done.stdout == f"{first}\n"
    assert done.stderr == f"[rosrun] Running {first}; of the same name are {other}\n"


def test_at_a_terminal_the_user_chooses(programs: list[Path]) -> None:
    ours, theirs = os.openpty()
    try:
        os.write(ours, b"3\n2\n")
        done = subprocess.run(COMMAND, stdin=theirs, capture_output=True, text=True, timeout=PATIENCE_S, check=True)
    finally:
        os.close(ours)
        os.close(theirs)
    assert done.stdout == (
        "[rosrun] You have chosen a non-unique executable, please pick one of the following:\n"
        f"1) {programs[0]}\n2) {programs[1]}\n#? ERROR: please enter a number from 1 to 2 (ctrl-C to cancel)\n"
        f"{programs[1]}\n"
    )
    assert done.stderr == ""
