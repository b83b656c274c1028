"""Terminals of a launch's nodes: on the page, or the one in which the launch runs."""

import os
import sys
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from trundle.base.supervisor import HAS_PSEUDO_TERMINALS, Terminal
from trundle.robots.launch import LaunchNode

if TYPE_CHECKING:
    from trundle.page.terminals import PageTerminals

TerminalOutput: TypeAlias = Terminal | Literal["inherited"]
"""A terminal of ours, or the one in which the launch runs."""


class NodeTerminals:
    """Gives each node that asks for a terminal one of its own on the page.

    Without a page the first such node has the terminal in which the launch runs, and no other has one.
    """

    def __init__(self, page: "PageTerminals | None", *, reads_keys: bool) -> None:
        """Prepare.

        Args:
            page: None: there is no page.
            reads_keys: nodes may read the terminal in which the launch runs.
        """
        self.page = page
        self._modes = _terminal_modes() if reads_keys else None
        self._is_given = False

    @property
    def reads_keys(self) -> bool:
        """True if nodes read the launch's terminal, as all nodes of roslaunch do; False once it is given to one."""
        return self._modes is not None and not self._is_given

    def find(self, name: str, *, is_process: bool) -> TerminalOutput | None:
        """Return the terminal of a node; None: there is none for it."""
        if self.page is not None:
            return self.page.add(name) if HAS_PSEUDO_TERMINALS or not is_process else None
        if not self.reads_keys or not sys.stdout.isatty():
            return None
        self._is_given = True
        return "inherited"

    def why_none(self, node: LaunchNode) -> str:
        """Sentence on why there is no terminal for a node, and what to do."""
        why = "there is no terminal to read keys from; without --headless the page has one"
        if self.page is not None:
            why = "Windows has no pseudo-terminals"
        elif self._is_given:
            why = "another node has the only terminal; without --headless each has one on the page"
        return f"{why}; or run it by itself: {exec_command(node)}"

    def recover(self) -> None:
        """Have Ctrl-C end the launch again after a node that had taken it for itself; to be called as nodes end."""
        if self._modes is not None:
            import termios

            if not termios.tcgetattr(0)[3] & termios.ISIG:
                self.close()

    def close(self) -> None:
        """Restore the modes of the terminal in which the launch runs, which a node may have changed."""
        if self._modes is not None and _has_keys():
            import termios

            termios.tcsetattr(0, termios.TCSADRAIN, self._modes)


def exec_command(node: LaunchNode) -> str:
    """Return the command that runs a node by itself, in the terminal of a person."""
    return f"trundle exec {node.package} {node.type}"


def _terminal_modes() -> list[Any] | None:
    """Return the modes of the terminal at standard input; None if this process does not have its keys."""
    if not HAS_PSEUDO_TERMINALS or not _has_keys():
        return None
    import termios

    return termios.tcgetattr(0)


def _has_keys() -> bool:
    """Tell if the keys of standard input are for this process; changing the modes would stop it else."""
    try:
        return os.tcgetpgrp(0) == os.getpgrp()
    except OSError:  # it is no terminal
        return False
