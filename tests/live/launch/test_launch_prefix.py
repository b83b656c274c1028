"""Prefixes of nodes: which can start a program here, and which programs need a terminal."""

from pathlib import Path

import pytest

from trundle.live.launch.launch_prefix import LaunchPrefix, read_prefix


@pytest.fixture
def env(tmp_path: Path) -> dict[str, str]:
    """Environment without a display, where some programs are installed."""
    for name in ("gdb", "konsole", "nice", "python3", "screen", "valgrind"):
        (tmp_path / name).touch(mode=0o755)
    return {"PATH": str(tmp_path)}


@pytest.mark.parametrize(
    ("text", "words", "needs_terminal", "fault", "program_fault"),
    [
        ("", "", False, None, None),
        ("nice -n 5", "nice -n 5", False, None, None),
        ("valgrind --tool=memcheck", "valgrind --tool=memcheck", False, None, None),
        ("stdbuf -oL", "", False, "there is no stdbuf here", "there is no stdbuf here"),
        ("xterm -e", "", True, "there is no xterm here", None),
        ("/usr/bin/xterm -hold -e", "", True, "there is no xterm here", None),
        ("gnome-terminal --", "", True, "there is no gnome-terminal here", None),
        ("konsole -e", "", True, "konsole needs a display", None),
        ("xterm -e gdb -ex run --args", "gdb -ex run --args", True, "there is no xterm here", None),
        ("xterm -e lldb --", "", True, "there is no xterm here", "there is no lldb here"),
        ("rxvt -e nice -n 5", "nice -n 5", True, "there is no rxvt here", None),
        ("gdb -ex run --args", "gdb -ex run --args", True, None, None),
        ("python3 -m pdb", "python3 -m pdb", True, None, None),
        ("lldb --", "", False, "there is no lldb here", "there is no lldb here"),
        ("screen -S node", "screen -S node", True, None, None),
        ("tmux new", "", True, "there is no tmux here", None),
    ],
)
def test_launch_prefix_is_used_as_far_as_it_can_run(
    env: dict[str, str],
    text: str,
    words: str,
    needs_terminal: bool,
    fault: str | None,
    program_fault: str | None,
) -> None:
    expected = LaunchPrefix(tuple(words.split()), needs_terminal, fault, program_fault)
    assert read_prefix(text.split(), env) == expected


def test_a_terminal_window_opens_where_there_is_a_display(env: dict[str, str]) -> None:
    assert read_prefix(["konsole", "-e"], {**env, "DISPLAY": ":0"}) == LaunchPrefix(("konsole", "-e"))
