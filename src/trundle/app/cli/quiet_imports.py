"""Silent end of the process on Ctrl-C during imports."""

import signal
from collections.abc import Generator
from contextlib import contextmanager

from trundle.base.garbage import no_garbage


@contextmanager
def quiet_imports() -> Generator[None]:
    """Let Ctrl-C end the process silently during imports, since some modules convert KeyboardInterrupt to errors."""
    old_handler = signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        with no_garbage():
            yield
    finally:
        signal.signal(signal.SIGINT, old_handler)
