"""A user plays a bag beside another one, and watches a graph beside a bag: marks or a ghost, curves and numbers."""

import io
import math
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image, ImageColor
from tests.graphs import running_graph
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.recorded_drives import MESSAGES, transform, write_drive
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]


class BagUser(PanelUser):
    """Reads the Compare panel."""

    def cells(self, name: str, quantity: str) -> list[str]:
        row = self.page.locator("table.differences tbody tr").filter(has=self.page.get_by_title(name, exact=True))
        row = row.filter(has_text=quantity)
        return row.locator("td").all_inner_texts() if row.count() else []

    def number(self, name: str, quantity: str, column: int) -> float:
        cells = self.cells(name, quantity)
        text = cells[column].strip("m°/s\n ") if cells else "—"
        return math.nan if text == "—" else float(text.replace("−", "-"))

    def pixels(self, token: str) -> int:
        """Return the number of the scene's pixels in a color of the theme."""
        style = f"getComputedStyle(document.documentElement).getPropertyValue('{token}')"
        color = ImageColor.getrgb(self.page.evaluate(style).strip())
        picture = Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")
        return int((np.abs(np.asarray(picture, dtype=int) - color) < 3).all(axis=-1).sum())

    def plot(self, path: str) -> None:
        self.open("Plots")
        self.button("Add curve").first.click()
        field = self.page.get_by_role("combobox", name="Path of a curve")
        field.fill(path)
        field.press("Enter")
        self.button("Close").click()


@pytest.fixture(scope="module")
def drives(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """A drive of 4 s at 0.5 m/s, and one at 0.4 m/s at another time."""
    folder = tmp_path_factory.mktemp("drives")
    return (
        write_drive(folder / "fast.bag", speed=0.5),
        write_drive(folder / "slow.mcap", speed=0.4, start_s=2000.0),
    )


@pytest.fixture
def user(chromium: Any, drives: tuple[Path, Path]) -> Iterator[BagUser]:
    """The faster drive, paused at its start, beside the slower one."""
    words = ("play", str(drives[0]), "--compare", str(drives[1]), "--pause", "--port", "0")
    with running_page(*words, environment={}) as url:
        user = BagUser(chromium, url)
        yield user
        user.close()


def test_a_bag_is_played_beside_another(user: BagUser, tmp_path: Path) -> None:
    user.plot("/odom/pose/pose/position/x")
    user.page.get_by_role("img", name="(reference)").wait_for()
    user.open("Compare")
    user.page.get_by_title("slow.mcap").wait_for()
    user.page.get_by_role("banner").get_by_role("button", name="Play", exact=True).click()
    user.until(lambda: user.number("/odom.pose.pose.position.x", "value", 3) > 0.25, what="for the differences")

    assert user.number("base_link in odom", "distance", 3) == pytest.approx(0.3, abs=0.11)
    assert user.number("/odom.twist.twist.linear.x", "value", 3) == pytest.approx(0.1)
    user.sees("of 4.0 s")
    with user.page.expect_download() as download:
        user.button("Save CSV").click()
    download.value.save_as(tmp_path / "differences.csv")
    assert '"/odom.pose.pose.position.x",value,' in (tmp_path / "differences.csv").read_text()
    user.open("Plots")
    user.page.locator(".legend .referenced").first.wait_for()

    user.open("Compare")
    user.button("Stop comparing").click()
    user.sees("Nothing is compared.")


def test_a_bag_is_chosen_and_a_log_refused(user: BagUser, drives: tuple[Path, Path]) -> None:
    user.open("Compare")
    user.button("Stop comparing").click()
    user.drop_file("run.bag", "hello")
    user.page.get_by_text("run.bag: topics can only be compared with a bag").first.wait_for()

    with user.page.expect_file_chooser() as chooser:
        user.button("Compare with a recording…").click()
    chooser.value.set_files(str(drives[1]))

    user.page.get_by_title("slow.mcap").wait_for()


URDF = """<robot name="cart">
<link name="base_link"><visual><geometry><box size="0.4 0.4 0.4"/></geometry></visual></link>
<link name="laser"/><joint name="mast" type="fixed"><parent link="base_link"/><child link="laser"/></joint></robot>"""


def test_a_graph_is_watched_beside_a_bag(chromium: Any, drives: tuple[Path, Path]) -> None:
    """The robot stands at x = −1, while the recorded one drives away from 0."""
    with running_graph() as graph:
        node = graph.node("drive")
        graph.loop.run(node.params.set("/robot_description", URDF))
        tf = node.advertise("/tf", "tf2_msgs/TFMessage")
        environment = {"ROS_MASTER_URI": graph.core.uri}
        with running_page("view", "--compare", str(drives[1]), "--port", "0", environment=environment) as url:
            user = BagUser(chromium, url)
            user.open("Compare")

            def stands() -> float:
                now_ns = time.time_ns()
                message = {"transforms": [transform("odom", "base_link", x=-1.0)]}
                tf.publish(MESSAGES.new("tf2_msgs/TFMessage", message, now_ns=now_ns))
                return user.number("base_link in odom", "distance", 3)

            user.until(lambda: stands() >= 1.0, what="for the differences")
            user.until(lambda: stands() and user.pixels("--reference") > 200, what="for the ghost's label")
            user.close()
