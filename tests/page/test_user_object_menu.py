"""A user opens the menu of a model in scene and tree, by mouse, keyboard and touch; the simulation is checked."""

from collections.abc import Iterator
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.scene_user import VIEW_CANVAS
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]


def _box(name: str, pose: str, size: str, *, static: bool = False) -> str:
    """Return a model of a box with a collision and a visual."""
    shape = f"<geometry><box><size>{size}</size></box></geometry>"
    link = f'<link name="base"><collision name="c">{shape}</collision><visual name="v">{shape}</visual></link>'
    return f'<model name="{name}"><static>{int(static)}</static><pose>{pose}</pose>{link}</model>'


WORLD = f"""<sdf version="1.6"><world name="yard">{_box("floor", "0 0 -0.1 0 0 0", "20 20 0.2", static=True)}
{_box("crate", "-1 0 0.2 0 0 0", "0.4 0.4 0.4")}{_box("drum", "1 0 0.3 0 0 0", "0.4 0.4 0.6")}</world></sdf>"""


class MenuUser(WorldUser):
    """Opens menus and chooses entries."""

    def entry(self, title: str) -> Any:
        return self.page.locator(f'.menu [data-title="{title}"]')

    def choose(self, *titles: str) -> None:
        for title in titles:
            self.entry(title).click()

    def row(self, name: str) -> Any:
        return self.page.get_by_role("treeitem").filter(has_text=name).first

    @property
    def entries(self) -> list[str]:
        return [str(entry.get_attribute("data-title")) for entry in self.page.locator(".menu button").all()]

    @property
    def is_following(self) -> bool:
        self.side("Views")
        pressed = self.button("Follow").get_attribute("aria-pressed") == "true"
        self.side("Inspector")
        return pressed


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--no-ros", "--pause", "--port", "0")
    with running_page(*words, environment={"HOME": str(folder)}, folder=folder) as url:
        yield url


@pytest.fixture(scope="module")
def user(chromium: Any, url: str) -> Iterator[MenuUser]:
    user = MenuUser(chromium, url)
    user.look_down()
    yield user
    user.close()


def test_the_menu_of_a_model_has_gazebos_entries(user: MenuUser) -> None:
    """The order is Gazebo's; Escape closes it."""
    user.click((-1, 0), button="right")
    user.page.get_by_role("heading", name="base", exact=True).wait_for()
    assert user.entries == [
        "Move to", "Follow", "First person", "View", "Hide", "Edit model…", "Apply force or torque…", "Hold in the air",
        "Reset this model", "Copy", "Paste", "Delete",
    ]  # fmt: skip
    assert user.entry("Paste").is_disabled()
    user.page.keyboard.press("Escape")
    user.page.locator(".menu").wait_for(state="detached")


def test_a_drag_of_the_right_button_zooms_and_opens_no_menu(user: MenuUser) -> None:
    user.page.mouse.move(*user.at((-1, 0)))
    user.page.mouse.down(button="right")
    user.page.mouse.move(*user.at((-1, 0.5)), steps=3)
    user.page.mouse.up(button="right")
    assert user.page.locator(".menu").count() == 0
    user.look_down()


def test_a_copy_is_pasted_where_the_menu_was_opened(user: MenuUser) -> None:
    """The copy is on the floor at that point; undo removes it."""
    user.row("drum").click(button="right")
    user.choose("Copy")
    user.click((0.3, -0.8), button="right")
    user.choose("Paste")
    user.until(lambda: user.pose("drum_0") is not None)
    user.until(lambda: user.position("drum_0") == pytest.approx((0.3, -0.8, 0.3), abs=0.02))
    user.button("Undo: Copy of drum").click()
    user.until(lambda: not user.model("drum_0"))


def test_a_model_is_deleted_and_restored(user: MenuUser) -> None:
    user.click((1, 0), button="right")
    user.choose("Delete")
    user.until(lambda: not user.model("drum"))
    user.button("Undo: Delete drum").click()
    user.until(lambda: user.model("drum"))


def test_the_view_follows_the_menus_model(user: MenuUser) -> None:
    user.row("drum").click(button="right")
    user.choose("Follow")
    assert user.is_following
    user.row("drum").click(button="right")
    user.choose("Stop following")
    assert not user.is_following
    user.look_down()


def test_the_keyboard_opens_the_menu_and_its_submenus(user: MenuUser) -> None:
    """Shift F10 opens it in the tree; the submenu View stays open while its entries are toggled."""
    user.row("crate").click()
    user.page.keyboard.press("Shift+F10")
    user.entry("Move to").wait_for()
    for _ in range(3):
        user.page.keyboard.press("ArrowDown")
    user.page.keyboard.press("ArrowRight")
    user.entry("Collisions").wait_for()
    user.entry("Collisions").focus()
    user.page.keyboard.press("Enter")
    user.page.locator('.menu [data-title="Collisions"][aria-checked="true"]').wait_for()
    user.page.keyboard.press("ArrowLeft")
    user.until(lambda: user.page.evaluate("document.activeElement.dataset.title === 'View'"))
    user.page.keyboard.press("Escape")
    assert user.button("Collisions").get_attribute("aria-pressed") == "true"  # of this model, in the inspector
    user.button("Collisions").click()


def test_the_keyboard_opens_the_menu_of_the_selection_in_the_scene(user: MenuUser) -> None:
    user.pick("crate")
    user.page.locator(VIEW_CANVAS).focus()
    user.page.keyboard.press("Shift+F10")
    user.entry("Hold in the air").click()
    user.until(lambda: (user.model("crate") or {}).get("held"))
    user.page.locator(VIEW_CANVAS).focus()
    user.page.keyboard.press("Shift+F10")
    user.entry("Release").click()
    user.until(lambda: not (user.model("crate") or {}).get("held"))


def test_a_force_is_applied_from_the_menu(user: MenuUser) -> None:
    """The form's first field has the focus; 60 N act for 0.2 s on 1 kg."""
    user.page.get_by_role("banner").get_by_role("button", name="Play", exact=True).click()
    user.click((-1, 0), button="right")
    user.choose("Apply force or torque…")
    user.until(lambda: user.page.evaluate("document.activeElement.getAttribute('aria-label') === 'force x'"))
    before = user.position("crate")
    user.page.keyboard.press("Control+a")
    user.page.keyboard.type("-60")
    user.type("duration [s]", "0.2")
    user.until(lambda: user.position("crate")[0] < before[0] - 0.3, what=f"{user.position('crate')}, was {before}")
    user.page.get_by_role("banner").get_by_role("button", name="Pause", exact=True).click()


def test_a_long_touch_opens_the_menu(chromium: Any, url: str) -> None:
    context = chromium.new_context(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    tab = context.new_page()
    tab.goto(url)
    tab.get_by_label("Connected").first.wait_for()
    tab.get_by_role("navigation").get_by_role("button", name="World").click()
    row = tab.get_by_role("treeitem").filter(has_text="drum").first
    row.click(trial=True)  # waits until the sheet is still
    box = row.bounding_box()
    touch = context.new_cdp_session(tab)
    at = {"x": box["x"] + 80, "y": box["y"] + box["height"] / 2}
    touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [at]})
    tab.locator('.menu [data-title="Move to"]').wait_for()
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    tab.locator('.menu [data-title="Move to"]').click()
    tab.locator(".menu").wait_for(state="detached")
    context.close()


def test_a_view_only_menu_has_no_entries_that_change_the_world(chromium: Any, user: MenuUser) -> None:
    user.button("Search commands, Ctrl K").click()
    user.page.get_by_role("combobox", name="Search commands").fill("share")
    user.page.keyboard.press("Enter")
    user.button("View only").click()
    looker = MenuUser(chromium, user.field("Link").input_value())
    looker.row("crate").click(button="right")
    assert looker.entries == ["Move to", "Follow", "First person", "View", "Hide"]
    looker.close()
    user.page.keyboard.press("Escape")
