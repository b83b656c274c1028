"""Decomposition of hollow meshes on a background thread, while their hulls stand in."""

import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from trundle.base.diagnostics import UsageError

if TYPE_CHECKING:  # worlds without hollow meshes do not import the decomposition
    from .pieces import ConcavePart, ConvexPieces


class BackgroundCutting:
    """Cuts the parts that compiles of one world request; a compile after `on_done` finds their pieces."""

    def __init__(self, log: Callable[[str], object], on_done: Callable[[int], object]) -> None:
        """Prepare.

        Args:
            log: called with a line when hulls stand in.
            on_done: called on the thread with the number of parts cut, when none is waiting.
        """
        self._log = log
        self._on_done = on_done
        self._lock = threading.Lock()
        self._waiting: list[ConcavePart] = []
        self._requested: set[str] = set()
        """Keys of the parts that are waiting or being cut."""
        self._is_running = False
        self._is_closed = False
        self.failed: set[str] = set()
        """Keys of the parts that could not be cut."""

    def cut(self, parts: "Sequence[ConcavePart]") -> None:
        """Cut parts that are not being cut already, and keep their pieces."""
        with self._lock:
            self._waiting += [part for part in parts if part.key not in self._requested]
            self._requested.update(part.key for part in parts)
            if self._waiting and not self._is_running:
                self._is_running = True
                threading.Thread(target=self._run, name="trundle-meshes", daemon=True).start()

    def close(self) -> None:
        """Cut no more after the current part."""
        self._is_closed = True

    def _run(self) -> None:
        from .mesh_decomposition import decompose_once

        count = 0
        with suppress(UsageError):  # from Ctrl-C, which ends the program
            while parts := self._next_parts():
                self._log(f"hulls stand in for {len(parts)} hollow meshes until they are cut into convex pieces")
                for part, pieces in decompose_once(parts, redraws=False):
                    if self._is_closed:
                        return
                    self._keep(part, pieces)
                    count += pieces is not None
            self._on_done(count)

    def _next_parts(self) -> "list[ConcavePart]":
        """Return the waiting parts; without any, the thread ends."""
        with self._lock:
            parts, self._waiting = self._waiting, []
            self._is_running = bool(parts)
            return parts

    def _keep(self, part: "ConcavePart", pieces: "ConvexPieces | None") -> None:
        if pieces is None:
            self.failed.add(part.key)
        with self._lock:
            self._requested.discard(part.key)
