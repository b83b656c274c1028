"""Modules can be imported without Python's POSIX modules, as on Windows, and features degrade without tracebacks."""

import subprocess
import sys

import pytest

from trundle.app.cli.bag import play
from trundle.gazebo.nodes.keyboard import Keyboard

MODULES_OF_POSIX = (
    "crypt",
    "curses",
    "fcntl",
    "grp",
    "nis",
    "pty",
    "pwd",
    "readline",
    "resource",
    "syslog",
    "termios",
    "tty",
)

HIDE = """
import sys

class Absent:
    def find_spec(self, name, path=None, target=None):
        if name in HIDDEN:
            raise ModuleNotFoundError(f"No module named '{name}'", name=name)

for name in HIDDEN:
    sys.modules.pop(name, None)
sys.meta_path.insert(0, Absent())
"""
NEED_A_GPU = ("mujoco_warp", "warp")
"""Optional modules."""
IMPORT_ALL = f"""
NEED_A_GPU = {NEED_A_GPU!r}
import importlib, pkgutil, trundle, trundle.ros.rospy.finder

trundle.ros.rospy.finder.install()
found = [module.name for module in pkgutil.walk_packages(trundle.__path__, "trundle.")]
for name in found:
    try:
        importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name not in NEED_A_GPU:
            raise
print(len(found))
"""


def without(modules: tuple[str, ...], code: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", f"HIDDEN = {modules!r}\n{HIDE}\n{code}"]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)


def test_every_module_imports_without_posix_modules() -> None:
    imported = without(MODULES_OF_POSIX, IMPORT_ALL)

    assert imported.returncode == 0, imported.stderr
    assert int(imported.stdout) > 500


@pytest.mark.parametrize("name", ["fcntl", "termios"])
def test_the_modules_are_hidden(name: str) -> None:
    hidden = without(MODULES_OF_POSIX, f"import {name}")

    assert f"No module named '{name}'" in hidden.stderr


@pytest.fixture
def terminal_without_termios(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "termios", None)
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True, raising=False)


@pytest.mark.usefixtures("terminal_without_termios")
def test_a_bag_plays_without_keys_if_termios_is_missing(capsys: pytest.CaptureFixture[str]) -> None:
    with play._keys() as pressed:
        assert pressed() == ""

    assert "no pause, no step" in capsys.readouterr().err


@pytest.mark.usefixtures("terminal_without_termios")
def test_nodes_read_no_keys_if_termios_is_missing() -> None:
    assert not Keyboard(None).is_available
