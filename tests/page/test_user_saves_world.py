"""A user changes a running world and saves it; the file is checked, and loaded again."""

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.system.browser import running_page

import trundle

pytestmark = [needs_client, pytest.mark.slow]

BOX = "<geometry><box><size>1 1 1</size></box></geometry>"
WORLD = f"""<sdf version="1.6"><world name="yard">
  <!-- a quiet place -->
  <gravity>0 0 0</gravity>
  <model name="crate"><pose>0 0 2 0 0 0</pose><link name="body"><visual name="v">{BOX}</visual>
    <collision name="c">{BOX}</collision></link></model>
  <include><uri>model://ball</uri><pose>3 0 1 0 0 0</pose></include>
</world></sdf>
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    return folder


@pytest.fixture(scope="module")
def user(chromium: Any, folder: Path) -> Iterator[PanelUser]:
    with running_page("run", "yard.sdf", "--pause", "--port", "0", "--no-ros", environment={}, folder=folder) as url:
        user = PanelUser(chromium, url)
        yield user
        user.close()


def _select(user: PanelUser, name: str) -> None:
    user.page.get_by_role("treeitem").filter(has_text=re.compile(f"^{name}")).first.click()


def _set(user: PanelUser, label: str, value: str) -> None:
    field = user.page.locator("aside").get_by_label(label, exact=True)
    field.fill(value)
    field.press("Enter")


def _dialog(user: PanelUser) -> Any:
    return user.page.get_by_role("dialog", name="Save the world as SDF")


def test_changes_are_saved_and_restored_in_the_next_run(user: PanelUser, folder: Path) -> None:
    _select(user, "body")
    _set(user, "Mass [kg]", "4.5")
    _set(user, "x [m]", "1.25")
    _select(user, "yard")
    _set(user, "gravity z", "-2.5")
    _set(user, "time step [ms]", "2")
    user.page.locator("canvas").first.focus()
    user.page.keyboard.press("Control+s")
    dialog = _dialog(user)
    assert dialog.get_by_label("File").input_value() == "yard.sdf"
    dialog.get_by_label("File").fill("worlds/mine.sdf")
    dialog.get_by_role("button", name="Save", exact=True).click()
    user.page.get_by_role("status").get_by_text("saved as worlds/mine.sdf").wait_for()

    file = folder / "worlds" / "mine.sdf"
    text = file.read_text()
    assert "<!-- a quiet place -->" in text
    assert "<uri>model://ball</uri>" in text
    again = trundle.load(str(file))
    assert again["crate"].pose.position == pytest.approx((1.25, 0.0, 2.0), abs=1e-6)
    assert again["crate"].links[0].link.inertial.mass == 4.5
    assert again.world.physics.gravity == (0.0, 0.0, -2.5)
    assert again.step_ns == 2_000_000
    words = [sys.executable, "-m", "trundle", "check", str(file)]
    assert subprocess.run(words, capture_output=True, text=True, check=False).returncode == 0


def test_a_page_opened_later_offers_the_newest_file(user: PanelUser) -> None:
    user.page.reload()
    user.page.get_by_role("treeitem").filter(has_text="crate").first.wait_for()
    user.page.locator("canvas").first.focus()
    user.page.keyboard.press("Control+s")
    assert _dialog(user).get_by_label("File").input_value() == "worlds/mine.sdf"
    user.page.keyboard.press("Escape")


def test_files_are_replaced_only_after_confirmation(user: PanelUser, folder: Path) -> None:
    """The tree's menu opens the dialog, too; it refuses a path out of the folder."""
    user.button("World's menu").click()
    user.page.get_by_role("menuitem", name="Save the world as SDF").click()
    dialog = _dialog(user)
    dialog.get_by_label("File").fill("../yard.sdf")
    dialog.get_by_label("File").press("Enter")
    dialog.get_by_role("alert").get_by_text("below the folder where Trundle was started").wait_for()
    dialog.get_by_label("File").fill("yard.sdf")
    dialog.get_by_label("File").press("Enter")
    dialog.get_by_text("yard.sdf exists already. Replace it?").wait_for()
    assert (folder / "yard.sdf").read_text() == WORLD
    dialog.get_by_label("File").press("Enter")  # replaces nothing
    dialog.get_by_role("button", name="Replace").click()
    user.page.get_by_role("status").get_by_text("saved as yard.sdf").wait_for()
    assert trundle.load(str(folder / "yard.sdf")).world.physics.gravity == (0.0, 0.0, -2.5)


def test_the_world_is_downloaded(user: PanelUser) -> None:
    user.page.keyboard.press("Control+k")
    user.page.get_by_role("combobox", name="Search commands").fill("save the world")
    user.page.keyboard.press("Enter")
    with user.page.expect_download() as download:
        _dialog(user).get_by_role("button", name="Download").click()
    assert download.value.suggested_filename == "yard.sdf"
    assert "<gravity>0 0 -2.5</gravity>" in Path(download.value.path()).read_text()
