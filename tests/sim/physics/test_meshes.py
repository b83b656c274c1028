"""Meshes: hollow, of several parts or too fine; and terrain."""

import itertools
import math
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import trundle
from trundle.robots.meshes import triangulate
from trundle.sim.physics.convex import mesh_decomposition, pieces
from trundle.sim.physics.convex.hulls import hull_of
from trundle.sim.physics.convex.mesh_decomposition import convex_pieces
from trundle.sim.physics.convex.splitting import MAX_PIECES
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose, Twist

Load = Callable[..., Simulation]
Corner = tuple[float, float, float]


def obj(*quads: tuple[Corner, Corner, Corner, Corner]) -> str:
    lines = [f"v {x} {y} {z}" for quad in quads for x, y, z in quad]
    lines += [f"f {i} {i + 1} {i + 2} {i + 3}" for i in range(1, 4 * len(quads), 4)]
    return "\n".join(lines) + "\n"


def tray(half: float = 1.0, high: float = 0.5) -> str:
    """A floor and four walls without thickness, seen from inside."""
    a, b, c, d = ((x * half, y * half, 0.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))

    def wall(p: Corner, q: Corner) -> tuple[Corner, Corner, Corner, Corner]:
        return (q, p, (*p[:2], high), (*q[:2], high))

    return obj((a, b, c, d), wall(a, b), wall(b, c), wall(c, d), wall(d, a))


def cube(x: float, half: float = 0.25) -> list[tuple[Corner, Corner, Corner, Corner]]:
    quads: list[tuple[Corner, Corner, Corner, Corner]] = []
    for axis, sign in itertools.product(range(3), (-1.0, 1.0)):
        ring = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)][:: int(sign)]
        corners = [list(np.insert(np.array(two), axis, sign) * half + [x, 0.0, half]) for two in ring]
        a, b, c, d = ((float(p[0]), float(p[1]), float(p[2])) for p in corners)
        quads.append((a, b, c, d))
    return quads


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Load a static or moving mesh, and a ball of 0.1 m."""

    def load(mesh: str, ball: str, *, static: bool = True, geometry: str = "", more: str = "") -> Simulation:
        (tmp_path / "m.obj").write_text(mesh)
        geometry = geometry or "<mesh><uri>m.obj</uri></mesh>"
        inertial = "<inertial><mass>1</mass></inertial>"
        file = tmp_path / "w.world"
        file.write_text(
            f'<sdf version="1.6"><world name="w"><model name="m"><static>{static}</static><link name="l">{inertial}'
            f'<collision name="c"><geometry>{geometry}</geometry></collision></link></model><model name="ball">'
            f'<pose>{ball} 0 0 0</pose><link name="l"><inertial><mass>1</mass><inertia><ixx>0.004</ixx><iyy>0.004</iyy>'
            "<izz>0.004</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial><collision name='c'><geometry>"
            f"<sphere><radius>0.1</radius></sphere></geometry></collision></link></model>{more}</world></sdf>"
        )
        return trundle.load(str(file))

    return load


def test_a_room_can_be_entered_and_its_walls_hold(load: Load) -> None:
    sim = load(tray(), "0 0 0.3")
    ball = sim["ball"].link("l")
    sim.run(1.0)
    assert ball.pose.position == pytest.approx((0.0, 0.0, 0.1), abs=1e-3)
    ball.set_twist(Twist((2.0, 0.0, 0.0), (0.0, 20.0, 0.0)))
    furthest = 0.0
    for _ in range(1000):
        sim.step()
        furthest = max(furthest, ball.pose.position[0])
    assert furthest == pytest.approx(0.9, abs=5e-3)


def test_a_ball_rolls_over_the_seams_of_a_floor_without_a_bump(load: Load) -> None:
    edges = np.linspace(-1.0, 1.0, 9)
    tiles = [
        ((x, y, 0.0), (x2, y, 0.0), (x2, y2, 0.0), (x, y2, 0.0))
        for (x, x2), (y, y2) in itertools.product(itertools.pairwise(edges.tolist()), repeat=2)
    ]
    step = ((1.0, -1.0, 0.0), (1.0, 1.0, 0.0), (1.0, 1.0, 0.5), (1.0, -1.0, 0.5))
    sim = load(obj(*tiles, step), "-0.8 0.05 0.1")
    sim["ball"].link("l").set_twist(Twist((0.5, 0.0, 0.0), (0.0, 5.0, 0.0)))
    heights: list[float] = []
    for _ in range(200):
        sim.run(0.01)
        heights.append(sim["ball"].pose.position[2])
    assert sim["ball"].pose.position[0] == pytest.approx(0.2, abs=0.01)
    assert max(heights) - min(heights) < 1e-4


def test_disconnected_parts_of_a_mesh_are_separate_shapes(load: Load) -> None:
    sim = load(obj(*cube(-0.5), *cube(0.5)), "0 0 0.6")
    # The gap is 0.5 m wide: the ball falls through it.
    sim.run(1.0)
    assert sim["ball"].pose.position[2] < -1.0
    assert sim.engine.compiled.geom_collisions.count("m::l::c") == 2


@pytest.fixture
def cache(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    mesh_decomposition.clear_cache()
    return tmp_path / "cache/trundle/meshes"


def gate() -> str:
    """A closed gate, 2 m wide, 1 m thick and 1.5 m high, with a passage of 1 x 1 m: two feet and a beam on them."""
    corners = [(x, y, z) for z in (0.0, 1.0, 1.5) for y in (-0.5, 0.5) for x in (-1.0, -0.5, 0.5, 1.0)]
    cells = {(0, 0), (2, 0), (0, 1), (1, 1), (2, 1)}
    quads: list[list[int]] = []
    for i, j in sorted(cells):
        a, b, c, d = (i + 8 * j, i + 1 + 8 * j, i + 1 + 8 * (j + 1), i + 8 * (j + 1))
        quads += [[a, b, c, d], [a + 4, d + 4, c + 4, b + 4]]
        sides = {(-1, 0): (d, d + 4, a + 4, a), (1, 0): (b, b + 4, c + 4, c), (0, -1): (a, a + 4, b + 4, b)}
        sides[0, 1] = (c, c + 4, d + 4, d)
        quads += [list(quad) for (di, dj), quad in sides.items() if (i + di, j + dj) not in cells]
    return "\n".join(
        [*(f"v {x} {y} {z}" for x, y, z in corners), *(f"f {' '.join(str(n + 1) for n in q)}" for q in quads)]
    )


FLOOR = (
    '<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry>'
    "</collision></link></model>"
)


def hollow(sim: Simulation) -> str:
    (finding,) = [f.what for f in sim.report.findings if "hollow" in f.what]
    return finding


def test_a_moving_hollow_mesh_stays_hollow(load: Load, cache: Path) -> None:
    sim = load(tray(), "0 0 0.3", static=False)
    method = r"physics uses 5 convex pieces: a surface up to (\S+) m away"
    match = re.fullmatch(rf"collision 'c': a hollow mesh of 10 triangles; {method}", hollow(sim))
    assert match
    assert 0.0 < float(match[1]) < 0.011  # filled, it would be 0.5
    # The ball floats in the tray, below its rim, as they fall together.
    sim.run(0.3)
    assert sim["ball"].pose.position[2] - sim["m"].pose.position[2] == pytest.approx(0.3, abs=1e-4)


def test_a_moving_hollow_mesh_stands_on_its_corners_and_can_be_driven_through(load: Load, cache: Path) -> None:
    sim = load(gate(), "0 -1 0.1", static=False, more=FLOOR)
    match = re.search(r"uses \d+ convex pieces: (\S+) times its volume, a surface up to (\S+) m away", hollow(sim))
    assert match
    assert float(match[1]) == pytest.approx(1.0, abs=0.05)
    assert float(match[2]) < 0.1
    sim.run(0.5)
    assert sim["m"].pose.position == pytest.approx((0.0, 0.0, 0.0), abs=1e-5)
    assert sim["m"].pose.quaternion == pytest.approx((1.0, 0.0, 0.0, 0.0), abs=1e-5)
    # The passage is 1 m wide, 1 m deep and 1 m high: a ball rolls through it without contact.
    sim["ball"].link("l").set_twist(Twist((0.0, 2.0, 0.0), (-20.0, 0.0, 0.0)))
    sim.run(0.9)
    assert sim["ball"].pose.position == pytest.approx((0.0, 0.8, 0.1), abs=0.01)


def test_pieces_are_deterministic_and_cached(load: Load, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def corners() -> bytes:
        mesh_decomposition.clear_cache()
        return load(gate(), "0 0 5", static=False).engine.compiled.model.mesh_vert.tobytes()

    first = corners()
    (file,) = cache.glob("*.npz")
    file.unlink()
    assert corners() == first
    monkeypatch.setattr(pieces, "decompose", None)  # from now on, nothing is cut
    assert corners() == first


def test_a_mesh_is_decomposed_once_for_many_compiles(load: Load, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sim = load(gate(), "0 0 5", static=False)
    monkeypatch.setattr(pieces, "decompose", None)  # from now on, nothing is cut
    sim.spawn(sim["m"].model, allow_renaming=True)
    collisions = sim.engine.compiled.geom_collisions
    assert collisions.count("m_0::l::c") == collisions.count("m::l::c") > 1


def test_a_hardly_concave_mesh_becomes_its_hull_with_a_note(load: Load, cache: Path) -> None:
    # A cube of 1 m, the middle of its roof 3 cm lower than the roof's corners: a pyramid of 0.01 m³ is missing.
    ring = ((0, 0), (1, 0), (1, 1), (0, 1))
    corners = [*((x, y, 0.0) for x, y in ring), *((x, y, 1.0) for x, y in ring), (0.5, 0.5, 0.97)]
    sides = [(4, 3, 2, 1), *((1 + i, 1 + (i + 1) % 4, 5 + (i + 1) % 4, 5 + i) for i in range(4))]
    roof = [(5 + i, 5 + (i + 1) % 4, 9) for i in range(4)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + ["f " + " ".join(map(str, face)) for face in [*sides, *roof]]
    sim = load("\n".join(lines), "0 0 5", static=False)
    expected = "physics fills its cavities: 1.01 times its volume, a surface up to 0.0"
    assert hollow(sim).startswith(f"collision 'c': a hollow mesh of 14 triangles; {expected}")
    assert sim.engine.compiled.geom_collisions.count("m::l::c") == 1


def test_a_mesh_of_too_many_pieces_becomes_its_hull() -> None:
    # Twice as many bent strips as there may be pieces.
    count = 2 * MAX_PIECES
    bent = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]])
    vertices = np.concatenate([bent + np.array([3.0 * i, 0.0, 0.0]) for i in range(count)])
    faces = np.concatenate([np.array([[0, 1, 2], [0, 2, 3]]) + 4 * i for i in range(count)])
    pieces = convex_pieces(vertices, faces, fixed=False)
    assert len(pieces.corners) == 1
    assert [error.is_filled for error in pieces.errors] == [True]


@pytest.mark.parametrize("faces", [[], [[0, 0, 0]], [[0, 1, 1]]])
def test_a_mesh_without_area_becomes_its_hull(faces: list[list[int]]) -> None:
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    pieces = convex_pieces(corners, np.array(faces, dtype=np.intp).reshape(-1, 3), fixed=True)
    assert len(pieces.corners) == 1


def test_a_convex_mesh_is_one_piece_for_any_triangulation() -> None:
    turns = np.linspace(0.0, 2 * math.pi, 24, endpoint=False)
    ring = np.column_stack([np.cos(turns), np.sin(turns)])
    vertices = np.concatenate([np.column_stack([ring, np.full(24, z)]) for z in (0.0, 1.0)])
    sides = [[i, (i + 1) % 24, 24 + i] for i in range(24)] + [
        [(i + 1) % 24, 24 + (i + 1) % 24, 24 + i] for i in range(24)
    ]
    caps = [[0, i + 1, i] for i in range(1, 23)] + [[24, 24 + i, 25 + i] for i in range(1, 23)]
    for fixed in (True, False):
        pieces = convex_pieces(vertices, np.array(sides + caps), fixed=fixed)
        assert (len(pieces.corners), pieces.errors) == (1, [])


def test_a_ball_slides_off_the_tip_of_a_cone(load: Load) -> None:
    cone = "<cone><radius>0.5</radius><length>1</length></cone>"
    sim = load("", "0 0 0.7", geometry=cone)
    sim.engine.writer.set_tree_pose(sim["ball"].links[0].index, Pose((0.0, 0.0, 0.9)))
    assert sim.engine.compiled.geom_collisions.count("m::l::c") == 1
    sim.run(0.3)
    # The tip is at 0.5: the ball is stopped by it.
    assert 0.55 < sim["ball"].pose.position[2] < 0.62


def test_a_ball_lies_on_terrain_as_high_as_its_image_is_bright(load: Load, tmp_path: Path) -> None:
    # 0 in the south, 200 in the north (the upper rows), flat in the middle of each half.
    heights = np.zeros((33, 33), dtype=np.uint8)
    heights[:16] = 200
    heights[16] = 100
    Image.fromarray(heights).save(tmp_path / "hills.png")
    terrain = "<heightmap><uri>hills.png</uri><size>8 8 2</size><pos>0 0 0.5</pos></heightmap>"
    for ball, expected in (("0 2 2.5", 0.5 + 2.0 * 200 / 255), ("0 -2 1.0", 0.5)):
        sim = load("", ball, geometry=terrain)
        sim.run(1.5)
        assert sim["ball"].pose.position[2] == pytest.approx(expected + 0.1, abs=2e-3)


def test_a_heightmap_that_is_no_image_is_left_out_with_a_warning(load: Load, tmp_path: Path) -> None:
    (tmp_path / "hills.png").write_bytes(b"no picture")
    sim = load("", "0 0 1", geometry="<heightmap><uri>hills.png</uri><size>8 8 2</size></heightmap>")
    assert any("heightmap 'hills.png'" in w and "left out" in w for w in sim.report.warnings)


def test_an_arm_on_a_wall_of_many_pieces_moves_and_other_bodies_touch_the_wall(tmp_path: Path) -> None:
    # Forty walls and seventy balls are more pairs than are listed one by one; the arm is joined to the first wall.
    box = "<geometry><box><size>0.2 0.2 0.2</size></box></geometry>"
    ball = "<geometry><sphere><radius>0.1</radius></sphere></geometry>"
    walls = "".join(
        f'<model name="w{i}"><static>true</static><pose>{i} 0 0 0 0 0</pose><link name="l"><collision name="c">{box}'
        "</collision></link></model>"
        for i in range(40)
    )
    balls = "".join(
        f'<model name="b{i}"><pose>{0.6 * i} 0.03 0.5 0 0 0</pose><link name="l"><collision name="c">{ball}</collision>'
        "</link></model>"
        for i in range(70)
    )
    arm = (
        f'<model name="arm"><pose>0 0 0 0 0 0</pose><link name="l"><collision name="c">{box}</collision></link></model>'
        '<joint name="j" type="revolute"><parent>w0::l</parent><child>arm::l</child><axis><xyz>0 0 1</xyz></axis>'
        "</joint>"
    )
    file = tmp_path / "w.world"
    file.write_text(f'<sdf version="1.10"><world name="w">{walls}{balls}{arm}</world></sdf>')
    sim = trundle.load(str(file))
    assert sim.engine.compiled.model.npair < 100
    sim.joints[0].command_velocity(1.0)
    sim.run(0.25)
    assert sim.joints[0].velocity == pytest.approx(1.0, rel=0.01)
    # b0 hits the arm on w0, b5 falls on w3, b6 between walls.
    assert sim["b5"].pose.position[2] == pytest.approx(0.2, abs=5e-3)  # still coming to rest
    assert sim["b6"].pose.position[2] == pytest.approx(0.5 - 9.8 * 0.25**2 / 2, rel=0.02)


def test_a_polyline_has_its_height_and_its_hole(load: Load) -> None:
    # A square ring of 2 m, its hole 1 m wide; then an L.
    def points(*corners: tuple[float, float]) -> str:
        return "".join(f"<point>{x} {y}</point>" for x, y in corners)

    outer, inner = (
        points((-1, -1), (1, -1), (1, 1), (-1, 1)),
        points((-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5)),
    )
    ring = f"<polyline>{outer}<height>0.4</height></polyline><polyline>{inner}<height>0.4</height></polyline>"
    for ball, lands in (("0.75 0.75 1", True), ("0 0.75 1", True), ("0 0 1", False), ("0.3 0.3 1", False)):
        sim = load("", ball, geometry=ring)
        sim.run(1.5)
        assert (sim["ball"].pose.position[2] == pytest.approx(0.5, abs=1e-3)) is lands, ball
    corner = f"<polyline>{points((0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2))}<height>0.4</height></polyline>"
    for ball, lands in (("0.5 1.7 1", True), ("1.7 0.5 1", True), ("1.6 1.6 1", False)):
        sim = load("", ball, geometry=corner)
        sim.run(1.5)
        assert (sim["ball"].pose.position[2] == pytest.approx(0.5, abs=1e-3)) is lands, ball


def area(triangles: list[tuple[tuple[float, float], ...]]) -> float:
    return sum(abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2 for a, b, c in triangles)


def test_triangles_cover_a_star_with_two_holes_and_an_island() -> None:
    def circle(x: float, y: float, radii: tuple[float, ...], count: int) -> list[tuple[float, float]]:
        turns = [2 * math.pi * i / count for i in range(count)]
        return [
            (x + radii[i % len(radii)] * math.cos(t), y + radii[i % len(radii)] * math.sin(t))
            for i, t in enumerate(turns)
        ]

    def covered(ring: list[tuple[float, float]]) -> float:
        return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, [*ring[1:], ring[0]], strict=True))) / 2

    star = circle(0.0, 0.0, (3.0, 2.0), 14)
    holes = [circle(-0.9, 0.1, (0.6,), 9), circle(0.9, 0.0, (0.8,), 12)[::-1]]
    island = circle(0.9, 0.0, (0.3,), 6)
    triangles = triangulate([star, *holes, island])
    expected = covered(star) - covered(holes[0]) - covered(holes[1]) + covered(island)
    assert area([*triangles]) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("outline", [[(0.0, 0.0)], [(0.0, 0.0), (1.0, 0.0)], [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]])
def test_an_outline_without_area_has_no_triangles(outline: list[tuple[float, float]]) -> None:
    assert triangulate([outline]) == []


def test_a_flat_piece_has_no_hull_and_nothing_is_printed(capfd: pytest.CaptureFixture[str]) -> None:
    """Four corners in a slanted plane, as cutting UR5's wrist leaves; Qhull would print two pages about them."""
    plane = np.array([[0.0, 0.0], [5.0, 0.0], [5.0, 3.0], [0.0, 3.0]]) @ [[0.6, 0.0, 0.8], [0.0, 1.0, 0.0]] * 1e-3

    assert hull_of(plane + 0.05) is None
    assert hull_of(np.vstack([plane, [[0.0, 0.0, 1e-3]]]) + 0.05) is not None
    assert capfd.readouterr() == ("", "")
