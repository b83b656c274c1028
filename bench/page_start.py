"""The page in headless Chromium: time from the printed URL of `trundle run` until the world is drawn."""

import statistics
import time
from typing import Any

from bench.chromium import chromium, is_installed
from bench.running_page import running_page
from bench.table import Row

_RUNS = 3
_PATIENCE_MS = 120_000
_DRAWN = """() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(() => {
  const gl = document.querySelector("canvas[aria-label='3D view']").getContext("webgl2");
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits until everything is drawn
  requestAnimationFrame(() => requestAnimationFrame(resolve));  // and shown
}))))"""


def run() -> list[Row]:
    """Time a few page loads in one running browser."""
    if not is_installed():
        return []
    with chromium() as browser:
        seconds = [_usable_s(browser) for _ in range(_RUNS)]
    return [Row("RP2W at home: page usable after its URL", statistics.median(seconds), "s", "", None)]


def _usable_s(browser: Any) -> float:
    """Return the time from the printed URL until the page is usable [s]."""
    page = browser.new_page(viewport={"width": 1440, "height": 900})  # the window is open before the start
    with running_page("rp2w_at_home.world") as url:
        started = time.monotonic()
        page.goto(url, wait_until="commit")
        page.get_by_role("button", name="Pause").first.wait_for(timeout=_PATIENCE_MS)
        page.get_by_role("treeitem").filter(has_text="rp2w").first.wait_for(timeout=_PATIENCE_MS)
        page.locator(".scene-note").wait_for(state="detached", timeout=_PATIENCE_MS)
        page.evaluate(_DRAWN)
        elapsed_s = time.monotonic() - started
        page.close()
    return elapsed_s
