"""A user splits the view into panes, turns, selects and moves in each; pictures and the simulation are checked."""

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from numpy.typing import NDArray
from PIL import Image
from tests.page.built_client import needs_client
from tests.page.scene_user import VIEW_CANVAS
from tests.page.test_user_views import BLUE, GREEN, RED, WIDTH_M, WORLD, Looker
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]
Rectangle = dict[str, float]


class PaneUser(Looker):
    """Takes pictures of single panes by their names."""

    def names(self) -> list[str]:
        return [str(name) for name in self.page.locator(".panename").all_inner_texts()]

    def active(self) -> str:
        return str(self.page.locator(".panename.on").inner_text())

    def frame(self, name: str) -> Rectangle:
        """Return the uncovered part of a pane, below its name [px]."""
        pane = self.page.locator(".pane").filter(has=self.page.get_by_role("button", name=name, exact=True))
        box, title = pane.bounding_box(), pane.locator(".panename").bounding_box()
        below = self.page.locator(".dock").bounding_box()["y"]
        right = min(box["x"] + box["width"], self.page.locator(".right").bounding_box()["x"])
        left, top = title["x"], title["y"] + title["height"] + 40
        return {"x": left, "y": top, "width": right - left - 80, "height": min(box["y"] + box["height"], below) - top}

    def shot(self, name: str) -> NDArray[np.uint8]:
        """Return the picture of a pane (height, width, 3)."""
        return np.asarray(Image.open(io.BytesIO(self.page.screenshot(clip=self.frame(name)))).convert("RGB"))

    def centre(self, name: str, color: tuple[int, int, int]) -> tuple[float, float, float]:
        """Return the middle, in the page, and the width of the area with a color in a pane [px]."""
        mask = (np.abs(self.shot(name).astype(int) - color) < 12).all(axis=-1)
        rows, columns = np.nonzero(mask)
        assert rows.size, f"nothing in {name} is {color}"
        frame = self.frame(name)
        return frame["x"] + columns.mean(), frame["y"] + rows.mean(), float(columns.max() - columns.min() + 1)

    def still(self) -> None:
        self.until_still(self.page.screenshot)

    def open_menu(self, name: str, entry: str) -> None:
        self.page.locator(".panename").get_by_role("button", name=name, exact=True).click()
        self.page.get_by_role("menuitem", name=entry, exact=True).click()


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--no-ros", "--pause", "--port", "0")
    with running_page(*words, environment={"HOME": str(folder)}, folder=folder) as url:
        yield url


@pytest.fixture(scope="module")
def user(chromium: Any, url: str) -> Iterator[PaneUser]:
    user = PaneUser(chromium, url)
    user.page.keyboard.press("Escape")
    user.page.set_viewport_size({"width": 1440, "height": 1000})
    user.side("Views")
    user.set("Distance [m]", "9")
    user.side("Inspector")
    yield user
    user.close()


def test_four_panes_show_the_world_from_four_sides(user: PaneUser) -> None:
    """The first keeps its view; the others show the world from the sides in their names."""
    user.run("Four views")
    user.page.locator(".panename").nth(3).wait_for()
    assert user.names() == ["Perspective", "Top", "Front", "Right"]
    user.still()
    for name, color in zip(user.names(), (GREEN, GREEN, BLUE, GREEN), strict=True):
        user.centre(name, color)


def test_a_drag_turns_the_pane_in_which_it_starts(user: PaneUser) -> None:
    """It continues over the next pane, and does not turn others."""
    frame = user.frame("Perspective")
    x, y = frame["x"] + frame["width"] - 10, frame["y"] + frame["height"] - 10
    user.page.mouse.move(x, y)
    user.still()
    before = {name: user.shot(name) for name in user.names()}
    user.page.mouse.down()
    user.page.mouse.move(x - 500, y, steps=4)
    user.page.mouse.up()
    user.still()
    assert user.active() == "Perspective"
    changed = [name for name, picture in before.items() if not np.array_equal(picture, user.shot(name))]
    assert changed == ["Perspective"]


def test_the_wheel_zooms_the_pane_under_the_pointer(user: PaneUser) -> None:
    x, y, width = user.centre("Top", RED)
    user.page.mouse.move(x, y)
    user.page.mouse.wheel(0, -200)
    user.still()
    assert user.centre("Top", RED)[2] > 1.1 * width
    assert user.active() == "Perspective"
    user.page.mouse.wheel(0, 200)
    user.still()


@pytest.mark.parametrize(
    ("pane", "color", "model"), [("Top", BLUE, "blue"), ("Right", RED, "red"), ("Top", GREEN, "cart")]
)
def test_a_click_selects_an_object_in_the_pane(
    user: PaneUser, pane: str, color: tuple[int, int, int], model: str
) -> None:
    x, y, _ = user.centre(pane, color)
    user.page.mouse.click(x, y)
    user.page.get_by_text(f"link of {model}").wait_for()
    assert user.active() == pane


def test_an_arrow_moves_a_model_by_the_panes_scale(user: PaneUser) -> None:
    """A drag of 60 px along x in the pane Top, in which the red box is 0.4 m wide."""
    user.pick("red")
    user.tool("Move")
    user.still()
    x, y, width = user.centre("Top", RED)
    user.page.mouse.move(x + 80, y)
    user.page.mouse.down()
    user.page.mouse.move(x + 140, y, steps=3)
    user.page.mouse.up()
    moved = 60 * WIDTH_M / width
    user.until(
        lambda: user.position("red")[0] == pytest.approx(moved, rel=0.15), what=f"{user.position('red')}, not {moved}"
    )
    assert user.position("red")[1:] == pytest.approx((0, 0.2), abs=1e-3)
    user.button("Undo: Pose of red").click()
    user.until(lambda: abs(user.position("red")[0]) < 1e-3)
    user.tool("Interact")
    user.page.keyboard.press("Escape")


def test_a_key_activates_the_next_pane(user: PaneUser) -> None:
    """V activates the next pane, which the arrows turn."""
    user.page.locator(VIEW_CANVAS).focus()
    names = user.names()
    at = names.index(user.active())
    user.page.keyboard.press("v")
    assert user.active() == names[(at + 1) % 4]
    user.page.keyboard.press("Shift+V")
    assert user.active() == names[at]
    user.still()
    before = {name: user.shot(name) for name in names}
    user.page.keyboard.press("ArrowLeft")
    user.still()
    changed = [name for name in names if name not in user.names() or not np.array_equal(before[name], user.shot(name))]
    assert changed in ([names[at]], [])  # seen straight from above, the box turns about itself


def test_a_pane_looks_through_a_camera(user: PaneUser) -> None:
    """The camera is chosen in the pane's menu; the red face fills its frame there as it fills its picture."""
    user.open_menu("Right", "Through eye")
    user.page.locator(".pane .cameraframe").wait_for()
    assert user.active().startswith("Camera")
    user.still()
    frame = user.page.locator(".cameraframe").bounding_box()
    pane = user.page.locator(".pane.on").bounding_box()
    assert pane["x"] <= frame["x"]
    assert frame["x"] + frame["width"] <= pane["x"] + pane["width"] + 1


def test_a_link_restores_all_panes(chromium: Any, url: str, user: PaneUser) -> None:
    """The user who follows it has their own layout again at the page's address."""
    user.run("Share")
    link = user.field("Link").input_value()
    user.page.keyboard.press("Escape")
    other = PaneUser(chromium, link)
    other.page.locator(".panename").nth(3).wait_for()
    other.until(lambda: other.page.locator(".panename").nth(1).inner_text().startswith("Top"))
    assert len(other.names()) == 4
    other.page.goto(url)
    other.page.get_by_role("treeitem").first.wait_for()
    assert other.page.locator(".panename").count() == 0
    other.close()


def test_a_file_restores_all_panes(user: PaneUser, tmp_path: Path) -> None:
    """rviz finds the active pane's view in the file."""
    names, active = user.names(), user.active()
    with user.page.expect_download() as download:
        user.run("Download as .rviz")
    file = tmp_path / "four.rviz"
    download.value.save_as(file)
    views = yaml.safe_load(file.read_text())["Visualization Manager"]["Views"]
    panes = views["Trundle Panes"]
    assert views["Current"] == panes["Panes"][panes["Active"]]
    user.run("One view")
    user.page.locator(".panename").first.wait_for(state="detached")
    with user.page.expect_file_chooser() as chooser:
        user.run("Open an .rviz file")
    chooser.value.set_files(file)
    user.page.locator(".panename").nth(3).wait_for()
    assert (user.names(), user.active()) == (names, active)


def test_one_pane_is_restored_and_the_choice_is_remembered(user: PaneUser) -> None:
    user.open_menu("Front", "Only this one")
    user.page.locator(".panename").first.wait_for(state="detached")
    user.run("Two views, stacked")
    user.page.locator(".panename").nth(1).wait_for()
    user.page.reload()
    user.page.locator(".panename").nth(1).wait_for()
    first, second = user.page.locator(".pane").all()
    assert first.bounding_box()["width"] == second.bounding_box()["width"] == 1440
    user.page.set_viewport_size({"width": 390, "height": 844})
    user.page.locator(".panename").first.wait_for(state="detached")  # a phone has one pane
    user.page.set_viewport_size({"width": 1440, "height": 1000})
    user.run("One view")
    user.page.locator(".panename").first.wait_for(state="detached")
