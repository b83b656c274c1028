"""The page fits every window: nothing lies over another thing, and no text is cut without an ellipsis.

The boxes of everything shown are measured in Chromium, on the page's shell with a fake world.
"""

import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page.panel_user import PATIENCE_MS

_MEASURE = (Path(__file__).parent / "boxes.js").read_text()
_OPEN_LEFT = "document.querySelector('.rail.left .b')?.click()"
SIZES = ((1440, 900), (1280, 800), (1100, 800), (1024, 768), (900, 800), (768, 1024), (720, 900), (390, 844))
ZOOMED = tuple((width // 2, height // 2) for width, height in SIZES[:-1] if width // 2 >= 320)
"""The same windows at 200 %."""
NAMES = ("plain", "long", "cjk", "arabic")
PANELS = ("Plots", "Topics", "Log", "Graph", "Timeline")


class Shell:
    """The page's shell in a state that its address names."""

    def __init__(self, tab: Any, address: str, state: str) -> None:
        self.tab = tab
        tab.goto("about:blank")  # a new fragment alone loads nothing
        tab.goto(f"{address}/shell.html#{state}")
        tab.wait_for_selector(".dv-tab, .sheet")

    def faults(self, size: tuple[int, int], *, opens_left: bool = False) -> list[str]:
        """Return the faults of the layout in a window of a size [px], each a sentence with what it is about."""
        self.tab.set_viewport_size({"width": size[0], "height": size[1]})
        self._rest()
        if opens_left:
            self.tab.evaluate(_OPEN_LEFT)
            self._rest()
        return [f"{size[0]} × {size[1]}: {fault}" for fault in self.tab.evaluate(_MEASURE)]

    def _rest(self) -> None:
        """Wait until what follows the window's size has been drawn: several parts measure each other."""
        for _ in range(6):
            self.tab.evaluate("new Promise((done) => requestAnimationFrame(() => setTimeout(done)))")


@pytest.fixture
def tab(chromium: Any) -> Iterator[Any]:
    errors: list[str] = []
    tab = chromium.new_page(viewport={"width": SIZES[0][0], "height": SIZES[0][1]})
    tab.set_default_timeout(PATIENCE_MS)
    tab.on("pageerror", lambda error: errors.append(error.stack))
    yield tab
    tab.close()
    assert errors == []


@pytest.mark.parametrize("state", ["names=long&cameras=12&models=20", "view=rviz"])
def test_nothing_overlaps_and_nothing_is_cut(tab: Any, served: str, state: str) -> None:
    shell = Shell(tab, served, state)
    faults = [fault for size in (*SIZES, (720, 450)) for fault in shell.faults(size, opens_left=size[0] == 720)]

    assert faults == []


def test_the_measure_finds_what_overlaps_and_what_is_cut(tab: Any, served: str) -> None:
    shell = Shell(tab, served, "")
    tab.add_style_tag(content=".drive { left: auto !important; right: 100px } .tablist { max-width: 30px }")
    faults = " ".join(shell.faults((1280, 800)))

    assert "lies over div.drive" in faults
    assert "is cut off by" in faults


@pytest.mark.slow
@pytest.mark.parametrize("names", NAMES)
@pytest.mark.parametrize("view", ["", "view=rviz&"])
@pytest.mark.parametrize("theme", ["dark", "light"])
def test_every_window_fits_crowds_and_long_names(tab: Any, served: str, names: str, view: str, theme: str) -> None:
    state = f"{view}theme={theme}&names={names}&cameras=12&models=200&topics=100"
    faults: list[str] = []
    for panel, opens_left in itertools.product(PANELS, (False, True)):
        tab.set_viewport_size({"width": 1440, "height": 900})
        shell = Shell(tab, served, state)
        tab.locator(".dv-tab", has_text=panel).first.click()
        found = [fault for size in (*SIZES, *ZOOMED) for fault in shell.faults(size, opens_left=opens_left)]
        faults += [f"{panel}, {fault}" for fault in found]

    assert faults == []
