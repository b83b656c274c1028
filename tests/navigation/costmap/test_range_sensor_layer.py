"""The range sensor layer: obstacles in the cone of a sonar."""

import math
from types import SimpleNamespace
from typing import Any

import pytest
from tests.navigation.costmap.layer_parts import quiet_node

from trundle.navigation.costmap import FREE_SPACE, LETHAL, NO_INFORMATION, Bounds, Costmap
from trundle.navigation.costmap.range_sensor_layer import RangeSensorLayer, RangeSettings
from trundle.ros import TransformError
from trundle.spatial import Pose


class Sonar:
    """A layer over 4 m × 4 m with a sonar at (1, 2), which looks along x."""

    def __init__(self, kind: str = "ALL", **settings: Any) -> None:
        self.node = quiet_node()
        self.master = Costmap(80, 80, 0.05, (0.0, 0.0), NO_INFORMATION)
        self.layer = RangeSensorLayer(
            self.node,
            "sonar",
            self.master,
            RangeSettings(**settings),
            ["/sonar"],
            kind=kind,
            frame="map",
            buffer=self,  # pyright: ignore[reportArgumentType]  # it looks up one transform
            is_rolling=False,
        )

    def lookup_transform(self, target: str, source: str, stamp_ns: int) -> Any:
        del target, stamp_ns
        if source != "front":
            raise TransformError(f"no frame {source}")
        return SimpleNamespace(pose=Pose(position=(1.0, 2.0, 0.2)))

    def measure(self, range_m: float, *, count: int = 6, least_m: float = 0.02, frame: str = "front") -> None:
        header = SimpleNamespace(frame_id=frame, stamp=SimpleNamespace(sec=0, nanosec=0))
        limits = {"min_range": least_m, "max_range": 2.0, "field_of_view": 0.5}
        for _ in range(count):
            self.node.handlers["/sonar"](SimpleNamespace(header=header, range=range_m, **limits))
        bounds = Bounds()
        self.layer.update_bounds((0.0, 0.0, 0.0), bounds)
        self.master.clear()
        self.layer.update_costs(self.master, bounds.window(self.master))

    def cost(self, x: float, y: float) -> int:
        cell = self.master.cell(x, y)
        assert cell is not None
        return int(self.master.cells[cell[1], cell[0]])


@pytest.fixture(autouse=True)
def _stamps_are_zero(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.navigation.costmap.range_sensor_layer.to_nsec", lambda _: 0)


def test_readings_mark_what_is_at_their_range_and_free_what_is_before_it() -> None:
    sonar = Sonar()
    sonar.measure(1.0)
    assert sonar.cost(2.02, 2.02) == LETHAL
    assert sonar.cost(1.5, 2.02) == FREE_SPACE
    assert sonar.cost(2.5, 2.02) == NO_INFORMATION  # hidden
    assert sonar.cost(1.5, 3.0) == NO_INFORMATION  # beside the cone


def test_an_obstacle_that_went_away_is_freed() -> None:
    sonar = Sonar()
    sonar.measure(1.0, count=2)
    sonar.measure(1.6, count=8)
    assert sonar.cost(2.02, 2.02) == FREE_SPACE


def test_the_longest_range_clears_only_where_it_is_said() -> None:
    sonar, clearing = Sonar(), Sonar(clear_on_max_reading=True)
    for each in (sonar, clearing):
        each.measure(1.0)
        each.measure(2.0)
    assert sonar.cost(2.02, 2.02) != NO_INFORMATION
    assert clearing.cost(2.02, 2.02) == FREE_SPACE


def test_a_sensor_of_one_range_says_by_infinities_whether_it_sees_something() -> None:
    sonar = Sonar(clear_on_max_reading=True)
    sonar.measure(-math.inf, least_m=2.0)
    assert sonar.cost(3.02, 2.02) == LETHAL
    sonar.measure(math.inf, least_m=2.0)
    assert sonar.cost(3.02, 2.02) == FREE_SPACE


@pytest.mark.parametrize(("range_m", "frame"), [(math.nan, "front"), (-1.0, "front"), (9.0, "front"), (1.0, "nowhere")])
def test_readings_that_say_nothing_change_nothing(range_m: float, frame: str) -> None:
    sonar = Sonar()
    sonar.measure(range_m, frame=frame)
    assert (sonar.master.cells == NO_INFORMATION).all()


def test_a_sonar_that_is_silent_too_long_is_not_current() -> None:
    sonar = Sonar(no_readings_timeout=1.0)
    assert sonar.layer.is_current
    sonar.node.time_ns = 2_000_000_000
    assert not sonar.layer.is_current
