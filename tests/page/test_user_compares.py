"""A user compares a live run with a recording of another drive: a ghost, dashed curves and numbers."""

import io
import itertools
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image, ImageColor
from tests.page.built_client import needs_client
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

import trundle
from trundle.live.state_logs import start_state_log
from trundle.sim.simulation import read_state_log
from trundle.spatial import Pose, Twist, Vector3

pytestmark = [pytest.mark.slow, needs_client]
SIDE_M = 0.4
WORLD = f"""<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity>
<scene><background>0 0 0 1</background><grid>0</grid></scene>
<model name="puck"><pose>0.5 0 0 0 0 0</pose><link name="l">
<visual name="v"><geometry><box><size>{SIDE_M} {SIDE_M} {SIDE_M}</size></box></geometry>
<material><ambient>0 0 1 1</ambient><diffuse>0 0 1 1</diffuse></material></visual>
<collision name="c"><geometry><box><size>{SIDE_M} {SIDE_M} {SIDE_M}</size></box></geometry></collision></link></model>
</world></sdf>"""
GHOST_OPACITY = 0.35
"""Opacity of a surface that faces the camera."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The world, and a recording in which the puck leaves (−1, 0.5) along x at 0.5 m/s."""
    folder = tmp_path_factory.mktemp("compare")
    (folder / "w.sdf").write_text(WORLD)
    record(folder, "other.log", start=(-1.0, 0.5, 0.0), twist=Twist(linear=(0.5, 0.0, 0.0)))
    return folder


def record(folder: Path, name: str, *, start: Vector3, twist: Twist) -> None:
    """Record two seconds of the puck."""
    sim = trundle.load(str(folder / "w.sdf"))
    sim["puck"].set_pose(Pose(start))
    sim["puck"].set_twist(twist)
    recorder = start_state_log(folder / name, sim, sim.world, sim.report)
    sim.add_hook(recorder, period_ns=recorder.period_ns)
    sim.run(2.0)
    recorder.close()


class CompareUser(WorldUser):
    """Drives the puck along −y at 0.5 m/s, step by step."""

    def __init__(self, browser: Any, url: str) -> None:
        super().__init__(browser, url)
        self._numbers = itertools.count(1)

    def ask(self, request: str, **fields: Any) -> None:
        """Send a request over a connection of its own, and wait for the answer."""
        number = next(self._numbers)
        self._client.send("trundle/request", id=number, request=request, **fields)
        self._client.until(lambda: any(one.get("id") == number and one["ok"] for one in self._client.jsons))

    def run_to(self, seconds: float) -> None:
        self.ask("run_to", time_ns=round(seconds * 1e9))
        self.until(lambda: self.state["time_ns"] == round(seconds * 1e9), what=f"for {seconds} s")

    def reference_color(self) -> tuple[int, int, int]:
        style = "getComputedStyle(document.documentElement).getPropertyValue('--reference')"
        red, green, blue = ImageColor.getrgb(self.page.evaluate(style).strip())[:3]
        return red, green, blue

    def ghost_at(self, point: tuple[float, float]) -> bool:
        """Tell if the middle of the ghost's top is drawn at a point of the ground."""
        row, column = round((1.5 - point[1]) * 100), round((point[0] + 2.5) * 100)
        pixel = self.picture()[row, column].astype(int)
        expected = GHOST_OPACITY * np.array(self.reference_color())
        return bool((np.abs(pixel - expected) < 16).all())

    def cells(self, name: str, quantity: str) -> list[str]:
        """Return the texts of a row of the panel."""
        row = self.page.locator("table.differences tbody tr").filter(has_text=name).filter(has_text=quantity)
        return row.locator("td").all_inner_texts() if row.count() else []

    def number(self, name: str, quantity: str, column: int) -> float:
        cells = self.cells(name, quantity)
        text = cells[column].rstrip("m°\n ") if cells else "—"
        return math.nan if text == "—" else float(text.replace("−", "-"))

    def plot(self, path: str) -> None:
        self.open("Plots")
        self.button("Add curve").first.click()
        field = self.page.get_by_role("combobox", name="Path of a curve")
        field.fill(path)
        field.press("Enter")
        self.button("Close").click()

    def until_plotted(self, path: str, value: float, reference: float | None) -> None:
        """Wait until a curve's newest value, and the reference's, are shown beside its plot."""
        row = self.page.locator(".legend li").filter(has=self.page.locator(f"[title^='{path}']"))
        expected = [value] if reference is None else [value, reference]

        def shown() -> list[float]:
            texts = [*row.locator("b").all_inner_texts(), *row.locator(".referenced .num").all_inner_texts()]
            return [float(text.replace("−", "-")) for text in texts if text.strip() != "—"]

        self.until(lambda: shown() == pytest.approx(expected, abs=1e-3), what=f"{path}: {shown()}, not {expected}")

    def until_distance(self, distance: float) -> None:
        self.until(lambda: abs(self.number("puck", "distance", 2) - distance) < 6e-4, what=f"for {distance} m")


@pytest.fixture
def user(chromium: Any, folder: Path) -> Iterator[CompareUser]:
    words = ("run", str(folder / "w.sdf"), "--no-ros", "--pause", "--port", "0", "--compare", str(folder / "other.log"))
    with running_page(*words, environment={}) as url:
        user = CompareUser(chromium, url)
        user.look_down()
        yield user
        user.close()


def test_a_run_is_compared_with_a_recording(user: CompareUser, folder: Path, tmp_path: Path) -> None:
    user.until(lambda: user.ghost_at((-1.0, 0.5)), what="for the ghost at its start")
    user.ask("twist", model="puck", linear=[0.0, -0.5, 0.0], angular=[0.0, 0.0, 0.0])
    user.open("Compare")
    user.run_to(1.0)

    user.until(lambda: user.ghost_at((-0.5, 0.5)), what="for the ghost after a second")
    assert not user.ghost_at((-0.9, 0.5))
    log = read_state_log(folder / "other.log")
    recorded = log.poses[np.searchsorted(log.times_s, 1.0 - 1e-6), 0, :3]
    user.until_distance(float(np.linalg.norm(recorded - user.position("puck"))))
    assert user.number("puck", "distance", 3) == pytest.approx(math.hypot(1.5, 0.5), abs=2e-3), "that of the start"
    assert user.number("puck", "angle", 2) == 0.0
    assert user.cells("puck", "velocity")[2] == "0.707m/s", "one drives along x, the other along −y"
    assert user.cells("puck", "angular velocity")[2] == "0.000rad/s"
    user.sees("1.0 of 2.0 s")

    with user.page.expect_download() as download:
        user.button("Save CSV").click()
    download.value.save_as(tmp_path / "differences.csv")
    head, distance, *_ = (tmp_path / "differences.csv").read_text().splitlines()
    assert head.startswith('"name","quantity","now [m, rad, m/s, rad/s]"')
    assert float(distance.split(",")[2]) == pytest.approx(math.sqrt(2.0), abs=1e-3)

    user.type("Offset [s]", "0.5")
    user.until_distance(math.hypot(0.5 + 0.75, 1.0))
    user.until(lambda: user.ghost_at((-0.75, 0.5)), what="for the shifted ghost")
    user.type("Offset [s]", "0")
    user.until_distance(math.sqrt(2.0))

    user.page.get_by_role("button", name="Go to the maximum of puck distance").click()
    user.until(lambda: user.state["time_ns"] == 0, what="for the time of the maximum")
    user.run_to(2.5)
    user.sees("ended 0.5 s ago, at its last poses")
    user.until(lambda: user.ghost_at((0.0, 0.5)), what="for the ghost at its last pose")

    user.button("Stop comparing").click()
    user.sees("Nothing is compared.")
    user.until(lambda: not user.ghost_at((0.0, 0.5)), what="for the ghost to leave")


def _columns_with(user: CompareUser, token: str, *, upper: bool) -> float:
    """Return the share of a plot's columns in whose upper or lower half a color of the theme is."""
    style = f"getComputedStyle(document.documentElement).getPropertyValue('{token}')"
    color = ImageColor.getrgb(user.page.evaluate(style).strip())
    png = user.page.locator(".plots .u-over").first.screenshot()
    picture = np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=int)
    half = picture[: len(picture) // 2] if upper else picture[len(picture) // 2 :]
    return float((np.abs(half - color) < 80).all(axis=-1).any(axis=0).mean())


def test_plots_have_dashed_curves_of_the_recording(user: CompareUser) -> None:
    user.plot("puck.pose.x")
    user.page.get_by_label("Time window").select_option("5 s")
    user.run_to(1.5)
    user.page.get_by_role("img", name="Plot of puck.pose.x, puck.pose.x (reference)", exact=True).wait_for()
    user.page.locator(".legend .referenced").get_by_text("−0.250").wait_for()
    user.button("Pause").last.click()  # the plots

    run, recorded = (_columns_with(user, "--plot-1", upper=upper) for upper in (True, False))
    assert run > 0.25, "the run's curve is a line of 1.5 of 5 s"
    assert 0.1 * run < recorded < 0.85 * run, "the recording's curve has gaps"

    user.page.get_by_label("Recording to compare with").select_option("Difference")
    user.page.get_by_role("img", name="Plot of puck.pose.x (difference)", exact=True).wait_for()
    user.page.locator(".legend b").get_by_text("0.750").wait_for()


def test_a_recording_is_chosen_or_dropped(user: CompareUser, folder: Path) -> None:
    user.open("Compare")
    user.button("Stop comparing").click()
    user.drop_file("<b>bad.log", "hello")
    user.page.get_by_text("<b>bad.log:1: error: not a state log").first.wait_for()

    with user.page.expect_file_chooser() as chooser:
        user.button("Compare with a recording…").click()
    chooser.value.set_files(str(folder / "other.log"))

    user.page.get_by_title("other.log", exact=True).wait_for()
    user.until_distance(math.hypot(1.5, 0.5))


def test_poses_and_velocities_of_two_logs_are_compared(chromium: Any, folder: Path) -> None:
    """The played puck goes from (0, 0) along y at 0.4 m/s and turns at 0.3 rad/s, the other along x at 0.5 m/s."""
    record(folder, "run.log", start=(0.0, 0.0, 0.0), twist=Twist(linear=(0.0, 0.4, 0.0), angular=(0.0, 0.0, 0.3)))
    words = ("play", str(folder / "run.log"), "--compare", str(folder / "other.log"), "--pause", "--port", "0")
    with running_page(*words, environment={}) as url:
        user = CompareUser(chromium, url)
        user.plot("puck.pose.y")
        user.plot("puck::l.twist.linear.x")
        user.open("Compare")
        user.ask("seek", time_ns=1_000_000_000)
        user.until_distance(math.hypot(0.5, 0.1))

        assert user.number("puck", "angle", 2) == pytest.approx(math.degrees(0.3), abs=0.02)
        speeds = [user.cells("puck", quantity)[2] for quantity in ("velocity", "angular velocity")]
        assert speeds == ["0.640m/s", "0.300rad/s"]
        user.open("Plots")
        user.until_plotted("puck.pose.y", 0.4, 0.5)
        user.until_plotted("puck::l.twist.linear.x", 0.0, 0.5)
        user.page.get_by_label("Recording to compare with").select_option("Difference")
        user.until_plotted("puck.pose.y", -0.1, None)
        user.until_plotted("puck::l.twist.linear.x", -0.5, None)
        user.close()
