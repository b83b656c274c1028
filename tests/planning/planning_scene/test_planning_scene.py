"""A planning scene says what touches what, as MoveIt's."""

from pathlib import Path

import numpy as np
import pytest
from tests.planning.arms import changed_arm
from tests.planning.scenes import ready, scene_with, seven_axis, thing

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.planning.planning_scene import (
    OCTOMAP,
    AllowedCollisionMatrix,
    AttachedObject,
    CollisionObject,
    PlacedShape,
    PlanningScene,
    Voxels,
)
from trundle.planning.robot_model import robot_model
from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Cone, Cylinder, Plane, Sphere
from trundle.spatial import Pose

_CUBE = Box((0.1, 0.1, 0.1))


def _flange(scene: PlanningScene) -> tuple[float, float, float]:
    return scene.link_pose("link_7").position


def test_an_arm_alone_is_free_and_one_folded_into_itself_is_not() -> None:
    scene = scene_with()
    model = scene.model
    folded = model.state_of({"joint_2": -1.94, "joint_4": 2.16, "joint_6": -1.4})

    assert scene.is_free()
    assert scene.check() == []
    assert not scene.is_free(folded)
    assert {contact.type_1 for contact in scene.check(folded)} == {"robot_link"}


@pytest.mark.parametrize(
    "geometry", [_CUBE, Sphere(0.06), Cylinder(0.06, 0.1), Cone(0.08, 0.16)], ids=lambda shape: type(shape).__name__
)
def test_a_shape_at_the_flange_touches_it(geometry: Box) -> None:
    scene = scene_with()
    x, y, z = _flange(scene)
    scene.add(thing("thing", geometry, x, y, z))

    (contact, *_) = scene.check()

    assert not scene.is_free()
    assert (contact.body_2, contact.type_2) == ("thing", "world_object")
    assert contact.body_1.startswith("link_")
    assert contact.depth > 0.01
    assert np.linalg.norm(contact.normal) == pytest.approx(1.0)
    assert np.linalg.norm(np.subtract(contact.position, (x, y, z))) < 0.1
    scene.move("thing", Pose((2.0, 0.0, 0.0)))
    assert scene.is_free()
    scene.remove("thing")
    assert dict(scene.objects) == {}


def test_links_whose_default_collisions_are_disabled_touch_no_object() -> None:
    """Panda's coarse links: checked against those of <enable_collisions> alone."""
    srdf = '<disable_default_collisions link="base_link"/><enable_collisions link1="base_link" link2="link_7"/>'
    scene = PlanningScene(changed_arm("seven_axis", srdf=srdf))
    matrix = scene.allowed_collisions

    scene.add(thing("post", Cylinder(0.02, 0.1)))
    is_free_before = "base_link" not in {body for one in scene.check(ready()) for body in (one.body_1, one.body_2)}
    matrix.set_default("base_link", False)
    scene.allowed_collisions = matrix

    assert matrix.allows("base_link", "link_1")
    assert not matrix.allows("base_link", "link_7")
    assert is_free_before
    assert "base_link" in {body for one in scene.check(ready()) for body in (one.body_1, one.body_2)}


def test_a_plane_touches_what_it_cuts() -> None:
    scene = scene_with(thing("floor", Plane((0.0, 0.0, 1.0), (1.0, 1.0)), z=-0.01))
    assert scene.is_free()

    scene.move("floor", Pose((0.0, 0.0, 0.05)))

    assert [contact.body_1 for contact in scene.check()] == ["base_link"]
    tilted = Plane((1.0, 0.0, 0.0), (1.0, 1.0))
    assert scene_with(thing("wall", tilted, x=1.0)).is_free()
    assert not scene_with(thing("wall", tilted, x=0.2)).is_free()


def test_the_depth_and_distance_of_a_ball_are_exact() -> None:
    """A ball beside the base, a cylinder of radius 0.09 m and height 0.16 m."""
    apart = scene_with(thing("ball", Sphere(0.05), x=-0.09 - 0.05 - 0.02, z=0.08)).distance()
    inside = scene_with(thing("ball", Sphere(0.05), x=-0.09 - 0.05 + 0.02, z=0.08)).check()

    assert apart.distance == pytest.approx(0.02, abs=1e-5)
    assert {apart.body_1, apart.body_2} == {"base_link", "ball"}
    assert np.linalg.norm(np.subtract(apart.point_1, apart.point_2)) == pytest.approx(0.02, abs=1e-5)
    assert inside[0].depth == pytest.approx(0.02, abs=1e-4)
    assert inside[0].normal == pytest.approx((-1.0, 0.0, 0.0), abs=1e-3)


def test_padding_keeps_a_distance_and_scale_widens() -> None:
    scene = scene_with(thing("ball", Sphere(0.05), x=-0.16, z=0.08))  # 0.02 m from the base

    assert scene.is_free()
    scene.set_padding("base_link", 0.019)
    assert scene.is_free()
    assert scene.distance().distance == pytest.approx(0.001, abs=1e-5)
    scene.set_padding("base_link", 0.021)
    assert not scene.is_free()
    assert scene.check()[0].depth == pytest.approx(0.001, abs=1e-5)
    scene.set_padding("base_link", 0.0)
    scene.set_scale("base_link", 1.3)  # a radius of 0.117 m
    assert scene.check()[0].depth == pytest.approx(0.007, abs=1e-3)


def test_entries_and_defaults_allow_contacts() -> None:
    scene = scene_with()
    scene.add(thing("thing", Sphere(0.03), *_flange(scene)))
    touched = {contact.body_1 for contact in scene.check()}
    matrix = scene.allowed_collisions
    matrix.set_default("thing", True)
    scene.allowed_collisions = matrix

    assert touched
    assert scene.is_free()
    for link in touched:
        matrix.set_entry("thing", link, False)  # an entry counts before a default
    scene.allowed_collisions = matrix
    assert {contact.body_1 for contact in scene.check()} == touched
    matrix.set_entries("thing", touched, True)
    scene.allowed_collisions = matrix
    assert scene.is_free()


def test_a_matrix_of_messages_keeps_names_and_rows() -> None:
    rows = [[False, True, False], [True, False, False], [False, False, False]]
    matrix = AllowedCollisionMatrix.of_matrix(["a", "b", "c"], rows, {"d": True})

    assert matrix.names == ["a", "b", "c"]
    assert matrix.rows() == rows
    assert matrix.allows("a", "b")
    assert not matrix.allows("a", "c")
    assert matrix.allows("d", "x")
    assert not matrix.allows("x", "y")
    matrix.set_default("x", False)
    assert not matrix.allows("d", "x")
    matrix.remove("a")
    assert matrix.entry("a", "b") is None


def test_an_attached_object_moves_with_its_link_and_touches_what_it_may() -> None:
    scene = scene_with()
    place = scene.link_pose("flange") @ Pose((0.0, 0.0, 0.04))
    scene.add(CollisionObject(name="can", shapes=(PlacedShape(Cylinder(0.03, 0.1)),), pose=place))
    assert not scene.is_free()

    scene.attach_object("can", "flange", ["link_5", "link_6", "link_7"])

    assert scene.is_free()
    assert "can" in scene.attached
    assert "can" not in scene.objects
    there = scene.frame_pose("can")
    scene.add(thing("post", _CUBE, *there.position))
    assert {(contact.body_1, contact.type_1) for contact in scene.check()} >= {("can", "robot_attached")}
    scene.remove("post")
    scene.positions = scene.model.state_of({"joint_1": 1.0}, base=scene.positions)
    assert scene.frame_pose("can").position != pytest.approx(there.position)
    scene.detach("can")
    assert scene.objects["can"].pose.position == pytest.approx(
        (scene.link_pose("flange") @ Pose((0.0, 0.0, 0.04))).position
    )


def test_an_object_attached_without_touch_links_collides_with_links_it_overlaps() -> None:
    scene = scene_with()
    object = CollisionObject(name="can", shapes=(PlacedShape(Cylinder(0.03, 0.2)),))
    scene.attach(AttachedObject(object=object, link="flange"))

    assert {contact.body_1 for contact in scene.check()} & {"link_6", "link_7"}


def test_voxels_touch_and_go() -> None:
    scene = scene_with()
    x, y, z = _flange(scene)
    centers = np.array([[x, y, z], [2.0, 0.0, 0.0]])
    scene.set_voxels(Voxels(centers, np.array([0.05, 0.05])))

    assert {contact.body_2 for contact in scene.check()} == {OCTOMAP}
    scene.set_voxels(Voxels(centers[1:], np.array([0.05])))
    assert scene.is_free()
    scene.set_voxels(Voxels(centers - (x, y, z), np.array([0.05, 0.05]), Pose((x, y, z))))
    assert not scene.is_free()
    scene.set_voxels(None)
    assert scene.is_free()


def _channel() -> Mesh:
    """Return a channel of three walls along x, open at the top: 0.5 m wide, its hull would fill it."""
    boxes = [((0, -0.25, 0), (0.3, 0.01, 0.3)), ((0, 0.25, 0), (0.3, 0.01, 0.3)), ((0, 0, -0.3), (0.3, 0.26, 0.01))]
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1)]
    faces += [(2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    vertices = np.vstack([corners * half + middle for middle, half in boxes])
    numbers = np.vstack([np.array(faces) + 8 * i for i in range(len(boxes))])
    return Mesh(vertices.astype(np.float32), numbers.astype(np.int32))


def _tray() -> Mesh:
    """Return an open pyramid, a single surface without thickness."""
    vertices = np.array([[-0.3, -0.3, 0.2], [0.3, -0.3, 0.2], [0.3, 0.3, 0.2], [-0.3, 0.3, 0.2], [0, 0, -0.2]])
    faces = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    return Mesh(vertices.astype(np.float32), faces.astype(np.int32))


def _bowl_obj() -> str:
    """Return a bowl of ten sides around z, from 0 to 0.3 m, without one of its triangles."""
    angles = np.linspace(0.05, np.pi / 2, 4)
    wall = [(r * np.sin(a), 0.3 - r * np.cos(a)) for r, turns in ((0.3, angles), (0.24, angles[::-1])) for a in turns]
    count, sides = len(wall), 10
    lines = [
        f"v {r * np.cos(turn)} {r * np.sin(turn)} {z}"
        for turn in np.linspace(0.0, 2.0 * np.pi, sides, endpoint=False)
        for r, z in wall
    ]
    for i in range(sides):
        here, beyond = i * count, (i + 1) % sides * count
        for k in range(count):
            after = (k + 1) % count
            a, b, c, d = (1 + number for number in (here + k, beyond + k, beyond + after, here + after))
            lines += [f"f {a} {b} {c}", f"f {a} {c} {d}"]
    return "\n".join(lines[:-1])


@pytest.mark.parametrize("mesh", [_channel(), _tray()], ids=["three walls", "open surface"])
def test_a_mesh_that_is_not_convex_is_open_where_it_is(mesh: Mesh) -> None:
    scene = scene_with()
    x, y, z = _flange(scene)
    ball = CollisionObject(name="ball", shapes=(PlacedShape(Sphere(0.02)),))
    scene = scene_with(thing("mesh", mesh, 3.0, 0.0, 0.0))
    scene.attach(AttachedObject(object=ball, link="link_7", touch_links=frozenset({"link_6", "link_5"})))
    x, y, z = _flange(scene)
    matrix = scene.allowed_collisions
    matrix.set_entries("mesh", scene.model.links, True)
    scene.allowed_collisions = matrix

    scene.move("mesh", Pose((x, y, z - 0.1)))
    assert scene.is_free()  # the ball is in the hollow
    scene.move("mesh", Pose((x, y, z + 0.2 if len(mesh.faces) == 4 else z + 0.3)))
    assert {(contact.body_1, contact.body_2) for contact in scene.check()} == {("ball", "mesh")}


def test_a_link_whose_pieces_would_fill_it_is_its_triangles(tmp_path: Path) -> None:
    """Pieces of a bowl with a missing triangle, as of a scanned or badly exported mesh, lie centimetres above it."""
    mesh = tmp_path / "bowl.obj"
    mesh.write_text(_bowl_obj())
    urdf = f"""<robot name="bowl"><link name="base"/><joint name="lift" type="prismatic">
      <parent link="base"/><child link="bowl"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
    </joint><link name="bowl"><collision><geometry><mesh filename="{mesh}"/></geometry></collision></link></robot>"""
    model = robot_model(urdf, "<robot name='bowl'/>", {}, Diagnostics())
    scene = PlanningScene(model, packages=None)
    scene.add(thing("ball", Sphere(0.02), 0.02, 0.0, 0.09))

    assert scene.is_free()  # a centimetre above the floor of the bowl, which is 6 cm thick
    scene.positions = np.array([0.02])
    assert not scene.is_free()


def test_a_copy_is_independent() -> None:
    scene = scene_with(thing("a", _CUBE, 2.0))
    copy = scene.copy()
    copy.add(thing("b", _CUBE, *_flange(copy)))
    copy.remove("a")
    copy.set_padding("link_7", 0.1)

    assert list(scene.objects) == ["a"]
    assert scene.is_free()
    assert not copy.is_free()
    assert scene.padding("link_7") == 0.0


def test_only_contacts_of_a_group_count_for_it() -> None:
    scene = scene_with(thing("thing", _CUBE, z=0.05))  # in the base, which the arm does not move

    assert not scene.is_free()
    assert scene.is_free(group="arm")


def test_frames_of_objects_and_their_subframes() -> None:
    scene = scene_with()
    scene.add(CollisionObject(name="tool", pose=Pose((1.0, 0.0, 0.0)), subframes={"tip": Pose((0.0, 0.0, 0.2))}))

    assert scene.frame_pose("tool/tip").position == pytest.approx((1.0, 0.0, 0.2))
    assert scene.frame_pose("base_link") == Pose()
    with pytest.raises(UsageError, match=r"no frame 'tol'"):
        scene.frame_pose("tol")


@pytest.mark.parametrize(
    ("object", "message"),
    [
        (thing("x", Box((-1.0, 1.0, 1.0))), "'x': a box needs lengths from 0"),
        (thing("x", Sphere(float("nan"))), "'x': a sphere needs lengths from 0"),
        (thing("x", _CUBE, float("nan")), "a pose needs finite numbers"),
        (CollisionObject(name="x", pose=Pose(quaternion=(0, 0, 0, 0))), "a pose needs a quaternion"),
        (thing("link_1", _CUBE), "a part of the robot or scene is called 'link_1'"),
        (thing("x", Mesh(np.zeros((2, 3), np.float32), np.array([[0, 1, 5]], np.int32))), "triangles of its 2 vert"),
        (thing("x", Mesh(np.full((3, 3), np.nan, np.float32), np.array([[0, 1, 2]], np.int32))), "vertex 0 is at nan"),
    ],
)
def test_what_cannot_be_is_refused(object: CollisionObject, message: str) -> None:
    scene = scene_with()

    with pytest.raises(UsageError, match=message):
        scene.add(object)
    assert dict(scene.objects) == {}
    assert scene.is_free()


def test_a_state_of_the_wrong_size_or_not_finite_is_refused() -> None:
    scene = scene_with()
    for state in (np.zeros(3), np.full(7, np.nan)):
        with pytest.raises(UsageError, match="a state has 7 finite numbers"):
            scene.is_free(state)


def test_unknown_names_are_told() -> None:
    scene = scene_with()
    with pytest.raises(UsageError, match="no object 'x'"):
        scene.remove("x")
    with pytest.raises(UsageError, match="no attached object 'x'"):
        scene.detach("x")
    with pytest.raises(UsageError, match="no link 'link_9'"):
        scene.attach(AttachedObject(object=thing("x", _CUBE), link="link_9"))
    with pytest.raises(UsageError, match="no group 'legs'"):
        scene.check(group="legs")


def test_thousands_of_objects_and_voxels_are_checked() -> None:
    scene = scene_with()
    rng = np.random.default_rng(1)
    for i, (x, y) in enumerate(rng.uniform(-3.0, 3.0, (2000, 2))):
        scene.add(thing(f"box {i}", _CUBE, float(x), float(y), -0.5))
    scene.set_voxels(Voxels(rng.uniform((-3, -3, 2), (3, 3, 3), (50_000, 3)), np.full(50_000, 0.02)))

    assert scene.is_free(ready())
    scene.add(thing("last", _CUBE, *_flange(scene)))
    assert {contact.body_2 for contact in scene.check()} == {"last"}
    assert len(seven_axis().variables) == 7
