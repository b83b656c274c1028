"""Nodes that read keys without a page: they get the launch's terminal, or an error with a remedy."""

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.graphs import PATIENCE_S, until
from tests.system.conftest import Running

from trundle.base.supervisor import HAS_PSEUDO_TERMINALS
from trundle.base.supervisor.terminal import LEADER

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not HAS_PSEUDO_TERMINALS, reason="Windows has no pseudo-terminals"),
]

MANIFEST = """<package><name>p</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>x</license></package>"""
RAW_KEY = """#!/usr/bin/env python3
import sys, tty
tty.setraw(sys.stdin)
print("raw at", sys.stdout.isatty(), end="\\r\\n", flush=True)
print("got", repr(sys.stdin.read(1)), end="\\r\\n", flush=True)
"""
LINE = """#!/usr/bin/env python3
print("line", repr(input()), flush=True)
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "p"
    folder.mkdir()
    (folder / "package.xml").write_text(MANIFEST)
    for name, text in (("raw_key.py", RAW_KEY), ("line.py", LINE)):
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
    return folder


def write_launch(package: Path, *nodes: str) -> Path:
    file = package / "main.launch"
    text = "".join(f"<node {node}/>" for node in nodes)
    file.write_text(f"<launch>{text}</launch>")
    return file


class TerminalUser:
    """User of the terminal of a launch."""

    def __init__(self, file: Path, env: dict[str, str]) -> None:
        self.descriptor, child_terminal = os.openpty()
        os.set_blocking(self.descriptor, False)
        launch = (sys.executable, "-m", "trundle", "launch", "--headless", str(file))
        self._process = subprocess.Popen(
            [sys.executable, "-I", "-S", str(LEADER), *launch],
            stdin=child_terminal,
            stdout=child_terminal,
            stderr=subprocess.PIPE,
            text=True,
            env=env,
            start_new_session=True,
        )
        self._child_terminal = child_terminal
        self.read = ""

    def until(self, condition: Callable[[], object]) -> None:
        end = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < end, f"waited in vain; read: {self.read}"
            try:
                self.read += os.read(self.descriptor, 4096).decode()
            except BlockingIOError:
                time.sleep(0.01)

    def type(self, keys: str) -> None:
        os.write(self.descriptor, keys.encode())

    def is_raw(self) -> bool:
        import termios

        return not termios.tcgetattr(self._child_terminal)[3] & termios.ICANON

    def end(self) -> str:
        """Press Ctrl-C; return the launch's standard error."""
        self.type("\x03")
        _, errors = self._process.communicate(timeout=PATIENCE_S)
        return errors


def test_the_first_node_with_an_xterm_prefix_gets_the_launchs_terminal(env: dict[str, str], package: Path) -> None:
    xterm = 'launch-prefix="xterm -e"'
    file = write_launch(
        package, f'pkg="p" type="raw_key.py" name="a" {xterm}', f'pkg="p" type="line.py" name="b" {xterm}'
    )
    user = TerminalUser(file, {**env, "ROS_PACKAGE_PATH": str(package.parent), "DISPLAY": ""})
    user.until(lambda: "raw at True" in user.read)
    assert user.is_raw()
    user.type("w")
    user.until(lambda: "got 'w'" in user.read)
    user.until(lambda: "[a-1] process has finished cleanly" in user.read)
    errors = user.end()

    assert "node /a: launch-prefix" not in errors
    reason = (
        "there is no xterm here, and another node has the only terminal; without --headless each has one on the page"
    )
    assert (
        f"node /b: launch-prefix 'xterm -e' is left out: {reason}; or run it by itself: trundle exec p line.py"
        in errors
    )
    assert not user.is_raw()


def test_a_node_without_a_prefix_reads_the_terminal_of_the_launch(env: dict[str, str], package: Path) -> None:
    """As in roslaunch."""
    file = write_launch(package, 'pkg="p" type="line.py" name="a" output="screen"')
    user = TerminalUser(file, {**env, "ROS_PACKAGE_PATH": str(package.parent)})
    user.until(lambda: "process[a-1]: started" in user.read)
    user.type("hello\n")
    user.until(lambda: "line 'hello'" in user.read)
    user.end()


def test_a_missing_terminal_is_explained(start: Callable[..., Running], package: Path) -> None:
    xterm = 'launch-prefix="xterm -e"'
    file = write_launch(
        package,
        f'pkg="p" type="raw_key.py" name="a" {xterm}',
        'pkg="p" type="line.py" name="b"',
        f'pkg="turtlesim" type="turtle_teleop_key" name="c" {xterm}',
    )
    launch = start("launch", "--headless", str(file), ROS_PACKAGE_PATH=str(package.parent), DISPLAY="")
    none = "there is no terminal to read keys from; without --headless the page has one; or run it by itself"
    advice = 'it reads keys, and has no terminal: launch-prefix="xterm -e" gives it one on the page'

    for line in (
        f"'xterm -e' is left out: there is no xterm here, and {none}: trundle exec p raw_key.py",
        f"'xterm -e' is left out: {none}: trundle exec turtlesim turtle_teleop_key",
        f"[a-1] {advice}; or run it by itself: trundle exec p raw_key.py",
        f"[b-2] {advice}; or run it by itself: trundle exec p line.py",
    ):
        until(lambda line=line: line in launch.output())
    launch.interrupt()
