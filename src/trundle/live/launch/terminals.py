"""Terminals of a launch's nodes: on the page, or the launch's own."""

import os
import sys
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from trundle.base.supervisor import HAS_PSEUDO_TERMINALS, Terminal
from trundle.robots.launch import LaunchNode

if TYPE_CHECKING:
    from trundle.page.terminals import PageTerminals

TerminalOutput: TypeAlias = Terminal | Literal["inherited"]
"""A terminal on the page, or the one in which the launch runs."""


class NodeTerminals:
    """Opens a terminal on the page for each node that needs one.

    Without a page, the first such node gets the terminal in which the launch runs, and the others none.
    """

    def __init__(self, page: "PageTerminals | None", *, reads_keys: bool) -> None:
        """Prepare.

        Args:
            page: terminals on the page; None: there is no page.
            reads_keys: True: nodes may read the terminal in which the launch runs.
        """
        self.page = page
        self._modes = _terminal_modes() if reads_keys else None
        self._is_assigned = False

    @property
    def reads_keys(self) -> bool:
        """True if all nodes read the launch's terminal, as in roslaunch; False once it is assigned to one of them."""
        return self._modes is not None and not self._is_assigned

    def find(self, name: str, *, is_process: bool) -> TerminalOutput | None:
        """Return a terminal for a node; None: there is none."""
        if self.page is not None:
            return self.page.add(name) if HAS_PSEUDO_TERMINALS or not is_process else None
        if not self.reads_keys or not sys.stdout.isatty():
            return None
        self._is_assigned = True
        return "inherited"

    def reason_for_none(self, node: LaunchNode) -> str:
        """Reason why a node has no terminal, and what to do, for messages."""
        reason = "there is no terminal to read keys from; without --headless the page has one"
        if self.page is not None:
            reason = "Windows has no pseudo-terminals"
        elif self._is_assigned:
            reason = "another node has the only terminal; without --headless each has one on the page"
        return f"{reason}; or run it by itself: {exec_command(node)}"

    def recover(self) -> None:
        """Let Ctrl-C end the launch again after a node disabled that; to be called when a node ends."""
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
    """Return the command that runs a node by itself in a terminal."""
    return f"trundle exec {node.package} {node.type}"


def _terminal_modes() -> list[Any] | None:
    """Return the modes of the terminal at standard input; None if this process does not receive its keys."""
    if not HAS_PSEUDO_TERMINALS or not _has_keys():
        return None
    import termios

    return termios.tcgetattr(0)


def _has_keys() -> bool:
    """True if this process receives the keys of standard input; otherwise changing the modes would stop it."""
    try:
        return os.tcgetpgrp(0) == os.getpgrp()
    except OSError:  # not a terminal
        return False
