"""Suppression of output that Qhull and V-HACD print from C."""

import os
import tempfile
import threading
from collections.abc import Generator
from contextlib import ExitStack, contextmanager

_STREAMS = (b"qhull", b"vhacd")
_swap = threading.Lock()


@contextmanager
def native_output_hidden() -> Generator[None]:
    """Redirect stdout and stderr; output of other threads is written afterwards."""
    with _swap, ExitStack() as streams:
        for number in (1, 2):
            streams.enter_context(_redirected(number))
        yield


@contextmanager
def _redirected(number: int) -> Generator[None]:
    try:
        screen = os.dup(number)
    except OSError:  # closed, as by `trundle … 2>&-`
        yield
        return
    with tempfile.TemporaryFile() as caught:
        os.dup2(caught.fileno(), number)
        try:
            yield
        finally:
            os.dup2(screen, number)
            os.close(screen)
            caught.seek(0)
            output = caught.read()
            if not any(name in output.lower() for name in _STREAMS):
                _write_all(number, output)


def _write_all(number: int, output: bytes) -> None:
    while output:
        output = output[os.write(number, output) :]
