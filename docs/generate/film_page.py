"""The page in Chromium, for videos."""

import io
from types import TracebackType
from typing import Self
from urllib.parse import quote

import msgspec
from PIL import Image
from playwright.sync_api import Error, sync_playwright

CHROMIUM = "/usr/bin/chromium"
SOFTWARE_GL = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
SIZE = (1440, 900)
"""Width and height of the browser's window [px]."""
PATIENCE_MS = 300_000
KNOB_REACH_PX = 32
_TIME = "header .read:not(.rtf) b"


class FilmPage:
    """A page whose robot is driven by the joystick disc."""

    def __init__(self, url: str, view: dict[str, object]) -> None:
        """Wait for the server, and open the page with a view of the world."""
        self._playwright = sync_playwright().start()
        self._browser = self._playwright.chromium.launch(executable_path=CHROMIUM, args=list(SOFTWARE_GL))
        width, height = SIZE
        self._page = self._browser.new_page(viewport={"width": width, "height": height}, color_scheme="dark")
        self._page.set_default_timeout(PATIENCE_MS)
        address = f"{url}#view={quote(msgspec.json.encode(view).decode())}"
        while not self._answers(address):
            self._page.wait_for_timeout(500)
        self._page.locator(".disc").wait_for()
        self._is_held = False

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._browser.close()
        self._playwright.stop()

    def _answers(self, address: str) -> bool:
        try:
            self._page.goto(address)
        except Error:
            return False
        return True

    def hide_display(self, name: str) -> None:
        """Hide a display."""
        self._page.get_by_role("tab", name="Displays").click()
        self._page.get_by_role("checkbox", name=f"Show {name}", exact=True).uncheck()
        self._page.get_by_role("tab", name="World").click()

    def plot(self, search: str, curves: tuple[str, ...], *, window: str) -> None:
        """Plot values found by a search, in a time window."""
        self._page.get_by_role("button", name="Add curve").first.click()
        self._page.get_by_label("Search values").fill(search)
        for curve in curves:
            self._page.get_by_role("treeitem").filter(has_text=curve).click()
        self._page.get_by_role("button", name="Close", exact=True).click()
        self._page.get_by_label("Time window").select_option(window)

    def play(self) -> None:
        """Start the simulation."""
        self._page.get_by_role("button", name="Play").click()

    def drive(self, forwards: float, left: float) -> None:
        """Hold the disc at ratios of the maximum velocities."""
        box = self._page.locator(".disc").bounding_box()
        assert box is not None
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        if not self._is_held:
            self._page.mouse.move(x, y)
            self._page.mouse.down()
            self._is_held = True
        self._page.mouse.move(x - KNOB_REACH_PX * left, y - KNOB_REACH_PX * forwards)

    @property
    def time(self) -> str:
        """Simulation time shown on the page."""
        return self._page.locator(_TIME).inner_text()

    def wait_for_time_after(self, time: str) -> None:
        """Wait until the page shows a different time."""
        changed = "([where, before]) => document.querySelector(where).textContent !== before"
        self._page.wait_for_function(changed, arg=[_TIME, time], polling=50)

    def picture(self) -> Image.Image:
        """Return a screenshot of the page."""
        return Image.open(io.BytesIO(self._page.screenshot())).convert("RGB")
