"""A user plots two fields of very different scale: two axes, a zoom, a pause, a file of both."""

import csv
import io
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from PIL import Image, ImageColor
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

pytestmark = [pytest.mark.slow, needs_client]

SMALL, LARGE = "/small/point/x", "/large/point/x"
SECONDS = 20


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def user(chromium: Any, graph: Graph) -> Iterator[PanelUser]:
    """Plot two ramps: from 0 to 1, and from 1000 to 2000."""
    node = graph.node("tester")
    small, large = (node.advertise(f"/{name}", "geometry_msgs/PointStamped") for name in ("small", "large"))
    session = Session(title="t", kind="graph", panels=("rqt_plot",), plots=(SMALL,))
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(session, at=PageAddress(port=0), graph=address) as server:
        user = PanelUser(chromium, server.url)
        user.button("Add curve").first.click()
        path = user.page.get_by_role("combobox", name="Path of a curve")
        path.fill(LARGE)
        path.press("Enter")
        user.button("Close").click()
        graph.until(lambda: small.has_subscribers and large.has_subscribers)
        for second in range(SECONDS + 1):
            fraction = second / SECONDS
            for publisher, value in ((small, fraction), (large, 1000.0 + 1000.0 * fraction)):
                publisher.publish({"header": {"stamp": {"secs": 100 + second, "nsecs": 0}}, "point": {"x": value}})
            user.page.wait_for_timeout(20)
        for value in ("1.000", "2000"):
            user.page.locator(".legend b", has_text=value).wait_for()
        yield user
        user.close()


def _pixels(user: PanelUser, path: str) -> tuple[Any, Any]:
    """Return rows and columns of a curve's pixels in the plot."""
    row = user.page.locator(".legend li").filter(has=user.page.locator(f'[title="{path}"]'))
    token = row.evaluate("one => one.style.getPropertyValue('--c')").removeprefix("var(").removesuffix(")")
    color = user.page.evaluate(f"getComputedStyle(document.documentElement).getPropertyValue('{token}')")
    png = user.page.get_by_role("img", name=f"Plot of {SMALL}").screenshot()
    picture = np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=int)
    rows, columns = np.nonzero((np.abs(picture - ImageColor.getrgb(color.strip())) < 16).all(axis=-1))
    return rows, columns


def _height(user: PanelUser, path: str) -> int:
    """Return the height of a curve [px]."""
    rows, _ = _pixels(user, path)
    return 0 if len(rows) == 0 else int(np.ptp(rows))


def test_a_curve_can_have_its_own_axis(user: PanelUser) -> None:
    """On the axis of the larger one, the smaller curve is flat; on its own axis it is as high."""
    user.until(lambda: _height(user, LARGE) > 30, what="for the curves")
    assert _height(user, SMALL) < 10
    user.button(f"Curve {LARGE}").click()
    user.page.get_by_role("menuitemradio", name="Right axis").click()
    user.until(lambda: _height(user, SMALL) > 60 and _height(user, LARGE) > 60, what="for two axes")


def _time_at(user: PanelUser, fraction: float) -> float:
    """Point at a fraction of the plot's width; return the shown time [s]."""
    box = user.page.locator(".u-over").bounding_box()
    user.page.mouse.move(box["x"] + fraction * box["width"], box["y"] + box["height"] / 2)
    minutes, seconds = user.page.locator(".dock .cursor").inner_text().rsplit(":", 1)
    return 60 * int(minutes) + float(seconds)


def test_the_legend_shows_the_values_at_the_cursor(user: PanelUser) -> None:
    """They are the values of the second before, as there is a point each second."""
    fraction = int(_time_at(user, 0.85) - 100) / SECONDS
    assert 0 < fraction < 1
    shown = user.page.locator(".legend b")

    user.until(lambda: shown.all_inner_texts() == [f"{fraction:.3f}", f"{1000 + 1000 * fraction:.0f}"], what="for both")

    user.page.mouse.move(0, 0)
    user.until(lambda: shown.all_inner_texts() == ["1.000", "2000"], what="for the newest")


def test_a_drag_zooms_in_and_a_button_goes_back(user: PanelUser) -> None:
    box = user.page.locator(".u-over").bounding_box()
    y = box["y"] + box["height"] / 2
    first, last = _time_at(user, 0.5), _time_at(user, 0.75)
    user.page.mouse.move(box["x"] + 0.5 * box["width"], y)
    user.page.mouse.down()
    user.page.mouse.move(box["x"] + 0.75 * box["width"], y, steps=5)
    user.page.mouse.up()
    to_now = user.button("To now")
    to_now.wait_for()
    user.page.wait_for_timeout(200)  # a few frames
    assert _time_at(user, 0.02) == pytest.approx(first, abs=1.0)
    assert _time_at(user, 0.98) == pytest.approx(last, abs=1.0)
    to_now.click()
    user.page.wait_for_timeout(200)
    assert _time_at(user, 0.5) == pytest.approx(first, abs=0.5)


def test_all_curves_are_in_one_file(user: PanelUser) -> None:
    with user.page.expect_download() as download:
        user.button("Save").click()
        user.page.get_by_role("menuitem", name="CSV").click()
    head, *rows = csv.reader(download.value.path().read_text().splitlines())

    assert head == ["time", SMALL, LARGE]
    assert [float(row[0]) for row in rows] == sorted({float(row[0]) for row in rows})  # one row for both
    assert [float(value) for value in rows[-1]] == [120.0, 1.0, 2000.0]
    assert all(float(large) == 1000.0 + 1000.0 * float(small) for _, small, large in rows if small and large)


def test_a_command_is_drawn_as_a_step(user: PanelUser, graph: Graph) -> None:
    """Between two commands a second apart, only the step is between their values."""
    command = "/cmd_vel/linear/x"
    publisher = graph.node("driver").advertise("/cmd_vel", "geometry_msgs/Twist")
    user.button("Add curve").first.click()
    path = user.page.get_by_role("combobox", name="Path of a curve")
    path.fill(command)
    path.press("Enter")
    user.button("Close").click()
    user.page.get_by_label("Time window").select_option("5 s")
    graph.until(lambda: publisher.has_subscribers)
    for value in (0.0, 1.0):
        publisher.publish({"linear": {"x": value}})
        user.page.locator(".legend b", has_text=f"{value:.3f}").last.wait_for()
        user.page.wait_for_timeout(1000)
    publisher.publish({"linear": {"x": 1.0}})
    user.until(lambda: _height(user, command) > 60, what="for the step")

    rows, columns = _pixels(user, command)
    between = columns[(rows > rows.min() + 4) & (rows < rows.max() - 4)]
    assert np.ptp(columns) > 60
    assert np.ptp(between) <= 3
