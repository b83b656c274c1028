"""Commands and keys in the documentation's table of windows exist on the page."""

import re
from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]
PAGE = Path(__file__).parents[2] / "docs" / "howto" / "window.md"
BOX = "<geometry><box><size>1 1 1</size></box></geometry>"
WORLD = f"""<sdf version="1.6"><world name="yard"><model name="crate"><link name="base"><collision name="c">{BOX}
</collision><visual name="v">{BOX}</visual></link></model></world></sdf>"""


def test_every_command_of_the_table_is_on_the_page(chromium: Any, tmp_path: Path) -> None:
    (tmp_path / "yard.sdf").write_text(WORLD)
    named = re.findall(r"\*([^*\n]+)\*(?: <kbd>(.+?)</kbd>)?", PAGE.read_text(encoding="utf-8").partition("\n## ")[2])
    words = ("run", "yard.sdf", "--no-ros", "--pause", "--port", "0")
    with running_page(*words, environment={"HOME": str(tmp_path)}, folder=tmp_path) as url:
        user = PanelUser(chromium, url)
        user.page.get_by_role("treeitem").get_by_text("crate", exact=True).click()
        user.page.get_by_role("heading", name="crate", exact=True).wait_for()
        offered = _offered(user)
        user.page.keyboard.press("Delete")
        user.button("Undo: Delete crate").wait_for()
        offered |= _offered(user)
        user.page.keyboard.press("Control+z")
        user.button("Redo: Delete crate").wait_for()
        offered |= _offered(user)
        user.button("Search commands, Ctrl K").click()
        user.page.get_by_role("option", name="New model…").click()
        user.page.get_by_role("heading", name="model", exact=True).wait_for()
        offered |= _offered(user)
        user.close()

    assert len(named) > 50
    wrong = {
        (title, keys)
        for title, keys in named
        if title not in offered or (keys and offered[title] != keys.replace("Escape", "Esc"))
    }
    assert wrong == set()


def _offered(user: PanelUser) -> dict[str, str]:
    """Return the available commands with their keys."""
    user.button("Search commands, Ctrl K").click()
    rows = user.page.get_by_role("listbox", name="Commands").get_by_role("option")
    rows.first.wait_for()
    parts = "row => ['span', 'kbd'].map(part => row.querySelector(part)?.innerText ?? '')"
    offered = dict(rows.evaluate_all(f"all => all.map({parts})"))
    user.page.keyboard.press("Escape")
    return offered
