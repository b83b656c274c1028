"""The voxel layer: obstacles at heights, freed by the rays that pass through them."""

import math
from typing import Any

import numpy as np
from hypothesis import given, strategies as st
from tests.navigation.costmap.layer_parts import quiet_node, saw, source

from trundle.navigation import _grids
from trundle.navigation.costmap import FREE_SPACE, LETHAL, NO_INFORMATION, Bounds, Costmap
from trundle.navigation.costmap.voxel_layer import NonPersistentVoxelLayer, VoxelLayer, VoxelSettings
from trundle.navigation.settings import read_settings
from trundle.robots.parameters import RosParameters

_SENSOR = (1.05, 1.05, 0.5)
_place = st.tuples(st.floats(0.01, 9.99), st.floats(0.01, 9.99), st.floats(0.01, 9.99))


class Scene:
    """A layer over 4 m × 4 m with one sensor, whose costs are those of the costmap."""

    def __init__(self, kind: type[VoxelLayer] = VoxelLayer, *, tracks_unknown: bool = False, **settings: Any) -> None:
        self.master = Costmap(40, 40, 0.1, (0.0, 0.0), NO_INFORMATION if tracks_unknown else FREE_SPACE)
        self.sensor = source()
        self.layer = kind(
            quiet_node(),
            "voxels",
            self.master,
            VoxelSettings(**settings),
            [self.sensor],
            is_rolling=True,
            tracks_unknown=tracks_unknown,
            frame="odom",
            topic=None,
        )

    def see(self, *points: tuple[float, float, float], sensor: tuple[float, float, float] = _SENSOR) -> Bounds:
        self.sensor.seen = [saw(sensor, *points)]
        self.master.clear()
        bounds = Bounds()
        self.layer.update_bounds((1.0, 1.0, 0.0), bounds)
        self.layer.update_costs(self.master, (0, 0, 40, 40))
        return bounds

    def cost(self, x: float, y: float) -> int:
        cell = self.master.cell(x, y)
        assert cell is not None
        return int(self.master.cells[cell[1], cell[0]])


def test_only_a_ray_at_an_obstacles_height_frees_its_column() -> None:
    scene = Scene()
    scene.see((2.05, 1.05, 0.5))
    assert scene.cost(2.05, 1.05) == LETHAL

    scene.see((3.05, 1.05, 1.1), sensor=(1.05, 1.05, 1.1))  # passes 0.6 m above it
    assert (scene.cost(2.05, 1.05), scene.cost(3.05, 1.05)) == (LETHAL, LETHAL)

    bounds = scene.see((3.05, 1.05, 0.5))
    assert scene.cost(2.05, 1.05) == FREE_SPACE
    assert bounds.window(scene.master)[2] > 30


def test_what_is_above_the_levels_or_too_high_is_no_obstacle_and_what_is_below_them_counts_at_the_lowest() -> None:
    scene = Scene(z_voxels=5, max_obstacle_height=0.9)
    scene.see((2.05, 1.05, 0.95), (2.05, 2.05, 1.5), (2.05, 3.05, -0.3))
    assert [scene.cost(2.05, y) for y in (1.05, 2.05, 3.05)] == [FREE_SPACE, FREE_SPACE, LETHAL]


def test_a_column_has_at_most_16_levels() -> None:
    warnings: list[str] = []
    parameters = RosParameters({"z_voxels": 40}, "/move_base/voxels", warn=warnings.append)
    assert read_settings(VoxelSettings, parameters).z_voxels == 16
    assert warnings == ["parameter /move_base/voxels/z_voxels must be ≤ 16, got 40; 16 is used"]


def test_mark_threshold_is_the_number_of_levels_that_may_be_occupied() -> None:
    scene = Scene(mark_threshold=1)
    scene.see((2.05, 1.05, 0.5), (3.05, 1.05, 0.5), (3.05, 1.05, 0.7))
    assert [scene.cost(x, 1.05) for x in (2.05, 3.05)] == [FREE_SPACE, LETHAL]


def test_a_column_is_known_once_few_of_its_levels_are_unknown() -> None:
    scene = Scene(tracks_unknown=True, z_voxels=2, unknown_threshold=1)
    scene.see((3.05, 1.05, 0.1), sensor=(1.05, 1.05, 0.1))
    assert scene.cost(2.05, 1.05) == FREE_SPACE  # one of two levels is unknown

    strict = Scene(tracks_unknown=True, z_voxels=2, unknown_threshold=0)
    strict.see((3.05, 1.05, 0.1), sensor=(1.05, 1.05, 0.1))
    assert strict.cost(2.05, 1.05) == NO_INFORMATION


def test_obstacles_stay_in_their_place_while_the_window_rolls() -> None:
    scene = Scene()
    scene.see((2.05, 1.05, 0.5))
    scene.master.shift_to(0.5, -0.3)
    scene.see()
    assert scene.cost(2.05, 1.05) == LETHAL

    scene.see((3.05, 1.05, 0.5))
    assert scene.cost(2.05, 1.05) == FREE_SPACE  # its voxel moved, too


def test_a_square_is_cleared_with_its_voxels() -> None:
    scene = Scene()
    scene.see((2.05, 1.05, 0.5))
    scene.layer.clear_outside(2.0, 1.0, 1.0, invert=True)
    scene.see()
    assert scene.cost(2.05, 1.05) == FREE_SPACE


def test_a_layer_that_is_not_persistent_keeps_only_what_it_sees_now() -> None:
    scene = Scene(NonPersistentVoxelLayer)
    scene.see((2.05, 1.05, 0.5))
    scene.see((2.05, 3.05, 0.5))
    assert [scene.cost(2.05, y) for y in (1.05, 3.05)] == [FREE_SPACE, LETHAL]


@given(_place, _place)
def test_a_ray_frees_every_voxel_that_it_crosses(
    sensor: tuple[float, float, float], end: tuple[float, float, float]
) -> None:
    voxels = np.full((10, 10), 0xFFFFFFFF, np.uint32)
    cells = np.full((10, 10), LETHAL, np.uint8)
    limits = {"levels": 10, "unknown_threshold": 16, "mark_threshold": 15}
    _grids.clear_voxel_rays(voxels, cells, sensor, np.array([end]), **limits)

    for share in np.linspace(0.0, 1.0, 200):
        place = [a + share * (b - a) for a, b in zip(sensor, end, strict=True)]
        if min(abs(value - round(value)) for value in place) > 1e-9:  # not on a face
            column, row, level = (math.floor(value) for value in place)
            assert not voxels[row, column] & (1 << level | 1 << level + 16)
            assert cells[row, column] == FREE_SPACE


def test_hostile_rays_end_where_the_grid_does() -> None:
    voxels, cells = np.full((3, 3), 0xFFFF, np.uint32), np.full((3, 3), LETHAL, np.uint8)
    ends = np.array([[math.nan, 0.0, 0.0], [1e300, 0.0, 0.0], [-1e5, 0.5, 0.5], [1.5, 1.5, 1e5]])
    limits = {"levels": 4, "unknown_threshold": 16, "mark_threshold": 0}
    _grids.clear_voxel_rays(voxels, cells, (1.5, 0.5, 0.5), ends, **limits)
    assert (cells[1:] == LETHAL).all() or cells[0, 0] == FREE_SPACE
    assert cells[0, :2].tolist() == [FREE_SPACE, FREE_SPACE]
