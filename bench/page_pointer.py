"""The pointer in a world of 200 models: script time of hovering, selecting and dragging, by Chromium's own trace."""

import importlib.util
import json
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from bench.table import Row

_CHROMIUM = Path("/usr/bin/chromium")
_SOFTWARE_GL = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
_PATIENCE_MS = 120_000
_FRAME_US = 1e6 / 60
_ROWS, _COLUMNS, _GAP_M = 10, 20, 1.0
_EVENTS = 60
_POINTER = re.compile(r"pointer|mouse|click")


def run() -> list[Row]:
    """Measure in one browser."""
    if not _CHROMIUM.exists() or importlib.util.find_spec("playwright") is None:
        return []  # Debian's browser is what the figure is of
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(_CHROMIUM), args=list(_SOFTWARE_GL))
        shares = measure(browser)
        browser.close()
    return [
        Row(f"200 models, {what}: script per event", share, "% of frame", "", None) for what, share in shares.items()
    ]


def measure(browser: Any) -> dict[str, float]:
    """Return the script time of an event in percent of a frame of 1/60 s, by what a person does."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "many.sdf")
        file.write_text(_world())
        words = ("-m", "trundle", "run", str(file), "--no-ros", "--pause", "--port", "0")
        with subprocess.Popen(
            [sys.executable, *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        ) as running:
            assert running.stderr is not None
            url = next(found[1] for line in running.stderr if (found := re.search(r"see it at (\S+)", line)))
            page = browser.new_page(viewport={"width": 1440, "height": 900})
            page.set_default_timeout(_PATIENCE_MS)
            page.goto(url)
            page.get_by_label("Connected").first.wait_for()
            page.locator(".scene-note").wait_for(state="detached")
            page.get_by_role("button", name="Look from top").click()
            page.keyboard.press("Escape")
            page.wait_for_timeout(1000)
            shares = _by_gesture(browser, page)
            page.close()
            running.send_signal(signal.SIGINT)
            running.communicate()
    return shares


def _by_gesture(browser: Any, page: Any) -> dict[str, float]:
    left, right, y = 320, 1100, 300

    def over() -> None:
        for i in range(_EVENTS):
            page.mouse.move(left + (right - left) * i / _EVENTS, y + 40 * (i % 3))

    def select() -> None:
        for i in range(_EVENTS // 4):
            page.mouse.click(left + (right - left) * 4 * i / _EVENTS, y)

    def drag() -> None:
        page.mouse.down()
        over()
        page.mouse.up()

    def over_one() -> None:  # the hovered model stays, so that no picture is drawn
        for i in range(_EVENTS):
            page.mouse.move(left + i % 2, y)

    shares = {
        "hover": _share(browser, page, over_one, is_drawn=False),
        "select": _share(browser, page, select, is_drawn=True),
    }
    page.get_by_role("toolbar", name="Tools").get_by_role("button", name="Move", exact=True).click()
    page.mouse.move(left, y)
    shares["drag"] = _share(browser, page, drag, is_drawn=True)
    return shares


def _share(browser: Any, page: Any, act: Callable[[], None], *, is_drawn: bool) -> float:
    """Script time of the thread per pointer event, in percent of a frame.

    Args:
        browser: Chromium.
        page: with the world.
        act: moves or presses the pointer.
        is_drawn: True if frames draw pictures, which do not count; False: they search for what is under the pointer.
    """
    browser.start_tracing(page=page, categories=["devtools.timeline"])
    act()
    events = json.loads(browser.stop_tracing())["traceEvents"]
    dispatched = [each for each in events if each.get("name") == "EventDispatch" and _POINTER.search(_type(each))]
    count = sum(_type(each) in ("pointermove", "pointerdown", "pointerup") for each in dispatched)
    assert count >= _EVENTS // 4, "the page heard of no pointer"
    frames = [] if is_drawn else [each for each in events if each.get("name") == "FireAnimationFrame"]
    spent_us = sum(each.get("tdur", each.get("dur", 0)) for each in (*dispatched, *frames))
    return 100 * spent_us / count / _FRAME_US


def _type(event: Any) -> str:
    return str(event.get("args", {}).get("data", {}).get("type", ""))


def _world() -> str:
    """Return a world of 200 models of three visuals each."""
    shapes = ("<box><size>0.4 0.4 0.2</size></box>", "<sphere><radius>0.15</radius></sphere>")
    shapes += ("<cylinder><radius>0.1</radius><length>0.6</length></cylinder>",)
    visuals = "".join(f'<visual name="v{i}"><geometry>{shape}</geometry></visual>' for i, shape in enumerate(shapes))
    models = "".join(
        f'<model name="m{i}"><pose>{_GAP_M * (i % _COLUMNS)} {_GAP_M * (i // _COLUMNS)} 0 0 0 0</pose>'
        f'<link name="l">{visuals}</link></model>'
        for i in range(_ROWS * _COLUMNS)
    )
    return f'<sdf version="1.6"><world name="many">{models}</world></sdf>'
