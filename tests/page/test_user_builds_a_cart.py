"""A user builds a cart in the page, saves it, runs it, converts it and drives it."""

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import running_graph
from tests.page.built_client import needs_client
from tests.page.cart_builder import CartBuilder
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

import trundle

pytestmark = [pytest.mark.slow, needs_client]

WORLD = """<sdf version="1.6"><world name="yard"><include><uri>model://ground_plane</uri></include></world></sdf>"""


def _trundle(*words: str, folder: Path) -> str:
    done = subprocess.run(
        [sys.executable, "-m", "trundle", *words], capture_output=True, text=True, check=False, cwd=folder
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_cart_is_built_saved_run_converted_and_driven(chromium: Any, tmp_path: Path) -> None:
    """The second part runs the files of the first."""
    (tmp_path / "yard.sdf").write_text(WORLD)
    with running_page("run", "yard.sdf", "--no-ros", "--port", "0", environment={}, folder=tmp_path) as url:
        user = CartBuilder(chromium, url)
        user.build()
        user.until(lambda: user.value("robotBaseFrame", "plugin", "diff_drive") == "chassis", what="for the last edit")
        assert user.is_paused
        user.save("models/cart")
        user.button("Finish").click()
        user.until(lambda: user.model("cart") and user.draft() is None, what="for the cart in the world")
        user.close()

    folder = tmp_path / "models" / "cart"
    assert not re.search("warning|error", _trundle("check", str(folder), folder=tmp_path))
    urdf = _trundle("convert", str(folder), "--to", "urdf", folder=tmp_path)
    assert '<robot name="cart">' in urdf
    assert 'type="continuous"' in urdf
    cart = trundle.load(str(folder))["cart"]
    assert {joint.name for joint in cart.joints} == {"left_wheel_joint", "right_wheel_joint", "caster_joint"}
    assert [sensor.type for sensor in cart.link("chassis").link.sensors] == ["ray", "camera"]
    _drive(chromium, folder)


def _drive(chromium: Any, model: Path) -> None:
    with running_graph() as graph:
        words = ("run", str(model), "--port", "0")
        with running_page(*words, environment={"ROS_MASTER_URI": graph.core.uri}, folder=model) as url:
            user = WorldUser(chromium, url)
            user.page.locator(".disc").wait_for()
            start = user.position("cart")[0]
            user.page.locator("canvas").first.focus()
            user.page.keyboard.down("w")
            user.until(lambda: user.position("cart")[0] > start + 0.3, what="for the cart to drive")
            user.page.keyboard.up("w")
            user.close()
