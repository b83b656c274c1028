"""A node's launch-prefix: words before its program, and whether the program needs a terminal."""

import os
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

_WINDOWS = """
    alacritty gnome-terminal kitty konsole lxterm lxterminal mate-terminal qterminal rxvt terminator tilix urxvt uxterm
    x-terminal-emulator xfce4-terminal xterm
"""
"""Terminal emulators: programs that open a window."""
_SCREENS = frozenset({"byobu", "screen", "tmux"})
"""Terminal multiplexers: they run a program in their own terminal."""
_DEBUGGERS = frozenset({"cgdb", "gdb", "gdbtui", "ipdb", "ipdb3", "lldb", "pdb", "pdb3", "pudb", "pudb3"})
_BEFORE_COMMAND = frozenset({"-e", "-x", "--", "--execute"})
"""Options of a terminal emulator that precede the command to run."""


@dataclass(frozen=True, slots=True)
class LaunchPrefix:
    """Words before a node's program."""

    words: tuple[str, ...] = ()
    needs_terminal: bool = False
    """True: the program reads keys, or draws on a screen."""
    fault: str | None = None
    """Reason why words of the prefix are left out; None: all are used."""
    program_fault: str | None = None
    """Reason why words that name a program other than a terminal are left out; None: all are used."""


def read_prefix(words: Sequence[str], env: Mapping[str, str]) -> LaunchPrefix:
    """Return the part of a launch-prefix that can start a program here.

    A terminal emulator is kept where it can open a window; elsewhere the program gets a terminal on the page.
    """
    if not words:
        return LaunchPrefix()
    program = Path(words[0]).name
    is_installed = shutil.which(words[0], path=env.get("PATH", os.defpath)) is not None
    fault = None if is_installed else f"there is no {program} here"
    if program in _WINDOWS.split():
        if is_installed and (env.get("DISPLAY") or env.get("WAYLAND_DISPLAY")):
            return LaunchPrefix(tuple(words))
        inner = read_prefix(_command(words), env)
        return LaunchPrefix(inner.words, True, fault or f"{program} needs a display", inner.program_fault)
    if program in _SCREENS:
        return LaunchPrefix(tuple(words) if is_installed else (), True, fault)
    return LaunchPrefix(tuple(words) if is_installed else (), is_installed and _is_debugger(words), fault, fault)


def _command(words: Sequence[str]) -> Sequence[str]:
    """Return the command among a terminal emulator's words; usually none, as the node's program follows."""
    return next((words[i + 1 :] for i, word in enumerate(words) if word in _BEFORE_COMMAND), ())


def _is_debugger(words: Sequence[str]) -> bool:
    module = next((words[i + 1] for i, word in enumerate(words[:-1]) if word == "-m"), "")
    return Path(words[0]).name in _DEBUGGERS or module in _DEBUGGERS
