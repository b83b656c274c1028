"""Worker process, as seen from the sweep."""

import os
import pickle
import subprocess
import sys
import threading
import time
from collections import deque
from contextlib import suppress
from queue import SimpleQueue
from typing import TypeAlias

from trundle.trials import Plan, RowResult

_ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Single-threaded: there is one worker per processor."""
QUEUED = 2
"""Rows given to a worker: the one that runs and the next, so that it need not wait."""
News: TypeAlias = "tuple[WorkerProcess, RowResult | None]"
"""A result; None: the worker is ready or has ended."""


class WorkerProcess:
    """Process that runs rows one after the other."""

    def __init__(self, plan: Plan, news: "SimpleQueue[News]") -> None:
        """Start the process without waiting for it.

        Args:
            plan: its rows' plan.
            news: takes its results.
        """
        self.rows: deque[int] = deque()
        """Rows assigned to it, the running one first."""
        self.is_ready = False
        self.has_ended = False
        self._news = news
        self._started_s = 0.0
        # No `multiprocessing`: its spawn runs the user's own script again.
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "trundle.bringup.sweep.worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, **_ONE_THREAD},
        )
        self._send(plan)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self._process.stdout is not None
        with suppress(EOFError, OSError, ValueError, pickle.UnpicklingError):
            pickle.load(self._process.stdout)
            self.is_ready = True
            self._news.put((self, None))
            while True:
                self._news.put((self, pickle.load(self._process.stdout)))
        self._process.wait()
        self.has_ended = True
        self._news.put((self, None))

    def _send(self, what: object) -> None:
        assert self._process.stdin is not None
        with suppress(OSError):  # it has ended; its reader says so
            pickle.dump(what, self._process.stdin, protocol=5)
            self._process.stdin.flush()

    @property
    def wants_row(self) -> bool:
        """True if it can be assigned a row."""
        return self.is_ready and not self.has_ended and len(self.rows) < QUEUED

    def assign(self, row: int) -> None:
        """Assign it a row to run."""
        if not self.rows:
            self._started_s = time.monotonic()
        self.rows.append(row)
        self._send(row)

    def finish(self, row: int) -> None:
        """Count the running row as finished; the next one begins."""
        assert self.rows.popleft() == row
        self._started_s = time.monotonic()

    @property
    def running_s(self) -> float:
        """Wall time since its running row began [s]; 0: none runs."""
        return time.monotonic() - self._started_s if self.rows and not self.has_ended else 0.0

    @property
    def exit_reason(self) -> str:
        """Exit code or signal that ended the process."""
        code = self._process.poll()
        return f"exit code {code}" if code is None or code >= 0 else f"signal {-code}"

    def close(self) -> None:
        """Kill the process."""
        self._process.kill()
        self._process.wait()
        self._reader.join()
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):
                assert pipe is not None
                pipe.close()
