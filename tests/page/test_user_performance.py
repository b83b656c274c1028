"""A user looks at the profile of a simulation."""

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from tests.graphs import free_port
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.page.simulated_world.worlds import BOX, CAMERA, model, world
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]
PLUGIN = """import time
from trundle.gazebo.plugins import Plugin
class Busy(Plugin):
    period_ns = 100_000_000
    @classmethod
    def load(cls, sim, model, node, tag): return cls()
    def after_step(self, snapshot): time.sleep(0.02)
"""


def table(user: PanelUser) -> dict[str, tuple[str, float, float]]:
    """Return group, ms per simulated second and share [%] by name."""
    rows = user.page.locator("table.parts").evaluate_all(
        "tables => tables.flatMap((table) => [...table.rows].slice(1))"
        ".map(({ cells }) => [...cells].map((cell) => cell.textContent))"
    )
    return {name: (part, float(ms), float(share.split()[0])) for name, part, ms, share in rows}


def test_camera_plugin_and_waiting_have_their_times(chromium: Any, tmp_path: Path) -> None:
    """The plugin sleeps 20 ms at 10 Hz: about 200 ms per simulated second."""
    (tmp_path / "busy.py").write_text(PLUGIN)
    plugin = '<plugin name="idler" filename="libbusy.so"/></model>'
    (tmp_path / "w.sdf").write_text(world(model("m", BOX + CAMERA).replace("</model>", plugin)))
    with running_page("run", str(tmp_path / "w.sdf"), "--no-ros", environment={}) as url:
        user = PanelUser(chromium, url)
        user.page.keyboard.press("Control+K")
        user.page.keyboard.type("Open Performance")
        user.page.get_by_role("option", name="Open Performance").first.click()
        rows: dict[str, tuple[str, float, float]] = {}

        def has_both() -> bool:
            rows.clear()
            rows.update(table(user))
            return rows.keys() >= {"m::idler", "m::l::cam"} and rows["m::idler"][1] > 150

        user.until(has_both, what="for plugin and camera")
        assert rows["m::idler"][0] == "Plugins"
        assert rows["m::l::cam"][0] == "Cameras"
        assert rows["m::l::cam"][1] > 0
        assert {"Page", "Waiting"} <= set(rows)
        assert sum(share for _, _, share in rows.values()) == pytest.approx(100, abs=1)
        user.page.get_by_role("table", name="Wall time per simulated second").wait_for()
        bar = user.page.get_by_role("img", name="One simulated second takes")
        assert "m::idler" in (bar.get_attribute("aria-label") or "")
        user.page.get_by_role("img", name="Real-time factor over the last").wait_for()
        user.close()


@pytest.mark.parametrize(("panel", "head"), [("Performance", ".data thead"), ("Timeline", ".timeline .ruler")])
def test_the_head_of_a_panel_is_drawn_only_in_the_panel(chromium: Any, panel: str, head: str) -> None:
    """Chromium drew sticky heads a second time, as a band across the scene."""
    with running_page("run", "rp2w_at_home.world", "--port", "0", environment={}) as url:
        page = chromium.new_page(viewport={"width": 1440, "height": 900}, color_scheme="dark")
        page.set_default_timeout(60_000)
        page.goto(url)
        page.get_by_label("Connected").first.wait_for()
        page.wait_for_timeout(3000)
        page.keyboard.press("Control+K")
        page.keyboard.type(f"Open {panel}")
        page.get_by_role("option", name=f"Open {panel}").first.click()
        page.locator(head).first.wait_for()
        page.wait_for_timeout(6000)  # it appeared in a later picture
        dock = page.locator(".dock").bounding_box()
        disc = page.locator(".drive").first.bounding_box()
        picture = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB"))
        scene = picture[90 : int(disc["y"]) - 40, int(dock["x"]) + 4 : int(dock["x"] + dock["width"]) - 4]
        assert (scene.max(axis=2) < 40).mean(axis=1).max() < 0.5  # the room is bright, the panels are dark
        page.close()


def test_the_heads_of_a_table_leave_the_scene_whole(chromium: Any, tmp_path: Path) -> None:
    """Chromium cut a hole into the scene, as high and wide as the heads of the topics."""
    shown = tmp_path / "grid.rviz"
    shown.write_text("Visualization Manager: {Displays: [{Class: rviz/Grid, Name: Grid, Enabled: true}]}")
    launch = tmp_path / "grid.launch"
    launch.write_text(
        '<launch><include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
        f'<node pkg="rviz" type="rviz" name="rviz" args="-d {shown}"/></launch>'
    )
    port = ("-p", str(free_port()))
    with running_page("launch", str(launch), *port, "--view-port", "0", environment={}) as url:
        page = chromium.new_page(viewport={"width": 1280, "height": 800})
        page.set_default_timeout(60_000)
        page.goto(url)
        page.get_by_label("Connected").first.wait_for()
        page.get_by_role("tab", name="Topics").click()
        page.locator(".data th").first.wait_for()
        page.add_style_tag(content="body, main.scene { background: red !important }")
        page.wait_for_timeout(6000)
        picture = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB"))
        assert not (picture == (255, 0, 0)).all(axis=2).any()
        page.close()
