"""Terminals of nodes on the page: output to it, input from it."""

from trundle.base.supervisor import Terminal
from trundle.page import TERMINAL, NodeTerminal, PageServer

from .shared_page import SharedPage

_PROGRAM = "xterm"
"""Program that the panel replaces."""


class PageTerminals:
    """Terminals, numbered in the order in which they were added; used on the graph's loop."""

    def __init__(self, page: SharedPage) -> None:
        self._page = page
        self._terminals: list[tuple[str, Terminal]] = []
        self._shown: list[int] = []
        """Change count of each terminal when it was last sent to the page; −1: never sent."""

    def __bool__(self) -> bool:
        return bool(self._terminals)

    def add(self, name: str) -> Terminal:
        """Add the terminal of a node."""
        terminal = Terminal()
        self._terminals.append((name, terminal))
        self._shown.append(-1)
        panels = self._page.session.panels
        self._page.change(panels=panels if _PROGRAM in panels else (*panels, _PROGRAM))
        return terminal

    def update(self, server: PageServer) -> None:
        """Send changed terminals that are watched to the page, and input to the terminals; call it often."""
        for typed in server.terminal_inputs():
            if typed.number < len(self._terminals):
                _, terminal = self._terminals[typed.number]
                if typed.size is not None:
                    terminal.resize(*typed.size)
                terminal.type(typed.text)
        for number, (_, terminal) in enumerate(self._terminals):
            stream, shown = f"{TERMINAL}{number}", self._shown[number]
            if terminal.changes != shown and (shown < 0 or server.is_watched(stream)):
                self._shown[number] = terminal.changes
                server.put_terminal(stream, terminal.first, (terminal.columns, terminal.rows), terminal.scrollback)
        states = tuple(NodeTerminal(name=name, ended=terminal.ended) for name, terminal in self._terminals)
        if states != self._page.session.terminals:
            self._page.change(terminals=states)
