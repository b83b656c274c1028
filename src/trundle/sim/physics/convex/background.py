"""Cutting of hollow meshes on a thread of its own, while their hulls stand in."""

import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from trundle.base.diagnostics import UsageError

if TYPE_CHECKING:  # a world without hollow meshes starts without what cuts them
    from .pieces import ConcavePart, ConvexPieces


class BackgroundCutting:
    """Cuts the parts that compiles of one world ask for; a compile after `on_done` finds their pieces."""

    def __init__(self, say: Callable[[str], object], on_done: Callable[[int], object]) -> None:
        """Prepare.

        Args:
            say: prints a line when hulls stand in.
            on_done: called on the thread, with the number of parts that are cut, when no more wait.
        """
        self._say = say
        self._on_done = on_done
        self._lock = threading.Lock()
        self._waiting: list[ConcavePart] = []
        self._asked: set[str] = set()
        """Keys of the parts that wait or are being cut."""
        self._is_running = False
        self._is_closed = False
        self.failed: set[str] = set()
        """Keys of the parts that could not be cut."""
        self._store: Callable[[ConcavePart, ConvexPieces], object] | None = None

    def cut(self, parts: "Sequence[ConcavePart]", store: "Callable[[ConcavePart, ConvexPieces], object]") -> None:
        """Cut parts, besides those that are being cut, and store their pieces."""
        with self._lock:
            self._store = store
            self._waiting += [part for part in parts if part.key not in self._asked]
            self._asked.update(part.key for part in parts)
            if self._waiting and not self._is_running:
                self._is_running = True
                threading.Thread(target=self._run, name="trundle-meshes", daemon=True).start()

    def close(self) -> None:
        """Cut no more after the current part."""
        self._is_closed = True

    def _run(self) -> None:
        from .jobs import decompose_parts

        count = 0
        with suppress(UsageError):  # of Ctrl-C, which ends the program
            while parts := self._next_parts():
                self._say(f"hulls stand in for {len(parts)} hollow meshes until they are cut into convex pieces")
                for part, pieces in decompose_parts(parts, redraws=False):
                    if self._is_closed:
                        return
                    self._keep(part, pieces)
                    count += pieces is not None
            self._on_done(count)

    def _next_parts(self) -> "list[ConcavePart]":
        """Return the parts that wait; without any, the thread ends."""
        with self._lock:
            parts, self._waiting = self._waiting, []
            self._is_running = bool(parts)
            return parts

    def _keep(self, part: "ConcavePart", pieces: "ConvexPieces | None") -> None:
        if pieces is None:
            self.failed.add(part.key)
        elif self._store is not None:
            self._store(part, pieces)
        with self._lock:
            self._asked.discard(part.key)
