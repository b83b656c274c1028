"""Owner's side of a worker process: a row in, its result out, even if the process ends."""

import os
import pickle
import subprocess
import sys
import threading
import time
from contextlib import suppress
from queue import Empty, SimpleQueue
from typing import Generic

from trundle.base.diagnostics import TrundleError
from trundle.base.extras import import_extra

from .job import Job, JobResult, T

_ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Environment of a single-threaded worker: there is one per processor."""
_ATTEMPTS = 2
"""Number of processes that may end while running a row before the row counts as lost."""
_MEMORY_POLL_S = 0.05


class _EndedError(Exception):
    """The process has ended."""


class WorkerProcess(Generic[T]):
    """Process that runs rows in sequence, restarted when it ends; one thread uses it, any thread may close it."""

    def __init__(self, job: Job[T]) -> None:
        """Start the process without waiting until it is ready."""
        self._job = job
        self._closing = threading.Lock()
        self._is_closed = False
        self._is_ready = False
        if job.memory_limit_bytes is not None:
            import_extra("psutil")
        self._start()

    def _start(self) -> None:
        with self._closing:
            if self._is_closed:
                return
            self._is_ready = False
            # No `multiprocessing`: its spawn runs the user's own script again.
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-m", "trundle.base.workers.worker"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                env={**os.environ, **_ONE_THREAD},
            )
            self._results: SimpleQueue[tuple[T] | None] = SimpleQueue()
            """1-tuples of values; None: the process has ended."""
            self._reader = threading.Thread(target=self._read, args=(self._process, self._results), daemon=True)
            self._reader.start()
        self._send(self._job)

    @staticmethod
    def _read(process: "subprocess.Popen[bytes]", results: "SimpleQueue[tuple[T] | None]") -> None:
        assert process.stdout is not None
        with suppress(EOFError, OSError, ValueError, pickle.UnpicklingError):
            while True:
                results.put((pickle.load(process.stdout),))
        process.wait()
        results.put(None)

    def _send(self, request: object) -> None:
        assert self._process.stdin is not None
        with suppress(OSError, ValueError):  # the process has ended, which the reader's thread reports
            pickle.dump(request, self._process.stdin, protocol=5)
            self._process.stdin.flush()

    def run(self, row: int) -> JobResult[T]:
        """Run a row; if the process ends, retry it once in a new one.

        Raises:
            TrundleError: the process does not start.
        """
        for attempt in range(1, _ATTEMPTS + 1):
            try:
                self._wait_ready()
                return JobResult(row=row, value=self._value(row))
            except TimeoutError:
                reason = f"longer than the time limit of {self._job.time_limit_s:g} s"
                self._restart()
                return JobResult(row=row, failure="timeout", reason=reason)
            except MemoryError:
                reason = f"more than the memory limit of {(self._job.memory_limit_bytes or 0) / 1e6:g} MB"
                self._restart()
                return JobResult(row=row, failure="memory", reason=reason)
            except _EndedError:
                reason = f"its process ended: {self._exit_reason}"
                self._restart()
                if attempt == _ATTEMPTS or self._is_closed:
                    return JobResult(row=row, failure="lost", reason=reason)
        raise AssertionError("the last attempt returns")

    def _wait_ready(self) -> None:
        if self._is_ready:
            return
        if self._results.get() is None:
            if self._is_closed:
                raise _EndedError
            raise TrundleError(f"a worker process does not start: {self._exit_reason}; its error is above")
        self._is_ready = True

    def _value(self, row: int) -> T:
        """Return a row's value.

        Raises:
            TimeoutError: it exceeds the time limit.
            MemoryError: it exceeds the memory limit.
            _EndedError: the process has ended.
        """
        job = self._job
        self._send(row)
        deadline_s = None if job.time_limit_s is None else time.monotonic() + job.time_limit_s
        while True:
            wait_s = None if deadline_s is None else max(deadline_s - time.monotonic(), 0.0)
            if job.memory_limit_bytes is not None:
                wait_s = _MEMORY_POLL_S if wait_s is None else min(wait_s, _MEMORY_POLL_S)
            try:
                result = self._results.get(timeout=wait_s)
            except Empty:
                if deadline_s is not None and time.monotonic() >= deadline_s:
                    raise TimeoutError from None
                if job.memory_limit_bytes is not None and self._memory_bytes() > job.memory_limit_bytes:
                    raise MemoryError from None
            else:
                if result is None:
                    raise _EndedError
                return result[0]

    def _memory_bytes(self) -> int:
        """Return the resident memory of the process and its descendants."""
        psutil = import_extra("psutil")
        total = 0
        with suppress(psutil.Error):
            process = psutil.Process(self._process.pid)
            for member in (process, *process.children(recursive=True)):
                with suppress(psutil.Error):
                    total += member.memory_info().rss
        return total

    @property
    def _exit_reason(self) -> str:
        """Exit code or signal that ended the process."""
        code = self._process.wait()
        return f"exit code {code}" if code >= 0 else f"signal {-code}"

    def _restart(self) -> None:
        self._end()
        self._start()

    def _end(self) -> None:
        self._process.kill()
        self._process.wait()
        self._reader.join()
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):
                assert pipe is not None
                pipe.close()

    def close(self) -> None:
        """Kill the process; a running row is lost."""
        with self._closing:
            self._is_closed = True
        self._end()
