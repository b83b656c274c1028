"""A running command and its page in a browser."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

PATIENCE_S = 120.0


@contextmanager
def running_page(
    *words: str, environment: dict[str, str], folder: Path | None = None, output: IO[str] | None = None
) -> Generator[str]:
    """Run a command until its page is served; yield the page's address, then send SIGINT.

    Args:
        words: arguments of `trundle`.
        environment: variables in addition to this process'.
        folder: working folder; None: this process'.
        output: file for the command's standard output.
    """
    process = subprocess.Popen(
        [sys.executable, "-m", "trundle", *words],
        stderr=subprocess.PIPE,
        stdout=output or subprocess.DEVNULL,
        text=True,
        env={**os.environ, **environment},
        start_new_session=True,
        cwd=folder,
    )
    assert process.stderr is not None
    errors = ""
    timeout = threading.Timer(PATIENCE_S, os.killpg, (process.pid, signal.SIGKILL))
    timeout.start()
    try:
        for line in process.stderr:
            errors += line
            if match := re.search(r"see it at (http://\S+)", line):
                timeout.cancel()
                yield match[1]
                os.killpg(process.pid, signal.SIGINT)
                _, rest = process.communicate(timeout=PATIENCE_S)
                assert "Traceback" not in errors + rest
                assert process.returncode == 130
                return
        raise AssertionError(f"no page: {errors}")
    finally:
        timeout.cancel()
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()


@contextmanager
def opened(chromium: Any, url: str, *, width: int = 1200) -> Generator[Any]:
    page = chromium.new_page(viewport={"width": width, "height": 900})
    page.set_default_timeout(PATIENCE_S * 1000)
    page.goto(url)
    yield page
    page.close()


def until(page: Any, reached: Callable[[], object], what: str) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while not reached():
        assert time.monotonic() < deadline, what
        page.wait_for_timeout(200)
