"""Edits of a running world in the Inspector, with undo and redo."""

import json
from pathlib import Path
from typing import Any

import pytest
from tests.page_client import ProtocolClient
from tests.system.browser import opened, running_page, until

pytestmark = [pytest.mark.browser, pytest.mark.slow]

_WORLD = """<sdf version="1.6"><world name="yard"><light name="sun" type="directional"/>
<model name="cart"><pose>0 0 5 0 0 0</pose><link name="base"><gravity>0</gravity><inertial><mass>2</mass></inertial>
<collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision></link></model></world></sdf>"""


def test_edits_of_pose_mass_friction_gravity_and_light_can_be_undone(chromium: Any, tmp_path: Path) -> None:
    """The simulation has the entered values; refused edits are not in the undo history."""
    (tmp_path / "yard.world").write_text(_WORLD)
    words = ("run", str(tmp_path / "yard.world"), "--no-ros", "--port", "0")
    with (
        running_page(*words, environment={"HOME": str(tmp_path)}) as url,
        opened(chromium, url, width=1440) as page,
        ProtocolClient(url) as client,
    ):
        client.subscribe("trundle/world")

        def manifest() -> dict[str, Any]:
            while client.read(0.001):
                pass
            return json.loads(client.payloads("trundle/world")[-1]) if client.payloads("trundle/world") else {}

        def base() -> dict[str, Any]:
            return manifest()["models"][0]["links"][0]

        def pick(name: str) -> None:
            page.get_by_role("treeitem").get_by_text(name, exact=True).first.click()

        def type_into(label: str, text: str) -> None:
            field = page.get_by_role("textbox", name=label, exact=True)
            field.fill(text)
            field.press("Enter")

        def is_at(height: str) -> bool:
            return page.get_by_role("textbox", name="z [m]", exact=True).input_value() == height

        until(page, lambda: manifest() and base()["mass"] == 2.0, "the world")
        pick("base")
        type_into("z [m]", "7.5")
        until(page, lambda: is_at("7.500"), "the new height")
        type_into("Mass [kg]", "4.5")
        until(page, lambda: base()["mass"] == 4.5, "the mass")
        type_into("mu2", "0.25")
        until(page, lambda: base()["friction"] == [1.0, 0.25], "the friction")

        undo = page.get_by_role("button", name="Undo")
        for is_undone in (
            lambda: base()["friction"] == [1.0, 1.0],
            lambda: base()["mass"] == 2.0,
            lambda: is_at("5.000"),
        ):
            undo.first.click()
            until(page, is_undone, "an edit to be undone")
        page.get_by_role("button", name="Redo").first.click()
        until(page, lambda: is_at("7.500"), "the height again")

        pick("yard")
        type_into("gravity z", "-1.6")
        until(page, lambda: manifest()["physics"]["gravity"] == [0.0, 0.0, -1.6], "the moon")
        pick("sun")
        type_into("blue", "0.5")
        until(page, lambda: manifest()["lights"][0]["diffuse"] == [1.0, 1.0, 0.5], "the light")
        pick("base")
        type_into("Mass [kg]", "-3")
        page.get_by_role("alert").first.wait_for()
        assert base()["mass"] == 2.0
