"""A map in a rolling window, whose frame may be another one."""

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from tests.navigation.costmap.layer_parts import quiet_node

from trundle.navigation.costmap import FREE_SPACE, LETHAL, NO_INFORMATION, Bounds, Costmap
from trundle.navigation.costmap.static_layer import StaticLayer, StaticSettings
from trundle.ros import TransformError
from trundle.spatial import Pose


def _map() -> Any:
    """Return 3 m × 2 m with one obstacle at (2.05, 0.55)."""
    cells = np.zeros((20, 30), np.int8)
    cells[5, 20] = 100
    origin = SimpleNamespace(position=SimpleNamespace(x=0.0, y=0.0))
    info = SimpleNamespace(width=30, height=20, resolution=0.1, origin=origin)
    return SimpleNamespace(info=info, data=cells.reshape(-1), header=SimpleNamespace(frame_id="map"))


def _costs(pose: Pose | None, *, frame: str = "odom") -> Costmap:
    """Return the costs of a window of 4 m × 4 m around the origin of its frame, which is at a pose in the map."""
    master = Costmap(40, 40, 0.1, (-2.0, -2.0), NO_INFORMATION)

    def look_up(target: str, source: str) -> Any:
        if pose is None:
            raise TransformError(f"no transform from {source} to {target}")
        assert (target, source) == ("map", "odom")
        return SimpleNamespace(pose=pose)

    buffer: Any = SimpleNamespace(lookup_transform=look_up)
    node = quiet_node()
    layer = StaticLayer(node, "static", master, StaticSettings(), frame=frame, buffer=buffer, is_rolling=True)
    node.handlers["map"](_map())
    bounds = Bounds()
    layer.update_bounds((0.0, 0.0, 0.0), bounds)
    assert bounds.window(master) == (0, 0, 40, 40)
    layer.update_costs(master, bounds.window(master))
    return master


@pytest.mark.parametrize("yaw", [0.0, math.pi / 2.0, -2.0])
def test_the_map_lies_where_the_transform_says(yaw: float) -> None:
    pose = Pose.from_rpy(1.5, 0.5, 0.0, yaw=yaw)
    master = _costs(pose)

    x, y, _ = pose.inverse().transform_point((2.05, 0.55, 0.0))
    cell = master.cell(x, y)
    assert cell is not None
    rows, columns = np.nonzero(master.cells == LETHAL)
    assert np.hypot(columns - cell[0], rows - cell[1]).max() <= 1.5
    free = (master.cells == FREE_SPACE).sum() * 0.01
    assert free == pytest.approx(6.0, abs=0.7)  # [m²], the map's area but for what is beyond the window
    assert (master.cells == NO_INFORMATION).any()  # outside the map


def test_in_the_maps_frame_no_transform_is_needed() -> None:
    master = _costs(None, frame="map")
    cell = master.cell(1.95, 0.55)
    assert cell is not None
    assert master.cells[cell[1], cell[0]] == FREE_SPACE


def test_without_a_transform_the_window_stays_as_it_is(caplog: pytest.LogCaptureFixture) -> None:
    assert (_costs(None).cells == NO_INFORMATION).all()
    assert "no transform from odom to map" in caplog.text
