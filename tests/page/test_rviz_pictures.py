"""Debian's rviz and the page draw the same file on the same graph, display by display."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import pytest
from tests.graphs import running_graph
from tests.page.picture_case import Case
from tests.page.picture_cases import ALONE, CASES, REMAPPINGS, TOGETHER
from tests.page.picture_pair import MESHES, OUT, Pair, publish_cases
from tests.page.real_rviz import INSTALLED, NOT_INSTALLED, RealRviz
from tests.page.ros2_spelling import ros2_spelling

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

pytestmark = [pytest.mark.slow, pytest.mark.skipif(not INSTALLED, reason=NOT_INSTALLED)]


@pytest.fixture(scope="module")
def pair(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Pair]:
    with running_graph() as graph, pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_PACKAGE_PATH", str(MESHES))
        publish_cases(graph)
        rviz = RealRviz(tmp_path_factory.mktemp("rviz"), graph, packages=MESHES, remappings=REMAPPINGS)
        browser_page = chromium.new_page(viewport={"width": 900, "height": 700})
        address = GraphAddress(master_uri=graph.core.uri)
        session = Session(title="pictures", kind="graph")
        try:
            with PageServer.start(session, at=PageAddress(port=0), graph=address) as server:
                yield Pair(graph, rviz, browser_page, server)
        finally:
            browser_page.close()
            rviz.close()


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_the_page_draws_what_rviz_draws(pair: Pair, case: Case) -> None:
    result = pair.agreement(case)

    assert result, f"{case.name}: {result}; see {OUT / case.name}.png"


_OF_EACH_CLASS = list({case.display["Class"]: case for case in reversed(ALONE)}.values())


@pytest.mark.parametrize("case", [*reversed(_OF_EACH_CLASS), *TOGETHER], ids=lambda case: case.name)
def test_a_file_of_ros_2_looks_as_one_of_ros_1(pair: Pair, case: Case) -> None:
    """rviz has the display as ROS 1 writes it, the page as ROS 2 does."""
    spelled = replace(case, display=ros2_spelling(case.display), real=case.real or case.display)

    result = pair.agreement(replace(spelled, name=f"{case.name} of ROS 2"))

    assert result, f"{case.name}: {result}; see {OUT / case.name} of ROS 2.png"


@pytest.mark.parametrize(
    "broken", [{"Length": 1, "Radius": 0.1}, {"Alpha": 0.3}], ids=["in another size", "in other colors"]
)
def test_a_wrong_display_is_detected(pair: Pair, broken: Mapping[str, Any]) -> None:
    """Shows that the comparison can fail, by shape and by color."""
    axes = {"Class": "rviz/Axes", "Name": "Axes", "Length": 2, "Radius": 0.3}

    assert pair.agreement(Case(name="axes", display=axes))
    assert not pair.agreement(Case(name="broken axes", display={**axes, **broken}, real=axes), patience_s=0)
