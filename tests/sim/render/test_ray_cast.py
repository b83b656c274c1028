"""Ray casts: ranges, and the shapes hit."""

import math

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.sim.render import NativeRenderer, Scene, Shape, ShapeGeometry
from trundle.spatial import Pose

HERE = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]
SOLIDS: dict[str, ShapeGeometry] = {
    "box": Box((1.0, 0.6, 0.8)),
    "sphere": Sphere(0.5),
    "cylinder": Cylinder(0.4, 1.1),
    "capsule": Capsule(0.3, 0.9),
    "ellipsoid": Ellipsoid((0.6, 0.3, 0.45)),
}


def renderer(*shapes: Shape, bodies: int = 1) -> NativeRenderer:
    native = NativeRenderer(Scene(bodies=tuple(map(str, range(bodies))), shapes=shapes))
    native.update(np.array([HERE] * bodies))
    return native


def around(columns: int, rows: int = 1) -> NDArray[np.float64]:
    """Unit directions all around, rows of them from 40° below to 40° above."""
    yaw, pitch = np.meshgrid(np.linspace(-math.pi, math.pi, columns), np.linspace(-0.7, 0.7, rows))
    flat = np.cos(pitch)
    return np.stack([flat * np.cos(yaw), flat * np.sin(yaw), np.sin(pitch)], axis=-1).reshape(-1, 3)


def ico(level: int) -> Mesh:
    """A ball of 0.7 m, of triangles."""
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=level, radius=0.7)
    return Mesh(ball.vertices.astype(np.float32), ball.faces.astype(np.int32))


def engine(placed: list[tuple[str, ShapeGeometry, Pose]]) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The same in MuJoCo."""
    spec = mujoco.MjSpec()
    kinds = mujoco.mjtGeom
    for number, (name, geometry, pose) in enumerate(placed):
        geom = spec.worldbody.add_geom(name=f"{name}{number}", pos=pose.position, quat=pose.quaternion)
        match geometry:
            case Box((x, y, z)):
                geom.type, geom.size = kinds.mjGEOM_BOX, [x / 2, y / 2, z / 2]
            case Sphere(radius):
                geom.type, geom.size = kinds.mjGEOM_SPHERE, [radius, 0, 0]
            case Cylinder(radius, length):
                geom.type, geom.size = kinds.mjGEOM_CYLINDER, [radius, length / 2, 0]
            case Capsule(radius, length):
                geom.type, geom.size = kinds.mjGEOM_CAPSULE, [radius, length / 2, 0]
            case Ellipsoid(radii):
                geom.type, geom.size = kinds.mjGEOM_ELLIPSOID, list(radii)
            case _:
                raise AssertionError(geometry)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def test_rays_agree_with_mujocos_rays() -> None:
    random = np.random.default_rng(3)
    placed = []
    for _ in range(40):
        name = str(random.choice(list(SOLIDS)))
        yaw = random.uniform(-math.pi, math.pi)
        away, up = random.uniform(1.6, 12.0), random.uniform(-2.0, 2.0)
        rpy = random.uniform(-3.0, 3.0, 3).tolist()
        placed.append((name, SOLIDS[name], Pose.from_rpy(away * math.cos(yaw), away * math.sin(yaw), up, *rpy)))
    native = renderer(*(Shape(name=n, body=0, geometry=g, body_from_shape=p) for n, g, p in placed))
    directions = around(1800, 16)
    ranges, shapes = native.cast(Pose(), directions, max_range_m=30.0)

    model, data = engine(placed)
    count = len(directions)
    geoms, far = np.empty(count, dtype=np.int32), np.empty(count)
    flat = directions.reshape(-1)
    mujoco.mj_multiRay(model, data, np.zeros(3), flat, None, 1, -1, geoms, far, None, count, 30.0)
    met = far >= 0.0
    assert met.mean() > 0.1
    assert (shapes == np.where(met, geoms, -1)).all()
    assert np.abs(ranges[met] - far[met]).max() < 1e-8


def test_a_fan_of_rays_measures_a_wall_to_a_hundredth_of_a_millimetre() -> None:
    wall = Shape(name="wall", body=0, geometry=Box((1.0, 400.0, 40.0)), body_from_shape=Pose((20.5, 0.0, 0.0)))
    angles = np.linspace(-1.2, 1.2, 720)
    fan = np.stack([np.cos(angles), np.sin(angles), np.zeros(720)], axis=-1)
    ranges, shapes = renderer(wall).cast(Pose(), fan, max_range_m=100.0)
    assert (shapes == 0).all()
    assert np.abs(ranges - 20.0 / fan[:, 0]).max() < 1e-5


def surface(geometry: ShapeGeometry, random: np.random.Generator) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """A point of it, and its outward normal there."""
    unit = random.normal(size=3)
    unit /= np.linalg.norm(unit)
    flat = np.array([*unit[:2], 0.0]) / math.hypot(*unit[:2])
    match geometry:
        case Box(size):
            axis, half = random.integers(3), np.array(size) / 2
            normal = np.sign(unit[axis]) * np.eye(3)[axis]
            return np.where(normal == 0.0, random.uniform(-half, half), normal * half), normal
        case Cylinder(radius, length):
            up = np.sign(unit[2]) * np.eye(3)[2]
            if random.integers(2):
                return flat * radius * random.uniform(0.0, 1.0) + up * length / 2, up
            return flat * radius + np.array([0.0, 0.0, random.uniform(-length / 2, length / 2)]), flat
        case Capsule(radius, length):
            if random.integers(2):
                return unit * radius + np.array([0.0, 0.0, math.copysign(length / 2, unit[2])]), unit
            return flat * radius + np.array([0.0, 0.0, random.uniform(-length / 2, length / 2)]), flat
        case Ellipsoid(radii):
            return unit * radii, unit / radii / np.linalg.norm(unit / radii)
        case Sphere(radius):
            return unit * radius, unit
        case _:
            raise AssertionError(geometry)


@pytest.mark.parametrize("origin", [0.0, 1e4], ids=["here", "10 km away"])
@pytest.mark.parametrize("name", SOLIDS)
def test_a_range_is_exact_at_any_distance(name: str, origin: float) -> None:
    """A ray from outside to a point of a convex solid does not hit it before that point."""
    random = np.random.default_rng(7)
    for distance in (0.1, 1.0, 10.0, 30.0, 100.0, 1000.0):
        for _ in range(60):
            point, normal = surface(SOLIDS[name], random)
            direction = random.normal(size=3)
            direction /= np.linalg.norm(direction)
            if abs(direction @ normal) < 0.01:
                continue
            direction *= -np.sign(direction @ normal)
            x, y, z = random.uniform(-5.0, 5.0, 3) + origin
            pose = Pose.from_rpy(x, y, z, *random.uniform(-3.0, 3.0, 3))
            start = point - distance * direction
            eye = pose @ Pose((start[0], start[1], start[2]))
            native = renderer(Shape(name=name, body=0, geometry=SOLIDS[name], body_from_shape=pose))
            ranges, shapes = native.cast(eye, direction[None], max_range_m=2000.0)
            assert shapes[0] == 0
            assert ranges[0] == pytest.approx(distance, abs=1e-6)


@pytest.mark.parametrize("distance", [1.0, 10.0, 100.0])
def test_grazing_rays_hit_a_floor_exactly(distance: float) -> None:
    upwards = Pose.from_rpy(0.0, 0.0, 0.0, 0.0, math.pi / 2, 0.0)
    floors: list[tuple[ShapeGeometry, Pose]] = [
        (Plane((0.0, 0.0, 1.0), (0.0, 0.0)), Pose()),
        (Box((300.0, 300.0, 2.0)), Pose((0.0, 0.0, -1.0))),
        (quad(150.0), upwards),
    ]
    for geometry, pose in floors:
        native = renderer(Shape(name="floor", body=0, geometry=geometry, body_from_shape=pose))
        direction = np.array([[math.sqrt(1.0 - 0.25 / distance**2), 0.0, -0.5 / distance]])
        ranges, _ = native.cast(Pose((0.3, 0.2, 0.5)), direction, max_range_m=200.0)
        assert ranges[0] == pytest.approx(distance, abs=1e-5)


def test_rays_start_at_their_origin_and_end_at_their_reach() -> None:
    ball = Shape(name="ball", body=0, geometry=Sphere(0.5), body_from_shape=Pose((1.0, 4.0, 2.0)))
    native = renderer(ball)
    position = Pose.from_rpy(1.0, 1.0, 2.0, 0.0, 0.0, math.pi / 2)
    ahead = np.array([[1.0, 0.0, 0.0]])
    ranges, shapes = native.cast(position, ahead, max_range_m=10.0)
    assert (ranges[0], shapes[0]) == (pytest.approx(2.5, abs=1e-6), 0)
    ranges, shapes = native.cast(position, ahead, max_range_m=2.4)
    assert (ranges[0], shapes[0]) == (math.inf, -1)


@pytest.mark.parametrize("level", [0, 2, 4])
def test_rays_hit_meshes_from_outside_and_inside(level: int) -> None:
    mesh = Shape(name="m", body=0, geometry=ico(level), body_from_shape=Pose.from_rpy(2.0, 0.1, 0.0, 0.4, 0.3, 0.2))
    native = renderer(mesh)
    directions = around(720, 8)
    ranges, shapes = native.cast(Pose(), directions, max_range_m=10.0)
    # Triangles lie a little below the ball that they make.
    slack = {0: 0.16, 2: 0.02, 4: 0.002}[level]
    exact, _ = renderer(Shape(name="b", body=0, geometry=Sphere(0.7), body_from_shape=mesh.body_from_shape)).cast(
        Pose(), directions, max_range_m=10.0
    )
    core = renderer(Shape(name="c", body=0, geometry=Sphere(0.7 - slack), body_from_shape=mesh.body_from_shape))
    inner, _ = core.cast(Pose(), directions, max_range_m=10.0)
    assert (shapes[np.isfinite(inner)] == 0).all()
    assert (shapes[np.isinf(exact)] == -1).all()
    hit = np.isfinite(inner)
    assert (ranges[hit] >= exact[hit] - 1e-5).all()
    assert (ranges[hit] <= inner[hit] + 1e-5).all()
    within, shapes = native.cast(Pose((2.0, 0.1, 0.0)), directions, max_range_m=10.0)
    assert (shapes == 0).all()
    assert within.min() > 0.7 - slack
    assert within.max() < 0.7 + 1e-5


def test_rays_hit_every_triangle_of_a_large_mesh() -> None:
    """A sheet of 20,000 triangles, each looked at through its middle."""
    side = np.linspace(-1.0, 1.0, 101)
    heights = 0.1 * np.sin(9.0 * side)[:, None] * np.cos(7.0 * side)[None, :]
    vertices = np.stack([*np.meshgrid(side, side), heights], axis=-1).reshape(-1, 3).astype(np.float32)
    corner = np.arange(101 * 101).reshape(101, 101)
    a, b, c, d = corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]
    faces = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    native = renderer(Shape(name="sheet", body=0, geometry=Mesh(vertices, faces.astype(np.int32))))
    eye = np.array([0.1, 0.2, 3.0])
    rays = vertices[faces].mean(axis=1) - eye
    away = np.linalg.norm(rays, axis=1)
    ranges, _ = native.cast(Pose((0.1, 0.2, 3.0)), rays / away[:, None], max_range_m=10.0)
    assert (ranges <= away + 1e-5).all()
    assert (np.abs(ranges - away) < 1e-5).mean() > 0.99  # a few are hidden behind a crest


def test_a_rays_hit_is_independent_of_the_other_rays() -> None:
    """Narrow fans of rays go through a mesh together, others one by one."""
    positions = ((2.0, 0.1, 0.0), (-1.0, 0.9, 0.2), (0.2, -1.1, 0.1))
    native = renderer(
        *(Shape(name="m", body=0, geometry=ico(3), body_from_shape=Pose(position)) for position in positions)
    )
    rays = around(720, 8)
    ranges, shapes = native.cast(Pose(), rays, max_range_m=10.0)
    assert len(set(shapes.tolist())) == 4
    shuffled = np.random.default_rng(1).permutation(len(rays))
    again, others = native.cast(Pose(), rays[shuffled], max_range_m=10.0)
    assert again.tobytes() == ranges[shuffled].tobytes()
    assert (others == shapes[shuffled]).all()
    alone = [native.cast(Pose(), direction[None], max_range_m=10.0)[0][0] for direction in rays[::97]]
    assert alone == ranges[::97].tolist()


def quad(half: float, along: float = 0.0) -> Mesh:
    """A square wall that looks back along x; how far it is shifted to the left."""
    corners = [
        (0.0, along - half, -half),
        (0.0, along + half, -half),
        (0.0, along + half, half),
        (0.0, along - half, half),
    ]
    return Mesh(np.array(corners, dtype=np.float32), np.array([[0, 2, 1], [0, 3, 2]], dtype=np.int32))


def test_rays_hit_the_first_of_two_coincident_walls() -> None:
    """The wide one's ball begins elsewhere than the small one's: rays look into one before the other."""
    wall = Pose((2.0, 0.0, 0.0))
    wide, small = quad(4.0, along=3.0), quad(0.5)
    ahead = np.array([[1.0, 0.0, 0.0]])
    for meshes in ((wide, small), (small, wide)):
        native = renderer(*(Shape(name="w", body=0, geometry=mesh, body_from_shape=wall) for mesh in meshes))
        ranges, shapes = native.cast(Pose(), ahead, max_range_m=10.0)
        assert (ranges[0], shapes[0]) == (2.0, 0)


def test_rays_past_a_mesh_hit_the_one_behind_it() -> None:
    """The mesh with the nearest bounding ball need not be hit: rays go on to the next."""
    near, far = quad(0.5, along=1.0), quad(4.0)
    placed = ((far, Pose((3.0, 0.0, 0.0))), (near, Pose((2.0, 0.0, 0.0))))
    native = renderer(*(Shape(name="w", body=0, geometry=mesh, body_from_shape=pose) for mesh, pose in placed))
    slopes = np.linspace(-1.0, 1.0, 201)
    rays = np.stack([np.ones(201), slopes, np.zeros(201)], axis=-1)
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    _, shapes = native.cast(Pose(), rays, max_range_m=20.0)
    behind_near = (slopes > 0.255) & (slopes < 0.745)
    assert (shapes[behind_near] == 1).all()
    assert (shapes[(slopes < 0.245) | (slopes > 0.755)] == 0).all()


def test_invalid_rays_do_not_affect_others() -> None:
    native = renderer(Shape(name="m", body=0, geometry=ico(2), body_from_shape=Pose((2.0, 0.0, 0.0))))
    rays = around(720, 3)[720:1440]
    expected, _ = native.cast(Pose(), rays, max_range_m=10.0)
    lost = np.zeros(720, dtype=bool)
    lost[::7] = True
    rays[lost] = np.nan
    rays[14] = 0.0
    ranges, shapes = native.cast(Pose(), rays, max_range_m=10.0)
    assert np.isinf(ranges[lost]).all()
    assert (shapes[lost] == -1).all()
    assert ranges[~lost].tobytes() == expected[~lost].tobytes()
    assert np.isfinite(expected).any()


def test_excluded_bodies_and_bodies_without_a_pose_are_not_hit() -> None:
    near = Shape(name="near", body=0, geometry=Sphere(0.2), body_from_shape=Pose((1.0, 0.0, 0.0)))
    far = Shape(name="far", body=1, geometry=Sphere(0.2), body_from_shape=Pose((3.0, 0.0, 0.0)))
    ground = Shape(name="ground", body=2, geometry=Plane((0.0, 0.0, 1.0), (0.0, 0.0)))
    native = renderer(near, far, ground, bodies=3)
    rays = np.array([[1.0, 0.0, 0.0], [0.0, 0.6, -0.8]])
    eye = Pose((0.0, 0.0, 2.0))
    native.update(np.array([[0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0]] * 2 + [HERE]))
    ranges, shapes = native.cast(eye, rays, max_range_m=9.0)
    assert shapes.tolist() == [0, 2]
    assert ranges == pytest.approx([0.8, 2.5], abs=1e-5)
    assert native.cast(eye, rays, max_range_m=9.0, exclude=0)[1].tolist() == [1, 2]
    native.update(np.array([[math.nan] * 7, [0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0], HERE]))
    assert native.cast(eye, rays, max_range_m=9.0)[1].tolist() == [1, 2]


def test_casts_without_rays_or_shapes_are_valid() -> None:
    native = renderer()
    ranges, shapes = native.cast(Pose(), around(5), max_range_m=9.0)
    assert np.isinf(ranges).all()
    assert (shapes == -1).all()
    assert len(native.cast(Pose(), np.empty((0, 3)), max_range_m=9.0)[0]) == 0
