"""A user without an .rviz file saves one: as a download, or below the folder where Trundle was started."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.scene_user import SceneUser

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

pytestmark = [pytest.mark.slow, needs_client]

EXISTING = "mine, and not to be lost"


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture
def user(chromium: Any, graph: Graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[SceneUser]:
    monkeypatch.chdir(tmp_path)
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(Session(title="a car", kind="graph"), at=PageAddress(port=0), graph=address) as server:
        user = SceneUser(chromium, server.url)
        yield user
        user.close()


def _switch(user: SceneUser, display: str) -> None:
    row = user.page.get_by_role("treeitem").filter(has_text=display).first
    row.focus()
    user.page.keyboard.press(" ")


def _save_as(user: SceneUser) -> None:
    user.page.keyboard.press("Control+k")
    user.page.get_by_role("combobox", name="Search commands").fill("Save as .rviz")
    user.page.keyboard.press("Enter")


def _is_enabled(file: Path, display: str) -> bool:
    import yaml

    displays = yaml.safe_load(file.read_text())["Visualization Manager"]["Displays"]
    return next(one["Enabled"] for one in displays if one["Name"] == display)


def test_changed_displays_are_downloaded(user: SceneUser) -> None:
    unsaved = user.page.get_by_text("not saved")
    user.page.get_by_role("treeitem").filter(has_text="Grid").first.wait_for()
    assert unsaved.count() == 0  # nothing is changed yet
    _switch(user, "Grid")
    user.page.get_by_text("1 change, not saved").wait_for()
    with user.page.expect_download() as download:
        user.button("Download").click()
    unsaved.wait_for(state="detached")

    assert download.value.suggested_filename == "a_car.rviz"
    assert not _is_enabled(download.value.path(), "Grid")


def test_the_file_is_saved_below_the_folder_and_saved_again_there(user: SceneUser, tmp_path: Path) -> None:
    _switch(user, "Grid")
    user.button("Save as").click()
    user.page.get_by_role("dialog", name="Save as .rviz").wait_for()
    user.page.keyboard.type("seen")  # the name without its suffix is selected
    user.page.keyboard.press("Enter")
    user.page.get_by_role("dialog").wait_for(state="detached")

    assert [path.name for path in tmp_path.iterdir()] == ["seen.rviz"]
    assert not _is_enabled(tmp_path / "seen.rviz", "Grid")
    _switch(user, "Grid")
    user.button("Save").click()
    user.page.get_by_text("not saved").wait_for(state="detached")
    assert _is_enabled(tmp_path / "seen.rviz", "Grid")


def test_a_page_opened_later_shows_and_saves_the_newest_file(user: SceneUser, tmp_path: Path) -> None:
    for name in ("first", "second"):
        _switch(user, "Grid")
        _save_as(user)
        user.page.get_by_role("dialog", name="Save as .rviz").wait_for()
        user.page.keyboard.type(name)
        user.page.keyboard.press("Enter")
        user.page.get_by_role("dialog").wait_for(state="detached")
    assert (_is_enabled(tmp_path / "first.rviz", "Grid"), _is_enabled(tmp_path / "second.rviz", "Grid")) == (
        False,
        True,
    )
    user.page.reload()
    _switch(user, "Grid")
    user.button("Save").click()
    user.page.get_by_text("not saved").wait_for(state="detached")
    assert (_is_enabled(tmp_path / "first.rviz", "Grid"), _is_enabled(tmp_path / "second.rviz", "Grid")) == (
        False,
        False,
    )
    _save_as(user)
    assert user.field("File").input_value() == "second.rviz"


def test_an_existing_file_is_replaced_only_after_confirmation(user: SceneUser, tmp_path: Path) -> None:
    file = tmp_path / "mine.rviz"
    file.write_text(EXISTING)
    _switch(user, "Grid")
    user.button("Save as").click()
    name = user.field("File")
    name.fill("../mine")
    name.press("Enter")
    user.page.get_by_role("alert").get_by_text("below the folder where Trundle was started").wait_for()
    name.fill("mine")
    name.press("Enter")
    user.page.get_by_text("mine.rviz exists already. Replace it?").wait_for()
    name.press("Enter")
    user.page.wait_for_timeout(300)
    assert file.read_text() == EXISTING
    user.button("Close").click()
    user.page.get_by_text("1 change, not saved").wait_for()
    assert file.read_text() == EXISTING

    user.button("Save as").click()
    name.fill("mine.rviz")
    name.press("Enter")
    user.button("Replace").click()
    user.page.get_by_role("dialog").wait_for(state="detached")
    assert not _is_enabled(file, "Grid")
