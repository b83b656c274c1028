"""A person reads and types the properties of what moves."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page.scene_user import SceneUser
from tests.system.browser import running_page

from trundle.page.client_files import CLIENT

pytestmark = [
    pytest.mark.skipif(not (CLIENT / "index.html").exists(), reason="the page's client is not built: make"),
    pytest.mark.slow,
]

BOX = "<geometry><box><size>0.4 0.4 0.4</size></box></geometry>"
WORLD = f"""<sdf version="1.6"><world name="sky"><gravity>0 0 0</gravity><model name="balloon"><pose>0 0 2 0 0 0</pose>
<link name="base"><visual name="body">{BOX}</visual></link></model></world></sdf>"""
SPEED, TURN = 0.8, -0.5
"""[m/s], [rad/s]"""


@pytest.fixture(scope="module")
def user(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[SceneUser]:
    folder: Path = tmp_path_factory.mktemp("sky")
    (folder / "sky.sdf").write_text(WORLD)
    with running_page("run", "sky.sdf", "--no-ros", "--port", "0", environment={}, folder=folder) as url:
        user = SceneUser(chromium, url)
        yield user
        user.close()


def _number(user: SceneUser, label: str) -> float:
    return float(user.property(label).input_value().replace("−", "-"))


def test_the_twist_is_read_as_it_was_typed(user: SceneUser) -> None:
    """The velocity stays the same; so does each of the numbers that follow one another."""
    user.page.get_by_role("treeitem").get_by_text("balloon", exact=True).first.click()
    typed = {"linear x [m/s]": SPEED, "angular z [rad/s]": TURN}
    for label, value in typed.items():
        user.set(label, str(value))
        user.until(lambda label=label, value=value: _number(user, label) == value, what=label)

    read = []
    for _ in range(20):
        user.page.wait_for_timeout(200)
        read.append([_number(user, label) for label in typed])

    assert read == [pytest.approx([SPEED, TURN], abs=0.011)] * len(read)
