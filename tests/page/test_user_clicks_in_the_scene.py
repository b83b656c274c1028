"""A user clicks things in the 3D view, and finds their rows in the tree: open, scrolled to and selected."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

pytestmark = [needs_client, pytest.mark.slow]


def _box(name: str, size: float = 0.4) -> str:
    geometry = f"<geometry><box><size>{size} {size} 0.4</size></box></geometry>"
    return f'<link name="{name}"><visual name="v">{geometry}</visual></link>'


_POSTS = "".join(
    f'<model name="post_{i}"><static>1</static><pose>{8 + i} 0 0 0 0 0</pose>{_box("post")}</model>' for i in range(60)
)
WORLD = f"""<sdf version="1.6"><world name="yard">{_POSTS}
<model name="crate"><static>1</static><pose>-1 0 0.2 0 0 0</pose>{_box("side")}</model>
<model name="cart"><static>1</static><pose>1 0 0.2 0 0 0</pose>{_box("bed")}
<model name="tray"><pose>0 0.8 0 0 0 0</pose>{_box("board")}</model></model>
</world></sdf>"""
CRATE, BED, BOARD, GROUND = (-1.0, 0.0), (1.0, 0.0), (1.0, 0.8), (-1.0, 1.2)


@pytest.fixture
def user(chromium: Any, tmp_path: Path) -> Iterator[WorldUser]:
    (tmp_path / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--no-ros", "--pause", "--port", "0")
    with running_page(*words, environment={"HOME": str(tmp_path)}, folder=tmp_path) as url:
        user = WorldUser(chromium, url)
        user.page.locator(".loading").wait_for(state="detached")
        user.until_still(lambda: user.page.screenshot())  # it is framed once it is loaded
        user.look_down()
        user.until_still(lambda: user.picture().tobytes())
        yield user
        user.close()


_IS_IN_VIEW = """row => {
    const [box, list] = [row, row.closest(".scroll")].map((one) => one.getBoundingClientRect());
    return box.top >= list.top - 1 && box.bottom <= list.bottom + 1;
}"""


def _sees_row(user: WorldUser, name: str, *, tree: str = "World") -> None:
    """Wait until the selected row is this one, and visible in the tree."""
    rows = user.page.get_by_role("tree", name=tree).get_by_role("treeitem", selected=True)
    user.until(lambda: rows.locator("span.n").all_inner_texts() == [name], what=f"for the row of {name}")
    user.until(lambda: rows.first.evaluate(_IS_IN_VIEW), what=f"for the row of {name} in sight")


def test_a_click_opens_the_tree_at_the_row(user: WorldUser) -> None:
    assert user.page.get_by_role("treeitem").filter(has_text="side").count() == 0
    user.click(CRATE)
    _sees_row(user, "side")

    user.side("Displays")
    user.click(BED)
    assert user.page.get_by_role("tab", name="World", selected=True).count() == 1
    _sees_row(user, "bed")

    user.page.get_by_label("Search the world").fill("post_3")
    user.click(BOARD)
    _sees_row(user, "board")
    assert user.page.get_by_label("Search the world").input_value() == ""

    user.page.get_by_role("treeitem").filter(has_text="cart").first.press("ArrowLeft")
    user.until(lambda: user.page.get_by_role("treeitem", selected=True).count() == 0, what="for the closed model")
    user.tool("Move")
    user.click(CRATE)
    _sees_row(user, "side")
    user.click(BOARD)
    _sees_row(user, "board")


def test_a_menu_in_the_scene_selects_its_row_and_the_ground_selects_nothing(user: WorldUser) -> None:
    user.side("Displays")
    user.click(GROUND)
    assert user.page.get_by_role("tab", name="Displays", selected=True).count() == 1
    user.click(CRATE, button="right")
    user.page.get_by_role("menuitem", name="Delete").wait_for()
    user.page.keyboard.press("Escape")
    _sees_row(user, "side")


def test_a_click_in_the_model_editor_opens_the_row_of_a_part(user: WorldUser) -> None:
    user.click(BOARD, button="right")
    user.page.get_by_role("menuitem", name="Edit model…").click()
    user.page.get_by_role("tree", name="Model").wait_for()
    user.until(lambda: user.manifest().get("draft") is not None, what="for the draft")
    user.page.get_by_role("button", name="Add", exact=True).wait_for()
    user.click(BOARD)
    _sees_row(user, "board", tree="Model")
