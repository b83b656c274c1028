"""Cubes in space: rays, projections, streams against another reader, and files."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.navigation.octomaps._octomaps import OccupancyTree
from trundle.navigation.octomaps.ground import is_ground
from trundle.navigation.octomaps.octomap_file import load_octomap, read_resolution, write_octomap
from trundle.navigation.octomaps.octomap_messages import map_fields
from trundle.navigation.octomaps.octomap_settings import GroundFilter
from trundle.planning.move_group.scene import read_octomap
from trundle.ros import Messages

_NONE = np.zeros((0, 3))


def _tree(resolution: float = 0.1) -> OccupancyTree:
    return OccupancyTree(resolution, hit=0.85, miss=-0.4, lower=-2.0, upper=3.5)


def _sphere(radius_m: float, count: int) -> NDArray[np.float64]:
    points = np.random.default_rng(3).normal(size=(count, 3))
    return radius_m * points / np.linalg.norm(points, axis=1)[:, None]


def _cells(points: NDArray[np.float64], size: float) -> set[tuple[int, ...]]:
    return {tuple(cell) for cell in np.floor(points / size).astype(int).tolist()}


def _occupied(messages: Messages, data: NDArray[np.uint8], *, binary: bool, size: float = 0.1) -> set[tuple[int, ...]]:
    """Return the smallest occupied cubes of a stream, as move_group reads it."""
    octomap = {"id": "OcTree", "binary": binary, "resolution": size, "data": data.view(np.int8)}
    fields = {"octomap": octomap, "origin": {"orientation": {"w": 1.0}}}
    voxels = read_octomap(messages.new("octomap_msgs/OctomapWithPose", fields))
    found: set[tuple[int, ...]] = set()
    for center, length in zip(voxels.centers, voxels.sizes, strict=True):
        steps = (np.arange(round(length / size)) + 0.5) * size - 0.5 * length
        corners = np.stack(np.meshgrid(steps, steps, steps), axis=-1).reshape(-1, 3) + center
        found |= _cells(corners, size)
    return found


def test_rays_occupy_their_ends_and_free_what_they_pass(messages: Messages) -> None:
    """Against points along each ray, 1 mm apart."""
    origin, ends, tree = np.array([0.03, -0.02, 0.04]), _sphere(1.5, 400), _tree()
    tree.insert(origin.tolist(), ends, _NONE, max_range=-1.0)

    hit = _cells(ends, 0.1)
    shares = np.linspace(0.0, 1.0, 1600)[None, :, None]
    passed = _cells((origin + (ends - origin)[:, None, :] * shares).reshape(-1, 3), 0.1) - hit
    assert all(tree.odds(((np.array(cell) + 0.5) * 0.1).tolist()) == pytest.approx(0.85) for cell in hit)
    assert all(tree.odds(((np.array(cell) + 0.5) * 0.1).tolist()) == pytest.approx(-0.4) for cell in passed)
    assert np.isnan(tree.odds((3.0, 0.0, 0.0)))
    assert _occupied(messages, tree.binary(), binary=True) == hit
    assert _occupied(messages, tree.full(), binary=False) == hit


def test_rays_beyond_the_range_free_only(messages: Messages) -> None:
    tree = _tree()
    tree.insert((0.05, 0.05, 0.05), np.array([[5.05, 0.05, 0.05]]), np.array([[0.05, 1.05, 0.05]]), max_range=2.0)

    assert tree.odds((1.95, 0.05, 0.05)) < 0.0
    assert np.isnan(tree.odds((2.25, 0.05, 0.05)))
    assert tree.odds((0.05, 1.05, 0.05)) < 0.0  # the floor
    assert _occupied(messages, tree.binary(), binary=True) == set()


def test_log_odds_are_bounded_and_cubes_change_their_mind() -> None:
    tree, near, far = _tree(), np.array([[1.05, 0.05, 0.05]]), np.array([[2.05, 0.05, 0.05]])
    for _ in range(10):
        tree.insert((0.05, 0.05, 0.05), near, _NONE, max_range=-1.0)
    assert tree.odds(near[0]) == pytest.approx(3.5)
    for _ in range(9):
        tree.insert((0.05, 0.05, 0.05), far, _NONE, max_range=-1.0)
    assert tree.odds(near[0]) == pytest.approx(3.5 - 9 * 0.4, abs=1e-5)


def test_the_projection_has_what_is_between_two_heights() -> None:
    tree = _tree()
    hits = np.array([[1.05, 0.05, 0.55], [1.05, 1.05, 2.55]])
    tree.insert((0.05, 0.05, 0.55), hits, _NONE, max_range=-1.0)

    x, y, cells = tree.project(0.0, 1.0)
    assert (x, y, cells.shape) == (1 << 15, 1 << 15, (11, 11))
    assert (cells == 100).sum() == 1
    assert cells[0, 10] == 100
    assert (cells[0, :10] == 0).all()
    assert cells[10, 10] == -1  # only above
    assert (tree.project(2.0, 3.0)[2] == 100).nonzero() == ([10], [10])


def test_a_map_of_too_many_cells_is_refused() -> None:
    tree = _tree()
    for corner in (-3000.0, 3000.0):
        tree.insert((corner, corner, 0.0), np.array([[corner + 0.5, corner, 0.0]]), _NONE, max_range=-1.0)

    with pytest.raises(ValueError, match=r"60006 × 60001 cells; at most 100000000"):
        tree.project(-1.0, 1.0)
    near = _tree()
    near.insert((0.05, 0.05, 0.05), np.array([[1.05, 0.05, 0.05]]), _NONE, max_range=-1.0)
    with pytest.raises(ValueError, match=r"20000 × 20000 cells; at most 100000000"):
        map_fields(near, {"stamp": 0}, (-1.0, 1.0), (2000.0, 2000.0))


def test_a_box_is_cleared(messages: Messages) -> None:
    tree = _tree()
    tree.insert((0.05, 0.05, 0.05), _sphere(1.5, 400), _NONE, max_range=-1.0)
    tree.clear_box((-2.0, -2.0, 0.0), (2.0, 2.0, 2.0))

    left = _occupied(messages, tree.binary(), binary=True)
    assert left
    assert max(z for _, _, z in left) < 0
    tree.reset()
    assert tree.is_empty
    assert not len(tree.binary())


def test_uniform_cubes_are_one_leaf() -> None:
    tree = _tree(1.0)
    grid = np.stack(np.meshgrid(*[np.arange(8.0) + 0.5] * 3), axis=-1).reshape(-1, 3)
    for point in grid:
        tree.insert(point.tolist(), point[None], _NONE, max_range=-1.0)

    assert tree.leaves(occupied=True).tolist() == [[4096, 4096, 4096, 13]]
    again = _tree(1.0)
    assert again.read(tree.full(), binary=False)
    assert again.leaves(occupied=True).tolist() == [[4096, 4096, 4096, 13]]
    assert len(tree.binary()) == 2 * 13


@pytest.mark.parametrize("binary", [True, False])
def test_files_keep_the_cubes(binary: bool, tmp_path: Path, messages: Messages) -> None:
    tree, file = _tree(0.05), tmp_path / ("room.bt" if binary else "room.ot")
    tree.insert((0.0, 0.0, 0.0), _sphere(1.2, 3000), _NONE, max_range=-1.0)
    data = tree.binary() if binary else tree.full()
    write_octomap(file, data, kind="OcTree", resolution=0.05, binary=binary)

    again = _tree(read_resolution(file))
    load_octomap(file, again)
    assert again.resolution == 0.05
    assert bytes(again.binary() if binary else again.full()) == bytes(data)
    assert _occupied(messages, again.binary(), binary=True, size=0.05)


_HEAD = b"# Octomap OcTree binary file\nid OcTree\nsize 1\nres 0.1\ndata\n"


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        (b"P5 3 3", "not a file of octomap"),
        (b"# Octomap OcTree file\nid OcTree\nres 0.1\n", "not a file of octomap"),
        (_HEAD.replace(b"id OcTree", b"id Quad") + b"\0\0", "a tree of type 'Quad'"),
        (_HEAD.replace(b"0.1", b"nan") + b"\0\0", "'res' must be a length"),
        (_HEAD + b"\3", "end inside a node"),
        (_HEAD + b"\3\0" * 9, "end inside a node"),
        (_HEAD + b"\x55\x55", "too many cubes"),
        (_HEAD.replace(b" binary", b"") + b"\0\0\xc0\x7f\0", "end inside a node"),
    ],
    ids=["another kind", "no data", "type", "resolution", "short", "endless", "all of space", "NaN"],
)
def test_damaged_files_are_refused(content: bytes, problem: str, tmp_path: Path) -> None:
    file = tmp_path / "map.bt"
    file.write_bytes(content)
    with pytest.raises(UsageError, match=problem):
        load_octomap(file, _tree(read_resolution(file)))


def test_the_ground_is_a_level_plane_near_the_robots_feet() -> None:
    random = np.random.default_rng(5)
    floor = np.column_stack([random.uniform(-2.0, 2.0, (500, 2)), random.normal(0.03, 0.01, 500)])
    floor[:, 2] += 0.05 * floor[:, 0]
    table = np.column_stack([random.uniform(0.5, 1.0, (400, 2)), np.full(400, 0.7)])
    settings = GroundFilter(0.05, 0.15, 0.07)

    found = is_ground(np.vstack([floor, table]), settings)
    assert found[:500].mean() > 0.95
    assert not found[500:].any()
    few: Any = is_ground(np.array([[1.0, 0.0, 0.02], [1.0, 0.0, 0.3]]), settings)
    assert few.tolist() == [True, False]
