"""User of the 3D view of a real graph, which looks straight down with a pixel per centimetre."""

import io
import json
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from tests.page.panel_user import PanelUser

PX_PER_M = 100.0
_TOP = 48
"""Height of the bar and a gap [px]."""
VIEW_CANVAS = "canvas[aria-label='3D view']"
Point = tuple[float, float]
Color = tuple[int, int, int]


def rviz_text(*displays: dict[str, Any]) -> str:
    """Return an .rviz file of these displays on a black background, seen from above.

    It is JSON, which is also YAML.
    """
    view = {"Class": "rviz/TopDownOrtho", "Scale": PX_PER_M, "X": 0, "Y": 0, "Angle": 0}
    options = {"Fixed Frame": "map", "Background Color": "0; 0; 0"}
    content = {"Displays": displays, "Global Options": options, "Views": {"Current": view}}
    return json.dumps({"Visualization Manager": content})


class SceneUser(PanelUser):
    """Uses tools at points of the ground [m], and takes pictures."""

    def __init__(self, browser: Any, url: str) -> None:
        """Open the page, in a size that a browser draws on the CPU pixel by pixel."""
        super().__init__(browser, url, size=(1280, 760))

    def at(self, point: Point) -> Point:
        """Return the position of a point of the ground in the page [px]; the origin is in the middle of the view."""
        style = "getComputedStyle(document.documentElement)"
        left, right, bottom = (
            self.page.evaluate(f"parseFloat({style}.getPropertyValue('--in-{edge}'))") for edge in "lrb"
        )
        width, height = self.page.viewport_size["width"], self.page.viewport_size["height"]
        return (
            (left + width - right) / 2 + PX_PER_M * point[0],
            (_TOP + height - bottom) / 2 - PX_PER_M * point[1],
        )

    def tool(self, name: str) -> None:
        self.page.get_by_role("toolbar", name="Tools").get_by_role("button", name=name, exact=True).click()

    def click(self, point: Point, *, button: str = "left") -> None:
        self.page.mouse.click(*self.at(point), button=button)

    def drag(self, *points: Point) -> None:
        """Press at the first point, move over the others in small steps, release at the last."""
        self.page.mouse.move(*self.at(points[0]))
        self.page.mouse.down()
        for point in points[1:]:
            self.page.mouse.move(*self.at(point), steps=10)
        self.page.mouse.up()

    def picture(self) -> NDArray[np.uint8]:
        """Return the picture (height, width, 3) of the ground within ±2.5 m and ±1.5 m of the origin."""
        left, top = self.at((-2.5, 1.5))
        clip = {"x": left, "y": top, "width": 5 * PX_PER_M, "height": 3 * PX_PER_M}
        return np.asarray(Image.open(io.BytesIO(self.page.screenshot(clip=clip))).convert("RGB"))

    @property
    def is_something_drawn(self) -> bool:
        return bool((self.picture().max(axis=-1) > 40).sum() > 20)

    def sees_at(self, point: Point) -> bool:
        """Tell if anything is drawn within 5 cm of a point of the ground."""
        row, column = round((1.5 - point[1]) * PX_PER_M), round((point[0] + 2.5) * PX_PER_M)
        return bool(self.picture()[row - 5 : row + 6, column - 5 : column + 6].any())

    def area(self, color: Color) -> float:
        """Return the area of the ground that has a color [m²]."""
        return float((np.abs(self.picture().astype(int) - color) < 12).all(axis=-1).sum() / PX_PER_M**2)

    def until_area(self, color: Color, area: float, *, within: float = 0.1) -> None:
        """Wait until an area of the ground [m²] has a color, within a relative tolerance."""
        areas: list[float] = []

        def is_so() -> bool:
            areas.append(self.area(color))
            return abs(areas[-1] - area) <= within * area + 1e-3

        try:
            self.until(is_so)
        except AssertionError:
            raise AssertionError(f"{color} has {areas[-1]} m², not {area}") from None

    def side(self, name: str) -> None:
        """Open a tab of a side panel."""
        tab = self.page.get_by_role("tab", name=name)
        (tab if tab.count() == 1 else self.page.locator(".rail").get_by_role("button", name=name)).click()

    def open_rows(self, *names: str) -> None:
        """Open nested rows of the tree of displays."""
        for name in names:
            row = self.page.get_by_role("treeitem").filter(has_text=name).first
            row.click()
            if row.get_attribute("aria-expanded") == "false":
                row.press("ArrowRight")

    def property(self, name: str) -> Any:
        """Return the editor of a property in the side panels."""
        return self.page.locator(f'aside :is(input, select)[aria-label="{name}"]')

    def set(self, name: str, value: str) -> None:
        """Type a property's value and press Enter."""
        self.property(name).fill(value)
        self.property(name).press("Enter")
