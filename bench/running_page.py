"""A run with its page, whose process ends however the measurement ends."""

import re
import signal
import subprocess
import sys
from collections.abc import Generator
from contextlib import contextmanager

_PATIENCE_S = 60.0


@contextmanager
def running_page(*words: str) -> Generator[str]:
    """Run `trundle run` with a page at a free port; yield the page's address.

    Args:
        words: arguments of `trundle run`.
    """
    command = [sys.executable, "-m", "trundle", "run", *words, "--no-ros", "--port", "0"]
    running = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    assert running.stderr is not None
    try:
        address = (match[1] for line in running.stderr if (match := re.search(r"see it at (\S+)", line)))
        url = next(address, None)
        if url is None:
            raise RuntimeError(f"no page of: {' '.join(command)}")
        yield url
        running.send_signal(signal.SIGINT)
        running.communicate(timeout=_PATIENCE_S)
    finally:
        if running.poll() is None:
            running.kill()
            running.communicate()
