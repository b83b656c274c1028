"""Thin and hollow moving meshes, as walls along their surface."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import trundle
from trundle.sim.physics.convex import mesh_decomposition
from trundle.sim.physics.convex.hulls import Hull, hull_of, surface_error
from trundle.sim.physics.convex.mesh_decomposition import convex_pieces
from trundle.sim.simulation import Simulation

Mesh = tuple[NDArray[np.float64], NDArray[np.intp]]
Load = Callable[..., Simulation]
RING = [(0, 1, 2), (0, 2, 3)]


def box(x: float, y: float, z: float) -> Mesh:
    """Standing on the origin, closed."""
    corners = np.array([(x * (i & 1), y * (i >> 1 & 1), z * (i >> 2)) for i in range(8)], dtype=float)
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    faces = [(q[i], q[j], q[k]) for q in quads for i, j, k in RING]
    return corners - np.array([x / 2, y / 2, 0.0]), np.array(faces, dtype=np.intp)


def open_tray(x: float, y: float, z: float) -> Mesh:
    """A box without a roof and without thickness."""
    corners, faces = box(x, y, z)
    return corners, faces[[not all(f >= 4 for f in face) for face in faces.tolist()]]


def thick_tray(x: float, y: float, z: float, wall: float = 0.02) -> Mesh:
    """The same of a wall, closed."""
    outer, faces = open_tray(x, y, z)
    inner, _ = box(x - 2 * wall, y - 2 * wall, z - wall)
    rim = [(a, b, b + 8) for a, b in ((4, 5), (5, 7), (7, 6), (6, 4))]
    rim += [(a, b + 8, a + 8) for a, b in ((4, 5), (5, 7), (7, 6), (6, 4))]
    return np.concatenate([outer, inner + np.array([0, 0, wall])]), np.concatenate([faces, faces[:, ::-1] + 8, rim])


def bowl(radius: float = 0.5, sides: int = 24) -> Mesh:
    """The lower half of a sphere, standing on the origin."""
    rows = np.linspace(math.pi / 2, math.pi, sides // 2 + 1)
    turns = np.arange(sides) * math.tau / sides
    corners = np.array(
        [(math.sin(r) * math.cos(t), math.sin(r) * math.sin(t), 1 + math.cos(r)) for r in rows for t in turns]
    )
    faces = [
        face
        for i in range(0, sides * (sides // 2), sides)
        for j in range(sides)
        for a, b in [(i + j, i + (j + 1) % sides)]
        for face in ((a, b, a + sides), (b, b + sides, a + sides))
    ]
    return radius * corners, np.array(faces, dtype=np.intp)


def solid(corners: NDArray[np.float64]) -> Hull:
    hull = hull_of(corners)
    assert hull is not None
    return hull


@pytest.fixture(autouse=True)
def _empty_caches(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    mesh_decomposition.clear_cache()


@pytest.mark.parametrize(
    ("mesh", "max_walls", "max_error"),
    [
        (open_tray(2.0, 1.0, 0.2), 5, 0.011),  # voxels: 0.13 m
        (thick_tray(2.0, 1.0, 0.2), 18, 0.001),  # voxels: 0.06 m
        (bowl(), 64, 0.04),  # voxels: 0.12 m
    ],
    ids=["open tray", "closed tray", "bowl"],
)
def test_a_thin_hollow_mesh_becomes_a_few_walls(mesh: Mesh, max_walls: int, max_error: float) -> None:
    cut = convex_pieces(*mesh, fixed=False)
    (error,) = cut.errors
    assert not error.is_filled
    assert error.distance < max_error
    assert error.volume_ratio is None or error.volume_ratio == pytest.approx(1.0, abs=0.05)
    assert 1 < len(cut.corners) <= max_walls
    # No piece sticks out of the mesh, so it stands as the mesh would.
    corners = np.concatenate(cut.corners)
    assert np.min(corners, axis=0) == pytest.approx(mesh[0].min(axis=0), abs=1e-9)
    assert np.max(corners, axis=0) == pytest.approx(mesh[0].max(axis=0), abs=1e-9)


def test_the_surface_error_counts_missing_and_protruding_parts() -> None:
    corners, faces = thick_tray(2.0, 1.0, 0.5)
    triangles = corners[faces]
    filled = [solid(corners)]
    # The middle of the opening is 0.48 m above the tray's floor and as far from its long sides.
    assert surface_error(triangles, filled, closed=True) == pytest.approx(0.48, abs=0.03)
    halves = [solid(box(1.0, 1.0, 1.0)[0] + np.array([x, 0.0, 0.0])) for x in (-0.5, 0.5)]
    whole, its_faces = box(2.0, 1.0, 1.0)
    for closed in (False, True):
        assert surface_error(whole[its_faces], halves, closed=closed) == pytest.approx(0.0, abs=1e-9)
        assert surface_error(whole[its_faces], halves[:1], closed=closed) == pytest.approx(1.0, abs=0.05)
        assert surface_error(whole[its_faces], [], closed=closed) == math.inf


@pytest.mark.parametrize("double", [False, True])
def test_a_flat_plate_keeps_its_notch(double: bool) -> None:
    corners = np.array([(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0)], dtype=float)
    faces = np.array([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)], dtype=np.intp)
    if double:
        faces = np.concatenate([faces, faces[:, ::-1]])
    cut = convex_pieces(corners, faces, fixed=False)
    (error,) = cut.errors
    assert error.distance < 0.011
    notch = np.array([[1.5, 1.5, 0.0]])
    assert all(solid(piece).signed_distances(notch)[0] > 0.3 for piece in cut.corners)


@pytest.mark.parametrize(("mesh", "floor"), [(open_tray(2.0, 1.0, 0.2), 0.005), (thick_tray(2.0, 1.0, 0.2), 0.02)])
def test_a_ball_lies_in_a_tray_that_stands_and_falls_past_it(mesh: Mesh, floor: float, tmp_path: Path) -> None:
    lines = [f"v {x} {y} {z}" for x, y, z in mesh[0]] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh[1]]
    (tmp_path / "m.obj").write_text("\n".join(lines))

    def ball(name: str, pose: str) -> str:
        moments = "<ixx>0.004</ixx><iyy>0.004</iyy><izz>0.004</izz>"
        return (
            f'<model name="{name}"><pose>{pose} 0 0 0</pose><link name="l"><inertial><mass>1</mass><inertia>{moments}'
            "</inertia></inertial><collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry>"
            "</collision></link></model>"
        )

    file = tmp_path / "w.world"
    file.write_text(
        '<sdf version="1.6"><world name="w"><model name="floor"><static>1</static><link name="l"><collision name="c">'
        '<geometry><plane/></geometry></collision></link></model><model name="tray"><link name="l"><inertial>'
        '<mass>20</mass><inertia><ixx>2</ixx><iyy>6</iyy><izz>8</izz></inertia></inertial><collision name="c">'
        "<geometry><mesh><uri>m.obj</uri></mesh></geometry></collision></link></model>"
        f"{ball('inside', '0.3 0.2 0.5')}{ball('beside', '1.15 0 0.5')}</world></sdf>"
    )
    sim = trundle.load(str(file))
    sim.run(2.0)
    assert sim["inside"].pose.position == pytest.approx((0.3, 0.2, 0.1 + floor), abs=1e-3)
    assert sim["beside"].pose.position == pytest.approx((1.15, 0.0, 0.1), abs=1e-3)
    assert sim["tray"].pose.position == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)
