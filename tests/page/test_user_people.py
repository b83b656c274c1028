"""Two users of one simulation, one of them view-only; the simulation's state is checked."""

import re
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from tests.page.built_client import needs_client
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]

BOX = "<geometry><box><size>0.6 0.6 0.4</size></box></geometry>"
WORLD = f"""<sdf version="1.6"><world name="yard"><model name="crate"><pose>0 0 0.2 0 0 0</pose><static>1</static>
<link name="base"><collision name="c">{BOX}</collision><visual name="v">{BOX}</visual></link></model></world></sdf>"""
ACCENT_COLOR = (10, 111, 130)
"""--accent of the light theme, the browsers' default."""
PERSON_COLORS = ((154, 90, 0), (122, 63, 192))
"""--person-1 and --person-2."""
KEYS = (" ", ".", "Shift+R", "Delete", "Shift+C", "h", "w")


@pytest.fixture(scope="module")
def owner(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[WorldUser]:
    """Open the page of a world with its token."""
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--no-ros", "--pause", "--port", "0", "--view-only")
    with running_page(*words, environment={"HOME": str(folder)}, folder=folder) as url:
        owner = WorldUser(chromium, url)
        owner.look_down()
        yield owner
        owner.close()


@pytest.fixture(scope="module")
def viewer(chromium: Any, owner: WorldUser) -> Iterator[WorldUser]:
    """Open the view-only link in another browser profile."""
    owner.button("Search commands, Ctrl K").click()
    owner.page.get_by_role("combobox", name="Search commands").fill("share")
    owner.page.keyboard.press("Enter")
    owner.button("View only").click()
    owner.page.get_by_text("can neither drive nor change anything.").wait_for()
    link = owner.page.get_by_role("textbox", name="Link").input_value()
    owner.page.keyboard.press("Escape")
    viewer = WorldUser(chromium, link)
    yield viewer
    viewer.close()


def test_users_see_each_others_selections(owner: WorldUser, viewer: WorldUser) -> None:
    """The selection has an outline in the other's color and a name; the number of users is shown."""
    owner.pick("crate")
    viewer.page.keyboard.press("Escape")
    for user in (owner, viewer):
        user.button("2 people").wait_for()
    viewer.until(lambda: _has(viewer, PERSON_COLORS[0]), what="for the outline of Person 1")
    assert not _has(viewer, ACCENT_COLOR)
    viewer.pick("crate")
    owner.until(lambda: _has(owner, PERSON_COLORS[1]), what="for the outline of Person 2")
    owner.button("2 people").click()
    menu = owner.page.get_by_role("menu")
    assert re.fullmatch(r"Person 1, you\s*Person 2\s*view only", menu.inner_text().strip())
    menu.get_by_text("Person 2").click()
    viewer.page.keyboard.press("Escape")
    owner.until(lambda: not _has(owner, PERSON_COLORS[1]), what="for the outline to go")


def test_a_view_only_page_has_a_notice_and_no_other_tools(owner: WorldUser, viewer: WorldUser) -> None:
    bar = viewer.page.get_by_role("banner")
    bar.get_by_text("View only").hover()
    viewer.page.get_by_role("tooltip").get_by_text("This link is view-only.").wait_for()
    for name in ("Play", "Step 1", "Reset", "Record"):
        assert owner.page.get_by_role("banner").get_by_role("button", name=name, exact=True).count() == 1
        assert bar.get_by_role("button", name=name, exact=True).count() == 0
    tools = viewer.page.get_by_role("toolbar", name="Tools").get_by_role("button")
    offered = [tools.nth(i).get_attribute("aria-label") for i in range(tools.count())]
    assert offered == ["Interact", "Measure", "More tools"]
    viewer.pick("crate")
    inspector = viewer.page.locator("aside").filter(has=viewer.page.get_by_role("heading", name="crate"))
    inspector.get_by_text("Pose").first.wait_for()
    assert inspector.get_by_role("spinbutton").count() + inspector.get_by_role("textbox").count() == 0


def test_keys_on_a_view_only_page_change_nothing(owner: WorldUser, viewer: WorldUser) -> None:
    before = owner.position("crate")
    viewer.pick("crate")
    for keys in KEYS:
        viewer.page.keyboard.press(keys)
    owner.button("Play").click()
    owner.until(lambda: not owner.is_paused)
    viewer.page.keyboard.press(" ")
    owner.button("Step 1").click()
    owner.until(lambda: owner.is_paused)

    assert [model["name"] for model in owner.manifest()["models"]] == ["crate"]
    assert owner.position("crate") == before


def _has(user: WorldUser, color: tuple[int, int, int]) -> bool:
    """Tell if the picture of the ground has an outline of a color."""
    return bool((np.abs(user.picture().astype(int) - color) < 25).all(axis=-1).sum() > 20)


def test_on_a_phone_the_whole_bar_is_visible(owner: WorldUser, viewer: WorldUser) -> None:
    ends = "[...document.querySelector('header').children].map(child => child.getBoundingClientRect().right)"
    for user in (owner, viewer):
        user.page.set_viewport_size({"width": 390, "height": 844})
        user.button("2 people").wait_for()
        assert max(user.page.evaluate(ends)) <= 390
        user.page.set_viewport_size({"width": 1440, "height": 900})
