"""A user plots states of a simulation without ROS: by search, from the inspector, into files, along the timeline."""

import contextlib
import csv
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lxml import etree
from numpy.typing import NDArray
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]
BOX = "<geometry><box><size>0.5 0.5 0.5</size></box></geometry>"
ROD = """<link name="rod"><pose>0 0 2 0 0 0</pose><inertial><pose>0.5 0 0 0 0 0</pose></inertial></link>
<joint name="hinge" type="revolute"><parent>world</parent><child>rod</child><axis><xyz>0 1 0</xyz></axis></joint>"""
WORLD = f"""<sdf version="1.6"><world name="w">
<model name="floor"><static>1</static><link name="l"><collision name="c"><pose>0 0 -0.5 0 0 0</pose>
<geometry><box><size>9 9 1</size></box></geometry></collision></link></model>
<model name="box"><pose>0 2 0.25 0 0 0</pose><link name="base"><inertial><mass>2</mass></inertial>
<visual name="v">{BOX}</visual><collision name="c">{BOX}</collision>
<sensor name="inertia" type="imu"><update_rate>50</update_rate></sensor></link></model>
<model name="arm">{ROD}</model></world></sdf>"""
POSITION, FORCE, GRAVITY = (
    "arm::hinge.position",
    "box::base.contact.force.z",
    "box::base::inertia.linear_acceleration.z",
)


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    world = tmp_path_factory.mktemp("plots") / "w.sdf"
    world.write_text(WORLD)
    with running_page("run", str(world), "--no-ros", environment={}) as url:
        yield url


@pytest.fixture(scope="module")
def user(chromium: Any, url: str) -> Iterator[PanelUser]:
    """Plot a joint, a force and a sensor: two by search, one from the inspector."""
    with contextlib.closing(PanelUser(chromium, url)) as user:
        user.open("Plots")
        user.button("Add curve").first.click()
        for search, path in (("force.z", FORCE), ("inertia", GRAVITY)):
            user.page.get_by_label("Search values").fill(search)
            user.page.get_by_role("treeitem").filter(has_text=path).click()
        user.button("Close").click()
        user.page.get_by_role("treeitem").filter(has_text="arm").first.click()
        user.page.get_by_role("searchbox", name="Search the world").fill("hinge")
        user.page.get_by_role("treeitem").filter(has_text="hinge").first.click()
        user.button("Plot of arm::hinge").click()
        user.page.get_by_role("menuitemcheckbox", name="position").or_(
            user.page.get_by_role("menuitemradio", name="position")
        ).click()
        user.page.keyboard.press("Escape")
        yield user


def legend(user: PanelUser, path: str) -> float | None:
    """Return a curve's value in the legend."""
    row = user.page.locator(".legend li").filter(has=user.page.locator(f'[title="{path}"]'))
    text = row.locator("b").inner_text() if row.count() else "—"
    return None if text == "—" else float(text.replace("−", "-"))


def saved(user: PanelUser, kind: str) -> bytes:
    with user.page.expect_download() as download:
        user.button("Save").click()
        user.page.get_by_role("menuitem", name=kind).click()
    return Path(download.value.path()).read_bytes()


def swing(user: PanelUser) -> NDArray[np.float64]:
    """Return times and values (n, 2) of the arm's curve."""
    _, *rows = csv.reader(saved(user, "CSV").decode().splitlines())
    return np.array([(float(row[0]), float(row[3])) for row in rows if row[3] != ""]).reshape(-1, 2)


def sees_swing(user: PanelUser) -> None:
    """Wait until the arm's curve is two seconds long."""
    user.until(lambda: len(swing(user)) > 10 and np.ptp(swing(user)[:, 0]) > 2.0, what="for two seconds of the curve")


def test_an_empty_plot_offers_the_robots_position(chromium: Any, url: str) -> None:
    with contextlib.closing(PanelUser(chromium, url)) as user:
        user.open("Plots")
        user.button("Position of arm").click()

        user.until(lambda: legend(user, "arm.pose.x") == pytest.approx(0, abs=0.01), what="for the arm's x")
        user.until(lambda: legend(user, "arm.pose.y") == pytest.approx(0, abs=0.01), what="for the arm's y")


def test_plotted_values_match_the_simulation(user: PanelUser) -> None:
    """The box has 2 kg; the accelerometer of a box at rest measures gravity; the arm swings."""
    user.until(lambda: None not in [legend(user, path) for path in (POSITION, FORCE, GRAVITY)], what="for values")
    user.until(lambda: legend(user, FORCE) == pytest.approx(19.6, rel=0.02), what="for the weight")
    assert legend(user, GRAVITY) == pytest.approx(9.8, abs=0.1)
    first = legend(user, POSITION)
    user.until(lambda: legend(user, POSITION) != first, what="for the arm to swing")
    assert user.page.locator(".legend .unit").all_inner_texts() == ["N", "m/s²", "rad"]


def test_curves_are_saved_as_csv_parquet_and_svg(user: PanelUser) -> None:
    sees_swing(user)
    user.button("Pause").last.click()
    head, *_ = csv.reader(saved(user, "CSV").decode().splitlines())
    shown = swing(user)
    assert head == ["time", FORCE, GRAVITY, POSITION]
    assert np.diff(shown[:, 0]).min() > 0.0
    assert np.ptp(shown[:, 1]) > 0.5, "the arm swings"

    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed: pip install 'trundle[sweep]'")
    table = parquet.read_table(io.BytesIO(saved(user, "Parquet"))).to_pydict()
    points = [(t, v) for c, t, v in zip(table["curve"], table["time"], table["value"], strict=True) if c == POSITION]
    assert np.array(points)[: len(shown)] == pytest.approx(shown, abs=1e-9)  # more points arrive meanwhile

    svg = etree.fromstring(saved(user, "SVG"))
    lines = svg.findall(".//{http://www.w3.org/2000/svg}polyline")
    assert len(lines) == 3
    assert all(len(line.get("points", "").split()) > 10 for line in lines)
    user.button("Go on").click()


def test_scrubbing_shows_the_values_of_the_selected_time(user: PanelUser) -> None:
    """Seeking back keeps the curves, and the legend has the values of that time."""
    sees_swing(user)
    user.open("Timeline")
    head = user.page.get_by_role("slider", name="Time")
    head.focus()
    head.press("ArrowLeft")
    user.until(lambda: user.page.get_by_role("button", name="Play").first.is_visible(), what="for the pause")
    user.until_still(lambda: head.get_attribute("aria-valuenow"))
    shown_s = float(head.get_attribute("aria-valuenow"))
    assert shown_s < float(head.get_attribute("aria-valuemax"))
    user.open("Plots")
    shown = swing(user)
    before = shown[shown[:, 0] <= shown_s + 1e-6]
    assert shown[-1, 0] > shown_s + 0.5, "the curves are still there"
    assert len(before) > 10
    user.until(
        lambda: legend(user, POSITION) == pytest.approx(before[-1, 1], abs=2e-3), what="for the value of that time"
    )
