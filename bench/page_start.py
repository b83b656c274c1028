"""The page in headless Chromium: time from its URL, which `trundle run` prints, until the world is drawn."""

import re
import signal
import statistics
import subprocess
import sys
import time
from typing import Any

from bench.chromium import chromium, is_there
from bench.table import Row

_RUNS = 3
_PATIENCE_MS = 120_000
_DRAWN = """() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(() => {
  const gl = document.querySelector("canvas[aria-label='3D view']").getContext("webgl2");
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits until all before it is drawn
  requestAnimationFrame(() => requestAnimationFrame(resolve));  // and shown
}))))"""


def run() -> list[Row]:
    """Time a few starts in one browser that is running already."""
    if not is_there():
        return []
    with chromium() as browser:
        seconds = [_usable_s(browser) for _ in range(_RUNS)]
    return [Row("RP2W at home: page usable after its URL", statistics.median(seconds), "s", "", None)]


def _usable_s(browser: Any) -> float:
    """Time from the printed URL until a person can use the page [s]."""
    page = browser.new_page(viewport={"width": 1440, "height": 900})  # a person's window is there already
    words = ("-m", "trundle", "run", "rp2w_at_home.world", "--no-ros", "--port", "0")
    with subprocess.Popen(
        [sys.executable, *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    ) as running:
        assert running.stderr is not None
        url = next(found[1] for line in running.stderr if (found := re.search(r"see it at (\S+)", line)))
        started = time.monotonic()
        page.goto(url, wait_until="commit")
        page.get_by_role("button", name="Pause").first.wait_for(timeout=_PATIENCE_MS)
        page.get_by_role("treeitem").filter(has_text="rp2w").first.wait_for(timeout=_PATIENCE_MS)
        page.locator(".scene-note").wait_for(state="detached", timeout=_PATIENCE_MS)
        page.evaluate(_DRAWN)
        taken_s = time.monotonic() - started
        page.close()
        running.send_signal(signal.SIGINT)
        running.communicate()
    return taken_s
