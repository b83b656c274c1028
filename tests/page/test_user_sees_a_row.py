"""A row of a sweep in the browser, of a world and of a launch file, bitwise the same as in the sweep."""

from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

from trundle.studies.sweep.plan_reader import load_plan
from trundle.studies.sweep.row_result import RowResult
from trundle.studies.sweep.row_runner import runner_of
from trundle.studies.sweep.rows import Rows

pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")
pytestmark = [pytest.mark.slow, needs_client]

BOX = """<link name="link"><inertial><mass>1</mass><inertia><ixx>0.007</ixx><iyy>0.007</iyy><izz>0.007</izz>
<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>
<collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
<visual name="v"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></visual></link>"""
FLOOR = """<model name="floor"><static>1</static><link name="l"><collision name="c"><geometry><plane/></geometry>
</collision></link></model>"""
BODY = """duration: 2
seed: 5
samples: 5
vary: {models/box/links/link/inertial/mass: {uniform: [0.5, 2]}}
events: [{at: 0.5, push: box/link, force: [30, 4, 0], for: 0.2}]
measure: {x: models.box.x, y: models.box.y, yaw: models.box.yaw, fastest: {max: models.box.speed}}
"""
LAUNCH = """<launch>
<node pkg="gazebo_ros" type="gzserver" name="gazebo" args="$(dirname)/floor.world"/>
<node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-sdf -file $(dirname)/box.sdf -model box -z 0.1"/>
</launch>"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    def sdf(inside: str) -> str:
        return f'<sdf version="1.6">{inside}</sdf>'

    files = {
        "box.world": sdf(f'<world name="w">{FLOOR}<model name="box"><pose>0 0 0.1 0 0 0</pose>{BOX}</model></world>'),
        "floor.world": sdf(f'<world name="w">{FLOOR}</world>'),
        "box.sdf": sdf(f'<model name="box">{BOX}</model>'),
        "box.launch": LAUNCH,
        "world.yaml": f"world: box.world\n{BODY}",
        "launch.yaml": f"launch: box.launch\n{BODY}",
        "stopped.yaml": f"launch: box.launch\n{BODY}stop: [models.box.speed > 0.5]\nevery: 0.01\n",
    }
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def _alone(plan: Path, number: int) -> RowResult:
    read = load_plan(plan)
    return runner_of(read).run(Rows(read).row(number))


@pytest.mark.parametrize("name", ["world.yaml", "launch.yaml", "stopped.yaml"])
def test_a_row_runs_in_the_browser_as_in_the_sweep(chromium: Any, folder: Path, name: str) -> None:
    result = _alone(folder / name, 3)
    assert result.status == "ok", result.reason
    with (folder / "output").open("w+") as output:
        words = ("sweep", name, "--row", "3", "--port", "0")
        with running_page(*words, environment={}, folder=folder, output=output) as url:
            user = WorldUser(chromium, url)
            user.until(lambda: user.model("box") is not None, what="for the box")
            user.until(lambda: "the run shown" in (folder / "output").read_text(), what="for the end of the run")
            user.until(lambda: user.is_paused, what="for the pause at the end")
            x, y = result.measures["x"], result.measures["y"]
            assert isinstance(x, float)
            assert x > 0.002, "the box was pushed"
            assert user.position("box")[:2] == pytest.approx((x, y), abs=1e-6), "single precision"
            user.page.keyboard.press("Shift+R")
            user.until(lambda: abs(user.position("box")[0]) < 1e-6, what="for the reset")
            user.page.get_by_role("banner").get_by_role("button", name="Play", exact=True).click()
            user.until(lambda: user.position("box")[0] > x / 2, what="for the second run")
            user.close()
    printed = (folder / "output").read_text()
    assert printed.startswith(f"row 3: seed {Rows(load_plan(folder / name)).row(3).seed}\n"), printed
    assert f"\n  x = {result.measures['x']}\n" in printed
    assert "the run shown has the same result, to the byte\n" in printed, printed
