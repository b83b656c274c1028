"""User of the dock's panels, in a real browser on a real graph."""

import time
from collections.abc import Callable
from typing import Any

from tests.graphs import PATIENCE_S

PATIENCE_MS = 180_000
_STILL_MS = 700
"""Time without a change after which a value is still: a scene at rest is drawn once more after 300 [ms]."""

_DROP = """([name, text]) => {
    const carried = new DataTransfer();
    carried.items.add(new File([text], name));
    for (const kind of ["dragover", "drop"])
        document.body.dispatchEvent(new DragEvent(kind, {dataTransfer: carried, bubbles: true, cancelable: true}));
}"""


class PanelUser:
    """Opens panels, and reads their contents."""

    def __init__(self, browser: Any, url: str, *, size: tuple[int, int] = (1440, 900)) -> None:
        """Open the page, and wait until it is connected."""
        self.page = browser.new_page(viewport={"width": size[0], "height": size[1]})
        self.page.set_default_timeout(PATIENCE_MS)
        self.faults: list[str] = []
        self.page.on("pageerror", self._note)
        self.page.goto(url)
        self.page.wait_for_selector(".dv-tab")
        self.page.get_by_label("Connected").first.wait_for()

    def open(self, title: str) -> None:
        """Bring a panel to the front, by its tab or by the dock's menu."""
        tab = self.page.locator(".dv-tab", has_text=title)
        if tab.count() == 0:
            self.button("Open a panel").click()
            self.page.get_by_role("menuitem", name=title, exact=True).click()
        else:
            tab.click()

    def button(self, name: str) -> Any:
        return self.page.get_by_role("button", name=name, exact=True)

    def field(self, name: str) -> Any:
        return self.page.get_by_role("textbox", name=name, exact=True)

    def type(self, name: str, text: str) -> None:
        """Type into a field and press Enter."""
        self.field(name).fill(text)
        self.field(name).press("Enter")

    def drop_file(self, name: str, text: str) -> None:
        """Drop a file onto the page."""
        self.page.evaluate(_DROP, [name, text])

    def sees(self, text: str, *, within: str = ".dockhost") -> None:
        """Wait until the dock shows a text."""
        self.page.locator(within).get_by_text(text).first.wait_for()

    def until(self, condition: Callable[[], object], *, what: str = "") -> None:
        """Wait until a condition holds; `what` is part of the error message."""
        end = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < end, f"waited in vain {what}; the page shows: {self.page.inner_text('body')}"
            self.page.wait_for_timeout(50)

    def until_still(self, sample: Callable[[], object]) -> None:
        """Wait until a value does not change for a while, compared by `==`."""

        def is_still() -> bool:
            before = sample()
            self.page.wait_for_timeout(_STILL_MS)
            return sample() == before

        self.until(is_still, what="for a value to be still")

    def close(self) -> None:
        self.page.close()
        assert self.faults == []

    def _note(self, error: Any) -> None:
        self.faults.append(str(error))
