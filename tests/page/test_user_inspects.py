"""A user reads and types properties of moving models."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.scene_user import SceneUser
from tests.system.browser import running_page

pytestmark = [needs_client, pytest.mark.slow]

BOX = "<geometry><box><size>0.4 0.4 0.4</size></box></geometry>"
WORLD = f"""<sdf version="1.6"><world name="sky"><gravity>0 0 0</gravity><model name="balloon"><pose>0 0 2 0 0 0</pose>
<link name="base"><visual name="body">{BOX}</visual></link></model>
<model name="probe"><pose>2 0 1 0 0 0</pose><link name="case"><inertial><mass>2.5</mass><pose>0 0.125 0 0 0 0</pose>
<inertia><ixx>0.01</ixx><iyy>0.02</iyy><izz>0.03</izz><ixy>0</ixy><ixz>0.004</ixz><iyz>0</iyz></inertia></inertial>
<sensor name="level" type="imu"><update_rate>25</update_rate>
<plugin name="level_driver" filename="libgazebo_ros_imu_sensor.so"><topicName>level</topicName></plugin>
</sensor></link>
<plugin name="thruster" filename="libthruster.so"><gain>12.5</gain><noise><stddev>0.25</stddev></noise></plugin>
</model></world></sdf>"""
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


def test_a_typed_twist_is_shown(user: SceneUser) -> None:
    """The velocity is constant, and so are the shown numbers."""
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


def _choose(user: SceneUser, name: str) -> None:
    """Search the tree for an object, and select it."""
    user.page.get_by_label("Search the world").fill(name)
    user.page.get_by_role("treeitem").get_by_text(name, exact=True).click()


def _rows(user: SceneUser) -> dict[str, str]:
    """Return the values in the inspector by name."""
    rows = user.page.locator(".inspector .kv:not(.numbers)").all()
    return dict(tuple(row.locator("> span").all_inner_texts()) for row in rows)


def _line_of(text: str) -> str:
    return f"sky.sdf:{WORLD[: WORLD.index(text)].count(chr(10)) + 1}"


def test_a_link_shows_its_mass_and_inertia(user: SceneUser) -> None:
    _choose(user, "case")

    shown = _rows(user)

    assert float(user.property("Mass [kg]").input_value()) == 2.5
    assert shown["Center of mass"] == "0 · 0.125 · 0m"
    assert shown["ixx · iyy · izz"] == "0.0100 · 0.0200 · 0.0300kg m²"
    assert shown["ixy · ixz · iyz"] == "0 · 0.0040 · 0kg m²"


def test_a_sensor_shows_its_rate_and_source_location(user: SceneUser) -> None:
    _choose(user, "level")

    assert _rows(user) == {"Type": "imu", "Rate": "25Hz"}
    assert user.page.locator(".inspector .src").inner_text().endswith(_line_of('<sensor name="level"'))


def test_plugins_show_their_parameters(user: SceneUser) -> None:
    _choose(user, "thruster")
    of_model, line = _rows(user), user.page.locator(".inspector .src").inner_text()

    _choose(user, "level_driver")
    of_sensor = _rows(user)

    assert of_model == {"File": "libthruster.so", "gain": "12.5", "noise/stddev": "0.25"}
    assert line.endswith(_line_of('<plugin name="thruster"'))
    assert of_sensor == {"File": "libgazebo_ros_imu_sensor.so", "topicName": "level"}
