"""Debian's Chromium, headless, with its default renderer: the CPU on machines without a graphics card."""

import importlib.util
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

_PROGRAM = Path("/usr/bin/chromium")
_FLAGS = ("--no-sandbox", "--enable-unsafe-swiftshader")
"""SwiftShader provides WebGL. `--use-gl` and `--use-angle` would compose the page on an emulated graphics card."""


def is_installed() -> bool:
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
