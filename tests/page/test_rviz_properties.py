"""The page's displays have the names and defaults of rviz's properties: both save the same minimal file."""

import math
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests.graphs import PATIENCE_S, running_graph
from tests.page.picture_cases import VIEW
from tests.page.picture_pair import MESHES
from tests.page.real_rviz import INSTALLED, NOT_INSTALLED, RealRviz, rviz_file

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, SaveRviz, Session
from trundle.page.session import RvizFile

pytestmark = [pytest.mark.slow, pytest.mark.skipif(not INSTALLED, reason=NOT_INSTALLED)]

KINDS = [
    "AccelStamped",
    "Axes",
    "Camera",
    "DepthCloud",
    "Effort",
    "FluidPressure",
    "Grid",
    "GridCells",
    "Illuminance",
    "Image",
    "InteractiveMarkers",
    "LaserScan",
    "Map",
    "Marker",
    "MarkerArray",
    "Odometry",
    "Path",
    "PointCloud",
    "PointCloud2",
    "PointStamped",
    "Polygon",
    "Pose",
    "PoseArray",
    "PoseWithCovariance",
    "Range",
    "RelativeHumidity",
    "RobotModel",
    "TF",
    "Temperature",
    "TwistStamped",
    "WrenchStamped",
]
_OTHERS = {"Enabled", "Frames", "Joints", "Links", "Namespaces", "Tree", "Visibility"}
"""Rows that depend on frames, links and other displays; rviz disables images whose dock is hidden."""


def _saved_by_page(chromium: Any, server: PageServer) -> str:
    """Save by the palette, as a user does; return the file's text."""
    page = chromium.new_page(viewport={"width": 1280, "height": 800})
    page.goto(server.url)
    page.get_by_label("Connected").first.wait_for(timeout=1000 * PATIENCE_S)
    page.keyboard.press("Control+k")
    page.keyboard.type("Save the .rviz file")
    page.get_by_role("option", name="Save the .rviz file").wait_for(timeout=1000 * PATIENCE_S)
    page.keyboard.press("Enter")
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        for request in server.requests():
            if isinstance(request.action, SaveRviz):
                page.close()
                return request.action.text
        page.wait_for_timeout(100)
    pytest.fail("the page saved nothing")


def _differences(real: Mapping[str, Any], page_file: Mapping[str, Any], path: str) -> Iterator[str]:
    for key, value in real.items():
        if key in _OTHERS:
            continue
        at, actual = f"{path}: {key}", page_file.get(key, "nothing")
        if isinstance(value, Mapping):
            yield from _differences(value, actual if isinstance(actual, Mapping) else {"Value": actual}, at)
        elif isinstance(value, float) and isinstance(actual, (int, float)):
            if not math.isclose(value, actual, rel_tol=1e-5):
                yield f"{at} is {actual}, not {value}"
        elif value != actual and not (value in ("", None) and actual in ("", None)):
            yield f"{at} is {actual!r}, not {value!r}"


def test_displays_have_rvizs_properties_and_defaults(chromium: Any, tmp_path: Path) -> None:
    text = rviz_file([{"Class": f"rviz/{kind}", "Name": kind} for kind in KINDS], VIEW)
    with running_graph() as graph:
        rviz = RealRviz(tmp_path, graph, packages=MESHES, remappings={})
        session = Session(title="p", kind="graph", rviz=RvizFile(name="case.rviz", text=text, writable=True))
        address = GraphAddress(master_uri=graph.core.uri)
        try:
            real = rviz.saved(text)
            with PageServer.start(session, at=PageAddress(port=0), graph=address) as server:
                page_file = _saved_by_page(chromium, server)
        finally:
            rviz.close()
    files = (yaml.safe_load(saved)["Visualization Manager"]["Displays"] for saved in (real, page_file))
    by_class = [{it["Class"]: {key: it[key] for key in it if key != "Value"} for it in displays} for displays in files]

    assert set(by_class[0]) == set(by_class[1]) == {f"rviz/{kind}" for kind in KINDS}
    assert [it for name in by_class[0] for it in _differences(by_class[0][name], by_class[1][name], name)] == []
