"""Ctrl-C while modules are imported."""

import signal
from collections.abc import Generator
from contextlib import contextmanager

from trundle.garbage import no_garbage


@contextmanager
def quiet_imports() -> Generator[None]:
    """Let Ctrl-C end the process without a word while modules are loaded: some turn it into errors of their own."""
    before = signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        with no_garbage():
            yield
    finally:
        signal.signal(signal.SIGINT, before)
