"""Key presses in the terminal, for teleop nodes; one node of a launch reads the terminal."""

import asyncio
import os
import sys
from collections.abc import Generator
from contextlib import contextmanager
from importlib.util import find_spec

from trundle.ros import Node

_ARROWS = {"\x1b[A": "up", "\x1b[B": "down", "\x1b[C": "right", "\x1b[D": "left"}


class Keyboard:
    """Reads keys in cbreak mode, so that Ctrl-C still ends the launch."""

    _taken = False

    def __init__(self, node: Node) -> None:
        self._node = node
        self._keys: asyncio.Queue[str] = asyncio.Queue(maxsize=100)

    @property
    def is_available(self) -> bool:
        """True if stdin is a terminal that no other node reads."""
        return find_spec("termios") is not None and sys.stdin.isatty() and not Keyboard._taken

    @contextmanager
    def cbreak(self) -> Generator[None]:
        """Set cbreak mode for the duration of the context."""
        import termios
        import tty

        descriptor = sys.stdin.fileno()
        before = termios.tcgetattr(descriptor)
        loop = asyncio.get_running_loop()
        Keyboard._taken = True
        tty.setcbreak(descriptor)
        loop.add_reader(descriptor, self._read, descriptor)
        try:
            yield
        finally:
            loop.remove_reader(descriptor)
            termios.tcsetattr(descriptor, termios.TCSADRAIN, before)
            Keyboard._taken = False

    async def read_key(self, timeout_s: float | None = None) -> str | None:
        """Next key: a character, 'up', 'down', 'left' or 'right'; None on timeout."""
        try:
            async with asyncio.timeout(timeout_s):
                return await self._keys.get()
        except TimeoutError:
            return None

    def _read(self, descriptor: int) -> None:
        for key in split_keys(os.read(descriptor, 1024).decode(errors="replace")):
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
