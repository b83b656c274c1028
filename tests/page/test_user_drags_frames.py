"""A user drags a model: its frames are where it is in the picture, paused and afterwards."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.page.built_client import needs_client
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]

DRAG_PX = (60.0, 110.0)
"""Rows and columns by which the model is dragged."""
NEAR_PX, REACH_PX = 2.0, (40.0, 60.0)
"""How far a frame may be from its model in the picture, and the rows and columns where it is looked for."""
BOX = "<geometry><box><size>0.4 0.4 0.4</size></box></geometry>"
GREEN = "<material><ambient>0 0 0 1</ambient><diffuse>0 0 0 1</diffuse><emissive>0.2 0.9 0.2 1</emissive></material>"
MOVE = """<plugin name="move" filename="libgazebo_ros_planar_move.so"><odometryFrame>odom</odometryFrame>
<robotBaseFrame>base</robotBaseFrame><odometryRate>30</odometryRate></plugin>"""
WORLD = f"""<sdf version="1.6"><world name="yard"><scene><background>0 0 0 1</background><grid>0</grid></scene>
<model name="floor"><static>1</static><link name="l"><collision name="c"><geometry><plane/></geometry></collision>
</link></model><model name="cart"><pose>-1 0 0.2 0 0 0</pose><link name="base"><collision name="c">{BOX}</collision>
<visual name="v">{BOX}{GREEN}</visual></link>{MOVE}</model></world></sdf>"""


@pytest.fixture(scope="module")
def user(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[WorldUser]:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    environment = {"HOME": str(folder), "ROS_MASTER_URI": ""}
    with running_page("run", "yard.sdf", "--port", "0", environment=environment, folder=folder) as url:
        user = WorldUser(chromium, url)
        user.look_down()
        user.side("Displays")
        user.open_rows("TF")
        user.set("Marker Scale", "2")
        yield user
        user.close()


def _middle(mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return the middle of a mask's extent, row and column [px]."""
    rows, columns = np.nonzero(mask)
    assert rows.size > 20, "nothing of that color is drawn"
    return np.array([rows.min() + rows.max(), columns.min() + columns.max()]) / 2


def _drawn(user: WorldUser) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the middle of the model in the picture, and the tip of its frame's x axis from there: row, column [px]."""
    user.until_still(lambda: user.picture().tobytes())
    red, green, blue = np.moveaxis(user.picture().astype(int), -1, 0)
    cube = _middle((green > 180) & (red < 100) & (blue < 100))
    axis = (red > 120) & (red > 1.6 * green) & (red > 1.6 * blue)
    axis[np.abs(np.arange(axis.shape[0]) - cube[0]) > REACH_PX[0]] = False  # that of odom lies elsewhere
    axis[:, np.abs(np.arange(axis.shape[1]) - cube[1]) > REACH_PX[1]] = False
    return cube, np.array([_middle(axis)[0], np.nonzero(axis)[1].max()]) - cube


def test_frames_stay_on_a_model_that_is_dragged_while_paused(user: WorldUser) -> None:
    bar = user.page.get_by_role("banner")
    user.until(lambda: user.page.get_by_role("treeitem").filter(has_text="base").count() > 0, what="for the frame")
    user.until_at_rest("cart")
    bar.get_by_role("button", name="Pause", exact=True).click()
    user.until(lambda: user.is_paused)
    cube, before = _drawn(user)
    assert before == pytest.approx([0.0, 40.0], abs=NEAR_PX), "0.4 m of a pixel per centimetre, to the right"

    user.side("World")
    user.pick("cart")
    user.tool("Move")
    left, top = user.at((-2.5, 1.5))  # corner of the picture
    x, y = left + cube[1] + 13, top + cube[0] + 13  # on the model, beside the arrows
    user.page.mouse.move(x, y)
    user.page.mouse.down()
    user.page.mouse.move(x + DRAG_PX[1], y + DRAG_PX[0], steps=4)
    user.page.mouse.up()
    user.until(lambda: user.position("cart")[0] > -0.3, what="for the drag")
    user.tool("Interact")
    moved, after = _drawn(user)
    assert moved - cube == pytest.approx(DRAG_PX, abs=NEAR_PX)
    assert after == pytest.approx(before, abs=NEAR_PX), "dragged while paused"

    bar.get_by_role("button", name="Play", exact=True).click()
    user.until_at_rest("cart")
    moved, after = _drawn(user)
    assert moved - cube == pytest.approx(DRAG_PX, abs=NEAR_PX)
    assert after == pytest.approx(before, abs=NEAR_PX), "after time has gone on"
