"""Debian's Chromium, headless, which chooses how it draws: without a graphics card it composes pages on the CPU."""

import importlib.util
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

_PROGRAM = Path("/usr/bin/chromium")
_FLAGS = ("--no-sandbox", "--enable-unsafe-swiftshader")
"""The latter allows WebGL there. `--use-gl` and `--use-angle` would have an emulated graphics card compose the page."""


def is_there() -> bool:
    """Return whether the browser and Playwright are installed."""
    return _PROGRAM.exists() and importlib.util.find_spec("playwright") is not None


@contextmanager
def chromium() -> Generator[Any]:
    """Run the browser."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(_PROGRAM), args=list(_FLAGS))
        try:
            yield browser
        finally:
            browser.close()
