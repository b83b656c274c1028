"""The pointer in a world of 200 models: script time of hovering, selecting and dragging, from Chromium's trace."""

import json
import re
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from bench.chromium import chromium, is_installed
from bench.running_page import running_page
from bench.table import Row

_PATIENCE_MS = 120_000
_FRAME_US = 1e6 / 60
_ROWS, _COLUMNS, _GAP_M = 10, 20, 1.0
_EVENTS = 60
_IDLE_MS = 2000
_POINTER = re.compile(r"pointer|mouse|click")


def run() -> list[Row]:
    """Measure in one browser."""
    if not is_installed():
        return []
    with chromium() as browser:
        shares = measure(browser)
    return [
        Row(f"200 models, {gesture}: script per event", share, "% of frame", "", None)
        for gesture, share in shares.items()
    ]


def measure(browser: Any) -> dict[str, float]:
    """Return gesture → script time per event in percent of a frame of 1/60 s."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "many.sdf")
        file.write_text(many_models())
        with running_page(str(file), "--pause") as url:
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
    return shares


def _by_gesture(browser: Any, page: Any) -> dict[str, float]:
    left, right, y = 320, 1100, 300

    def hover() -> None:
        for i in range(_EVENTS):
            page.mouse.move(left + (right - left) * i / _EVENTS, y + 40 * (i % 3))

    def select() -> None:
        for i in range(_EVENTS // 4):
            page.mouse.click(left + (right - left) * 4 * i / _EVENTS, y)

    def drag() -> None:
        page.mouse.down()
        hover()
        page.mouse.up()

    def hover_one() -> None:  # the hovered model stays the same, so that no picture is drawn
        for i in range(_EVENTS):
            page.mouse.move(left + i % 2, y)

    idle_us = _idle_frame_us(browser, page)
    shares = {"hover": _share(browser, page, hover_one, idle_us=idle_us), "select": _share(browser, page, select)}
    page.get_by_role("toolbar", name="Tools").get_by_role("button", name="Move", exact=True).click()
    page.mouse.move(left, y)
    shares["drag"] = _share(browser, page, drag)
    return shares


def _share(browser: Any, page: Any, act: Callable[[], None], *, idle_us: float | None = None) -> float:
    """Return the script time per pointer event, in percent of a frame.

    Args:
        browser: Chromium instance.
        page: page of the world.
        act: function that moves or presses the pointer.
        idle_us: script time of an idle frame [µs], for gestures that draw no pictures: longer frames, which search for
            the model under the pointer, count. None: frames draw pictures and do not count.
    """
    events = _trace(browser, page, act)
    dispatched = [event for event in events if event.get("name") == "EventDispatch" and _POINTER.search(_type(event))]
    count = sum(_type(event) in ("pointermove", "pointerdown", "pointerup") for event in dispatched)
    assert count >= _EVENTS // 4, "the page got no pointer events"
    spent_us = sum(map(_duration_us, dispatched))
    if idle_us is not None:
        frames = list(map(_duration_us, _frames(events)))
        spent_us += max(0.0, sum(frames) - len(frames) * idle_us)
    return 100 * spent_us / count / _FRAME_US


def _idle_frame_us(browser: Any, page: Any) -> float:
    frames = _frames(_trace(browser, page, lambda: page.wait_for_timeout(_IDLE_MS)))
    return sum(map(_duration_us, frames)) / len(frames)


def _trace(browser: Any, page: Any, act: Callable[[], None]) -> list[Any]:
    browser.start_tracing(page=page, categories=["devtools.timeline"])
    act()
    return list(json.loads(browser.stop_tracing())["traceEvents"])


def _frames(events: list[Any]) -> list[Any]:
    return [event for event in events if event.get("name") == "FireAnimationFrame"]


def _duration_us(event: Any) -> float:
    """Return the thread time of an event [µs], or its wall time if there is no thread time."""
    return float(event.get("tdur", event.get("dur", 0)))


def _type(event: Any) -> str:
    return str(event.get("args", {}).get("data", {}).get("type", ""))


def many_models(settings: str = "") -> str:
    """Return a world of 200 models of three visuals each; `settings`: further elements of the world."""
    shapes = ("<box><size>0.4 0.4 0.2</size></box>", "<sphere><radius>0.15</radius></sphere>")
    shapes += ("<cylinder><radius>0.1</radius><length>0.6</length></cylinder>",)
    visuals = "".join(f'<visual name="v{i}"><geometry>{shape}</geometry></visual>' for i, shape in enumerate(shapes))
    models = "".join(
        f'<model name="m{i}"><pose>{_GAP_M * (i % _COLUMNS)} {_GAP_M * (i // _COLUMNS)} 0 0 0 0</pose>'
        f'<link name="l">{visuals}</link></model>'
        for i in range(_ROWS * _COLUMNS)
    )
    return f'<sdf version="1.6"><world name="many">{settings}{models}</world></sdf>'
