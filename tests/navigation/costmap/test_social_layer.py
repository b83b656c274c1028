"""Costs around people, longer ahead of those who walk."""

import math
from types import SimpleNamespace
from typing import Any

import pytest
from tests.navigation.costmap.layer_parts import quiet_node

from trundle.navigation.costmap import FREE_SPACE, NO_INFORMATION, Bounds, Costmap
from trundle.navigation.costmap.social_layer import SocialLayer, SocialSettings
from trundle.ros import TransformError
from trundle.spatial import Pose


class Room:
    """A layer over 6 m × 6 m; people are seen from (1, 1), turned by 90°."""

    def __init__(self, *, passes: bool = False, **settings: Any) -> None:
        self.node = quiet_node()
        self.master = Costmap(120, 120, 0.05, (0.0, 0.0))
        self.layer = SocialLayer(
            self.node,
            "people",
            SocialSettings(**settings),
            frame="map",
            buffer=self,  # pyright: ignore[reportArgumentType]  # it looks up one transform
            passes=passes,
        )

    def lookup_transform(self, target: str, source: str, stamp_ns: int) -> Any:
        del target, stamp_ns
        if source != "camera":
            raise TransformError(f"no frame {source}")
        return SimpleNamespace(pose=Pose.from_rpy(1.0, 1.0, 0.0, yaw=math.pi / 2.0))

    def see(self, *people: tuple[float, float, float, float], frame: str = "camera") -> Bounds:
        """Take people at x, y with velocities x, y in the camera's frame; update."""
        made = [
            SimpleNamespace(position=SimpleNamespace(x=x, y=y, z=0.0), velocity=SimpleNamespace(x=vx, y=vy, z=0.0))
            for x, y, vx, vy in people
        ]
        header = SimpleNamespace(frame_id=frame, stamp=None)
        self.node.handlers["/people"](SimpleNamespace(header=header, people=made))
        return self.update()

    def update(self) -> Bounds:
        bounds = Bounds()
        self.layer.update_bounds((0.0, 0.0, 0.0), bounds)
        self.master.clear()
        self.layer.update_costs(self.master, (0, 0, 120, 120))
        return bounds

    def cost(self, x: float, y: float) -> int:
        cell = self.master.cell(x, y)
        assert cell is not None
        return int(self.master.cells[cell[1], cell[0]])


@pytest.fixture(autouse=True)
def _stamps_are_zero(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.navigation.costmap.social_layer.to_nsec", lambda _: 0)


def test_the_cost_at_a_person_is_the_amplitude_and_falls_off_alike_on_all_sides() -> None:
    room = Room()
    bounds = room.see((2.0, -2.0, 0.0, 0.0))  # at (3, 3) in the map

    assert room.cost(3.01, 3.01) in (76, 77)
    sides = [room.cost(3.01 + 0.5 * x, 3.01 + 0.5 * y) for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))]
    assert min(sides) > max(sides) - 6 > 30
    assert room.cost(4.2, 3.0) == FREE_SPACE  # below the cutoff
    assert bounds.window(room.master)[0] < 45


def test_the_cost_reaches_farther_ahead_of_a_person_who_walks() -> None:
    room = Room()
    room.see((2.0, -2.0, 1.0, 0.0))  # walks along y in the map

    assert room.cost(3.01, 4.0) > 2 * room.cost(4.0, 3.01)
    assert room.cost(3.01, 2.5) == pytest.approx(room.cost(3.5, 3.01), abs=6)  # cells lie beside the person


def test_a_passing_layer_raises_costs_at_one_side_only() -> None:
    room = Room(passes=True)
    room.see((2.0, -2.0, 1.0, 0.0))

    assert room.cost(2.5, 3.01) > 30  # left of a person who walks along y
    assert room.cost(3.5, 3.01) == FREE_SPACE


def test_people_are_forgotten_after_a_time_and_their_place_is_drawn_anew() -> None:
    room = Room(keep_time=0.5)
    room.see((2.0, -2.0, 0.0, 0.0))
    room.node.time_ns = 600_000_000
    bounds = room.update()

    assert (room.master.cells == FREE_SPACE).all()
    assert bounds.window(room.master)[0] < 45 < bounds.window(room.master)[2]


def test_unknown_cells_stay_unknown() -> None:
    room = Room()
    room.master.default = NO_INFORMATION
    room.see((2.0, -2.0, 0.0, 0.0))
    assert (room.master.cells == NO_INFORMATION).all()


@pytest.mark.parametrize(("x", "frame"), [(math.nan, "camera"), (math.inf, "camera"), (2.0, "nowhere")])
def test_people_at_no_place_are_left_out(x: float, frame: str) -> None:
    room = Room()
    room.see((x, -2.0, 0.0, 0.0), frame=frame)
    assert (room.master.cells == FREE_SPACE).all()
