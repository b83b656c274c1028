"""A user records a video of a simulated camera: its own pictures, in simulated time."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.graphs import running_graph
from tests.page.built_client import needs_client
from tests.page.scene_user import SceneUser
from tests.system.browser import running_page
from tests.video_file import Frame, read_video

pytestmark = [pytest.mark.slow, needs_client]

DISTANCE_M, SPEED, RATE_HZ = 2.0, 0.25, 10
WIDTH_PX = 160
FOCAL_PX = WIDTH_PX / 2
"""A quarter turn is seen."""
_GEOMETRY = "<geometry><box><size>0.02 0.3 0.3</size></box></geometry>"
_RED = "<ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse><emissive>1 0 0 1</emissive>"
WORLD = f"""<sdf version="1.6"><world name="yard"><gravity>0 0 0</gravity>
<scene><background>0 0 0 1</background><grid>0</grid></scene>
<model name="slider"><pose>{DISTANCE_M} -1 0.5 0 0 0</pose><link name="base"><inertial><mass>1</mass></inertial>
<visual name="v">{_GEOMETRY}<material>{_RED}</material></visual></link>
<plugin name="start" filename="libInitialVelocityPlugin.so"><linear>0 {SPEED} 0</linear></plugin></model>
<model name="post"><static>1</static><link name="base"><sensor name="eye" type="camera"><pose>0 0 0.5 0 0 0</pose>
<update_rate>{RATE_HZ}</update_rate><camera><horizontal_fov>1.5708</horizontal_fov>
<image><width>{WIDTH_PX}</width><height>121</height></image><clip><near>0.1</near><far>9</far></clip></camera>
</sensor></link></model></world></sdf>"""


def _column(frame: Frame) -> float:
    """Return the middle column of the red area [px]."""
    picture = frame.picture.astype(int)
    columns = np.nonzero(picture[:, :, 0] > picture[:, :, 1] + 100)[1]
    return float(columns.mean()) if len(columns) else float("nan")


def test_the_videos_time_is_simulated_time(chromium: Any, tmp_path: Path) -> None:
    """At a third of real time, each picture has the time of its stamp, and the box slides at its simulated speed."""
    (tmp_path / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--pause", "--port", "0", "--speed", "0.33")
    with (
        running_graph() as graph,
        running_page(*words, environment={"ROS_MASTER_URI": graph.core.uri}, folder=tmp_path) as url,
    ):
        user = SceneUser(chromium, url)
        user.button("Record a video of eye").first.click()
        user.page.get_by_role("banner").get_by_role("button", name="Play").click()
        user.page.get_by_text(re.compile(r"Recording eye 0:0[2-9]")).wait_for()
        with user.page.expect_download() as download:
            user.button("Stop and save the video of eye").first.click()
        file = tmp_path / download.value.suggested_filename
        download.value.save_as(file)
        user.close()

    frames = read_video(file)
    times = np.array([frame.time_s for frame in frames])
    columns = np.array([_column(frame) for frame in frames])
    assert file.name == "yard_eye.mp4"
    assert frames[0].picture.shape == (120, WIDTH_PX, 3)
    assert len(frames) >= 15
    assert times[-1] >= 1.9
    assert np.diff(times) * RATE_HZ == pytest.approx(np.round(np.diff(times) * RATE_HZ), abs=0.02)
    assert np.polyfit(times, columns, 1)[0] == pytest.approx(-FOCAL_PX * SPEED / DISTANCE_M, rel=0.05)


def test_a_video_without_pictures_is_refused_with_the_reason(chromium: Any, tmp_path: Path) -> None:
    """A paused simulation draws no pictures."""
    (tmp_path / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--pause", "--port", "0")
    with (
        running_graph() as graph,
        running_page(*words, environment={"ROS_MASTER_URI": graph.core.uri}, folder=tmp_path) as url,
    ):
        user = SceneUser(chromium, url)
        user.button("Record a video of eye").first.click()
        user.page.get_by_text("Recording eye 0:00").wait_for()
        user.button("Stop and save").click()
        user.page.get_by_text("No picture has come").wait_for()
        user.close()
