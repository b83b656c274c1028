"""A user views a simulated world without perspective, in first person, through a camera; pictures are checked."""

import io
import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from tests.page.built_client import needs_client
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]

FOV, NEAR_M, WIDTH_M = 1.2, 1.9, 0.4
"""Camera's horizontal field of view [rad], and distance and width of the face in front of it [m]."""


def _box(name: str, pose: str, rgb: str, inside: str = "") -> str:
    """Return a model of a cube of 0.4 m that glows in a color."""
    shape = f"<geometry><box><size>{WIDTH_M} {WIDTH_M} {WIDTH_M}</size></box></geometry>"
    black = "<ambient>0 0 0 1</ambient><diffuse>0 0 0 1</diffuse>"
    visual = f'<visual name="v">{shape}<material>{black}<emissive>{rgb} 1</emissive></material></visual>'
    return f'<model name="{name}"><pose>{pose}</pose><link name="base">{visual}{inside}</link></model>'


EYE = f"""<sensor name="eye" type="camera"><pose>0.3 0 0 0 0 0</pose><camera><horizontal_fov>{FOV}</horizontal_fov>
<image><width>80</width><height>60</height></image></camera></sensor>"""
WORLD = f"""<sdf version="1.6"><world name="yard"><scene><background>0 0 0 1</background><grid>0</grid></scene>
{_box("red", "0 0 0.2 0 0 0", "1 0 0")}{_box("blue", "-4 1 0.2 0 0 0", "0 0 1")}
{_box("cart", "-2.4 0 0.2 0 0 0", "0 1 0", EYE)}</world></sdf>"""
RED, BLUE, GREEN = (255, 0, 0), (0, 0, 255), (0, 255, 0)


class Looker(WorldUser):
    """Measures areas of a color in the whole page."""

    def extent(self, color: tuple[int, int, int]) -> tuple[int, int, int, int] | None:
        """Return left, right, top and bottom of the area with a color [px]; None if there is none."""
        mask = self.mask(color)
        rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
        return (int(columns[0]), int(columns[-1]), int(rows[0]), int(rows[-1])) if rows.size else None

    def mask(self, color: tuple[int, int, int]) -> NDArray[np.bool_]:
        """Return the mask (height, width) of a color."""
        picture = np.asarray(Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")).astype(int)
        return np.asarray((np.abs(picture - color) < 12).all(axis=-1))

    def width(self, color: tuple[int, int, int]) -> int:
        extent = self.extent(color)
        return 0 if extent is None else extent[1] - extent[0] + 1

    def run(self, command: str) -> None:
        """Run a command by its name."""
        self.page.keyboard.press("Control+k")
        self.page.get_by_role("combobox", name="Search commands").fill(command)
        self.page.keyboard.press("Enter")

    def view(self, type_: str, **properties: float) -> None:
        """Choose a type of view, and set properties."""
        self.side("Views")
        self.page.get_by_label("Type of view").select_option(type_)
        for name, value in properties.items():
            self.set(name.replace("_", " "), str(value))


@pytest.fixture(scope="module")
def user(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Looker]:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--no-ros", "--pause", "--port", "0")
    with running_page(*words, environment={"HOME": str(folder)}, folder=folder) as url:
        user = Looker(chromium, url)
        user.run("Show or hide the cameras")
        user.run("Clear the selection")
        user.side("Views")
        yield user
        user.close()


def test_without_perspective_distance_does_not_change_the_size(user: Looker) -> None:
    """Seen from the front, the blue box is four metres behind the red one."""
    user.page.get_by_role("button", name="Look from the front").click()
    user.set("Distance [m]", "12")
    user.until(lambda: user.width(RED) > 1.3 * user.width(BLUE) > 0)
    user.button("Orthographic").click()
    user.until(lambda: abs(user.width(RED) - user.width(BLUE)) <= 1 < user.width(BLUE))


def test_the_world_is_seen_from_every_side(user: Looker) -> None:
    """Without perspective; from the left x points to the left, from above and from the right to the right."""
    size = user.width(RED)
    for name, apart in (("Left", 10.0), ("Right", -10.0)):
        user.button(name).click()
        user.until(lambda apart=apart: abs(_between(user, RED, BLUE) / size - apart) < 0.6, what=name)
    user.button("Top").click()
    user.until(lambda: abs(_between(user, RED, BLUE) / size + 10.0) < 0.6, what="Top")
    user.button("Perspective").click()


def _between(user: Looker, first: tuple[int, int, int], second: tuple[int, int, int]) -> float:
    """Return the distance of the second color to the right of the first [px]."""
    a, b = user.extent(first), user.extent(second)
    return math.nan if a is None or b is None else (b[0] + b[1] - a[0] - a[1]) / 2


def test_first_person_looks_ahead_from_the_selection(user: Looker) -> None:
    """From the cart's roof, the red box is straight ahead below the horizon, and the cart's front is below it."""
    user.side("Inspector")
    user.pick("cart")
    user.run("First person from the selection")

    def is_ahead() -> bool:
        red, middle = user.extent(RED), user.at((0, 0))
        return (
            red is not None
            and abs((red[0] + red[1]) / 2 - middle[0]) < 3
            and red[2] > middle[1]
            and not user.width(BLUE)
        )

    user.until(is_ahead)
    user.run("First person from the selection")
    user.until(lambda: user.width(GREEN) > 0)
    user.run("Clear the selection")


def test_the_view_through_a_camera_has_its_field_of_view(user: Looker) -> None:
    """The red face, 1.9 m ahead of the eye, is as wide in the camera's frame as in its own pictures."""
    user.side("Views")
    user.button("eye").click()
    frame = user.page.locator(".cameraframe").bounding_box()
    assert frame is not None
    assert frame["width"] / frame["height"] == pytest.approx(80 / 60, rel=0.02)
    share = WIDTH_M / (2 * NEAR_M * math.tan(FOV / 2))
    user.until(lambda: abs(user.width(RED) - share * frame["width"]) <= 2)
    extent = user.extent(RED)
    assert extent is not None
    assert (extent[0] + extent[1]) / 2 == pytest.approx(frame["x"] + frame["width"] / 2, abs=2)
    user.page.mouse.move(*user.at((0.5, 0.5)))
    user.page.mouse.down()
    user.page.mouse.move(*user.at((1, 1)), steps=3)
    user.page.mouse.up()
    assert user.extent(RED) == extent
