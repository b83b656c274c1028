"""Key presses for teleop nodes: from the node's terminal, else from this process's, which one node can read."""

import asyncio
import os
import sys
from collections.abc import Generator
from contextlib import contextmanager
from importlib.util import find_spec

from trundle.base.supervisor import Terminal

_CTRL_C = "\x03"
_ARROWS = {"\x1b[A": "up", "\x1b[B": "down", "\x1b[C": "right", "\x1b[D": "left"}


class Keyboard:
    """Reads keys in cbreak mode, so that Ctrl-C still ends the launch, or the terminal's node."""

    _is_in_use = False

    def __init__(self, terminal: Terminal | None) -> None:
        """Create; `terminal` None: terminal of this process."""
        self._terminal = terminal
        self._keys: asyncio.Queue[str] = asyncio.Queue(maxsize=100)

    @property
    def is_available(self) -> bool:
        """True if there is a terminal that no other node is reading."""
        if self._terminal is not None:
            return True
        return find_spec("termios") is not None and sys.stdin.isatty() and not Keyboard._is_in_use

    @staticmethod
    def advice(topic: str) -> str:
        """Return advice for a node without a terminal that publishes velocity commands on a topic."""
        return (
            f'no terminal to read keys from: launch-prefix="xterm -e" gives this node one on the page; '
            f"or publish on {topic}, as the page's drive disc does"
        )

    def print(self, text: str) -> None:
        """Print a text and a newline."""
        if self._terminal is None:
            print(text)
        else:
            self._terminal.write(f"{text}\n")

    @contextmanager
    def cbreak(self) -> Generator[None]:
        """Read keys for the duration of the context."""
        if self._terminal is None:
            with self._process_cbreak():
                yield
            return
        task = asyncio.current_task()
        assert task is not None, "nodes run in tasks"

        def receive(text: str) -> None:
            if _CTRL_C in text:
                task.cancel()
            self._put(text)

        self._terminal.listen(receive)
        try:
            yield
        finally:
            self._terminal.listen(None)

    @contextmanager
    def _process_cbreak(self) -> Generator[None]:
        """Set cbreak mode of this process's terminal for the duration of the context."""
        import termios
        import tty

        descriptor = sys.stdin.fileno()
        before = termios.tcgetattr(descriptor)
        loop = asyncio.get_running_loop()
        Keyboard._is_in_use = True
        tty.setcbreak(descriptor)
        loop.add_reader(descriptor, self._read, descriptor)
        try:
            yield
        finally:
            loop.remove_reader(descriptor)
            termios.tcsetattr(descriptor, termios.TCSADRAIN, before)
            Keyboard._is_in_use = False

    async def read_key(self, timeout_s: float | None = None) -> str | None:
        """Return the next key: a character, 'up', 'down', 'left' or 'right'; None on timeout."""
        try:
            async with asyncio.timeout(timeout_s):
                return await self._keys.get()
        except TimeoutError:
            return None

    def _read(self, descriptor: int) -> None:
        self._put(os.read(descriptor, 1024).decode(errors="replace"))

    def _put(self, text: str) -> None:
        for key in split_keys(text):
            if not self._keys.full():
                self._keys.put_nowait(key)


def split_keys(text: str) -> list[str]:
    """Split terminal input into keys."""
    keys: list[str] = []
    while text:
        arrow = _ARROWS.get(text[:3])
        keys.append(arrow or text[0])
        text = text[3 if arrow else 1 :]
    return keys
