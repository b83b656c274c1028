"""Parallel decomposition in worker processes, which end with Ctrl-C or with this process."""

import os
import sys
import threading
from collections.abc import Generator, Sequence
from queue import Empty, SimpleQueue
from typing import TypeAlias

from trundle.base.diagnostics import UsageError

from .pieces import ConcavePart, ConvexPieces, decompose_part
from .process import DecompositionProcess
from .progress import DecompositionProgress

SHORT_S = 1.5
"""Longest work for this process [s]: V-HACD holds the GIL for a third of a second at a time."""
_WORKER_S = 0.5
"""Work that justifies one more process [s]."""
_TICK_S = 0.2
_Result: TypeAlias = tuple[ConcavePart, ConvexPieces | None] | None
"""Results of the workers; None: Ctrl-C ended a worker."""


def decompose_parts(
    parts: Sequence[ConcavePart], *, redraws: bool = True
) -> Generator[tuple[ConcavePart, ConvexPieces | None]]:
    """Decompose parts and yield each when done, with None for a failed one.

    Args:
        parts: parts to decompose.
        redraws: True: redraw a line of progress on a terminal; False: print lines.

    Raises:
        KeyboardInterrupt: Ctrl-C in the main thread.
        UsageError: Ctrl-C in another thread.
    """
    seconds = [part.seconds for part in parts]
    count = min(_processors(), int(sum(seconds) / _WORKER_S), len(parts))
    progress = DecompositionProgress(seconds, max(count, 1), redraws=redraws)
    try:
        if sum(seconds) <= SHORT_S or not sys.executable:
            for part in parts:
                yield part, _decompose_in_process(part)
                progress.done(part.seconds)
            return
        for part, pieces in _decompose_in_workers(parts, count, progress):
            progress.done(part.seconds)
            yield part, pieces
    finally:
        progress.close()


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1


def _decompose_in_process(part: ConcavePart) -> ConvexPieces | None:
    try:
        return decompose_part(part)
    except Exception:  # any failure falls back to the hull
        return None


def _decompose_in_workers(
    parts: Sequence[ConcavePart], count: int, progress: DecompositionProgress
) -> Generator[tuple[ConcavePart, ConvexPieces | None]]:
    # Longest first, so that no processor is left waiting for a long one.
    todo: SimpleQueue[ConcavePart] = SimpleQueue()
    for part in sorted(parts, key=lambda part: -part.seconds):
        todo.put(part)
    done: SimpleQueue[_Result] = SimpleQueue()
    workers: list[DecompositionProcess] = []
    try:
        workers.extend(DecompositionProcess() for _ in range(count))
        for worker in workers:
            threading.Thread(target=_work, args=(worker, todo, done), daemon=True).start()
        for _ in parts:
            yield _next(done, progress)
    finally:
        for worker in workers:
            worker.close()


def _work(worker: DecompositionProcess, todo: SimpleQueue[ConcavePart], done: SimpleQueue[_Result]) -> None:
    """Process queued parts until the queue is empty."""
    while True:
        try:
            part = todo.get_nowait()
        except Empty:
            return
        try:
            done.put((part, worker.decompose(part) if worker.has_started else _decompose_in_process(part)))
        except InterruptedError:
            done.put(None)
            return


def _next(done: SimpleQueue[_Result], progress: DecompositionProgress) -> tuple[ConcavePart, ConvexPieces | None]:
    while True:
        try:
            result = done.get(timeout=_TICK_S)
        except Empty:
            progress.show()
            continue
        if result is not None:
            return result
        if threading.current_thread() is threading.main_thread():
            raise KeyboardInterrupt
        raise UsageError("stopped during convex decomposition")
