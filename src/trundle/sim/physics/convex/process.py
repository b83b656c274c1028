"""Client side of a decomposition process."""

import atexit
import os
import pickle
import signal
import subprocess
import sys
from contextlib import suppress

from .pieces import ConcavePart, ConvexPieces

_INTERRUPTED = (-signal.SIGINT, 0xC000013A)
"""Exit codes after Ctrl-C, also on Windows."""
_ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Single-threaded: there is one process per processor."""


class DecompositionProcess:
    """Process that runs `worker`; restarted after a crash."""

    def __init__(self) -> None:
        """Start the process without waiting for it."""
        self._is_closed = False
        self._start()

    def _start(self) -> None:
        self._is_ready: bool | None = None
        # No `multiprocessing`: its spawn runs the user's own script again.
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "trundle.sim.physics.convex.worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, **_ONE_THREAD},
        )
        atexit.register(self._process.kill)

    @property
    def has_started(self) -> bool:
        """True if the process started; waits for it."""
        if self._is_ready is None:
            assert self._process.stdout is not None
            try:
                pickle.load(self._process.stdout)
                self._is_ready = True
            except (OSError, EOFError, pickle.UnpicklingError):
                self._is_ready = False
                self._raise_if_interrupted()
        return self._is_ready

    def decompose(self, part: ConcavePart) -> ConvexPieces | None:
        """Decompose a part; None on failure.

        Raises:
            InterruptedError: Ctrl-C ended the process, or it was closed.
        """
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        try:
            pickle.dump(part, self._process.stdin, protocol=5)
            self._process.stdin.flush()
            return pickle.load(self._process.stdout)
        except (OSError, ValueError, EOFError, pickle.UnpicklingError):
            self._raise_if_interrupted()
            self._end()
            self._start()
            return None

    def close(self) -> None:
        """Kill the process."""
        self._is_closed = True
        self._end()

    def _raise_if_interrupted(self) -> None:
        if self._is_closed or self._process.wait() in _INTERRUPTED:
            raise InterruptedError

    def _end(self) -> None:
        self._process.kill()
        self._process.wait()
        atexit.unregister(self._process.kill)
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):  # unread data is lost
                assert pipe is not None
                pipe.close()
