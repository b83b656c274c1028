"""A node's launch-prefix: words before its program, and whether the program is to have a terminal."""

import os
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

_WINDOWS = """
    alacritty gnome-terminal kitty konsole lxterm lxterminal mate-terminal qterminal rxvt terminator tilix urxvt uxterm
    x-terminal-emulator xfce4-terminal xterm
"""
"""Programs that open a window with a terminal."""
_SCREENS = frozenset({"byobu", "screen", "tmux"})
"""Programs that keep what runs in their terminal, after options of their own."""
_DEBUGGERS = frozenset({"cgdb", "gdb", "gdbtui", "ipdb", "ipdb3", "lldb", "pdb", "pdb3", "pudb", "pudb3"})
_BEFORE_COMMAND = frozenset({"-e", "-x", "--", "--execute"})
"""Options of a window behind which the command stands that it runs."""


@dataclass(frozen=True, slots=True)
class LaunchPrefix:
    """Words before a node's program."""

    words: tuple[str, ...] = ()
    wants_terminal: bool = False
    """True: the program reads keys, or draws on a screen."""
    fault: str | None = None
    """Reason for which words of the prefix are left out; None: all are used."""
    program_fault: str | None = None
    """The same, of the programs that a terminal does not take the place of."""


def read_prefix(words: Sequence[str], env: Mapping[str, str]) -> LaunchPrefix:
    """Return the part of a launch-prefix that can start a program here.

    A window stays where it can open; elsewhere the program gets a terminal of ours.
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
    """Return the words of a window that are a command; usually none, since that is the node's program."""
    return next((words[i + 1 :] for i, word in enumerate(words) if word in _BEFORE_COMMAND), ())


def _is_debugger(words: Sequence[str]) -> bool:
    module = next((words[i + 1] for i, word in enumerate(words[:-1]) if word == "-m"), "")
    return Path(words[0]).name in _DEBUGGERS or module in _DEBUGGERS
