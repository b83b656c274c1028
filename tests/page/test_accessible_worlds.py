"""Axe finds nothing on the pages of a simulation and of a bag, wide and on a phone, dark and light."""

import os
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from tests.page.axe import assert_accessible, load_axe, needs_axe
from tests.page.bag.test_source import START, TEXT, S, text
from tests.page.built_client import needs_client
from tests.page.panel_user import PATIENCE_MS
from tests.system.browser import running_page

from trundle.base.http.page_address import PageAddress
from trundle.page import BagFile, PageServer, Session
from trundle.ros import BagMessage, create_bag

pytestmark = [pytest.mark.slow, needs_client, needs_axe]

WIDE, NARROW, PHONE = (1440, 900), (720, 900), (390, 844)
LOOKS = [(WIDE, "dark"), (WIDE, "light"), (NARROW, "dark"), (PHONE, "dark"), (PHONE, "light")]
CASE = "<geometry><box><size>0.4 0.4 0.4</size></box></geometry>"
CAMERA = """<sensor name="eye" type="camera"><pose>0.3 0 0 0 0 0</pose><always_on>1</always_on>
<update_rate>5</update_rate><camera><image><width>64</width><height>48</height></image></camera></sensor>"""
WORLD = f"""<sdf version="1.6"><world name="yard"><light name="lamp" type="point"><pose>0 0 3 0 0 0</pose></light>
<model name="cart"><pose>0 0 0.2 0 0 0</pose><link name="base"><collision name="c">{CASE}</collision>
<visual name="v">{CASE}</visual>{CAMERA}</link></model></world></sdf>"""


@contextmanager
def _opened(chromium: Any, url: str, size: tuple[int, int], theme: str) -> Generator[Any]:
    width, height = size
    viewport = {"width": width, "height": height}
    context = chromium.new_context(viewport=viewport, color_scheme=theme, has_touch=size == PHONE)
    tab = context.new_page()
    tab.set_default_timeout(PATIENCE_MS)
    tab.goto(url)
    tab.get_by_label("Connected").first.wait_for()
    load_axe(tab)
    yield tab
    context.close()


def _open_side(tab: Any, name: str) -> None:
    page = tab.get_by_role("tab", name=name, exact=True)
    (page if page.count() else tab.locator(".rail").get_by_role("button", name=name, exact=True)).first.click()


def _check_parts(tab: Any, sides: tuple[str, ...], panels: tuple[str, ...], *, phone: bool) -> None:
    """Check the page as it begins, each page at its sides, and each panel, of the dock or the sheet."""
    assert_accessible(tab, "as it begins")
    for name in (*sides, *panels):
        if phone:
            tab.get_by_role("navigation").get_by_role("button", name=name, exact=True).click()
        elif name in sides:
            _open_side(tab, name)
        else:
            tab.locator(".dv-tab", has_text=name).click()
        assert_accessible(tab, name)


@pytest.fixture(scope="module")
def world(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--port", "0", "--pause")
    with running_page(*words, environment={"HOME": str(folder), "ROS_MASTER_URI": ""}, folder=folder) as url:
        yield url


@pytest.mark.parametrize(("size", "theme"), LOOKS)
def test_a_simulation(chromium: Any, world: str, size: tuple[int, int], theme: str) -> None:
    with _opened(chromium, world, size, theme) as tab:
        phone = size == PHONE
        sides = ("World", "Displays", "Inspector")
        _check_parts(tab, sides if phone else (*sides, "Insert", "Views"), ("Plots", "Log"), phone=phone)
        if phone:
            tab.get_by_role("button", name="More", exact=True).click()
            tab.get_by_role("menu").wait_for()
            assert_accessible(tab, "the menu")
            return
        tab.locator(".dv-tab", has_text="Timeline").click()
        tab.get_by_role("slider", name="Time").wait_for()
        assert_accessible(tab, "Timeline")
        for tool in ("Move", "Rotate", "Measure"):
            tab.get_by_role("toolbar", name="Tools").get_by_role("button", name=tool, exact=True).click()
            assert_accessible(tab, tool)
        for menu in ("Show in the view", "Split the view", "World's menu"):
            if menu == "World's menu":
                _open_side(tab, "World")
            tab.get_by_role("button", name=menu, exact=True).click()
            tab.get_by_role("menu").first.wait_for()
            assert_accessible(tab, menu)
            tab.keyboard.press("Escape")
        tab.get_by_role("treeitem").get_by_text("cart", exact=True).first.click(button="right")
        tab.get_by_role("menu").first.wait_for()
        assert_accessible(tab, "the model's menu")


@pytest.mark.parametrize(("size", "theme"), LOOKS)
def test_a_bag(chromium: Any, tmp_path: Path, size: tuple[int, int], theme: str) -> None:
    path = tmp_path / "words.bag"
    with create_bag(path) as writer:
        for second in range(4):
            writer.write(BagMessage(TEXT, START + second * S, text(f"word {second}")))
    playing = BagFile(path=os.fsencode(path), speed=1.0, paused=True)
    with (
        PageServer.start(Session(title="words", kind="bag"), at=PageAddress(port=0), bag=playing) as server,
        _opened(chromium, server.url, size, theme) as tab,
    ):
        phone = size == PHONE
        panels = ("Plots", "Log") if phone else ("Timeline", "Plots", "Topics", "Log")
        _check_parts(tab, ("Displays", "Inspector"), panels, phone=phone)
