"""Compiled worlds: degrees of freedom, repaired values, and collision pairs."""

import math
from pathlib import Path

import mujoco
import numpy as np
import pytest
from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics, Source
from trundle.robots.model import (
    Box,
    Collision,
    Cylinder,
    Geometry,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    MeshFile,
    Model,
    PhysicsSettings,
    Plane,
    Sphere,
    Surface,
    World,
)
from trundle.sim.physics import CompiledWorld, compile_world, report_wheels
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose, Wrench

AT = Source("inline.sdf", 1)
X = JointAxis(direction=(1.0, 0.0, 0.0))
LIGHT = Inertial(mass=1.0, moments=(0.01, 0.01, 0.01))


def link(name: str, *, x: float = 0.0, geometry: Geometry | None = None, surface: Surface | None = None) -> Link:
    shape = Collision(name="c", geometry=geometry or Sphere(0.1), at=AT, surface=surface or Surface())
    return Link(name=name, at=AT, model_from_link=Pose((x, 0.0, 1.0)), inertial=LIGHT, collisions=(shape,))


def hinge(parent: str, child: str, axis: JointAxis = X, *, line: int = 7) -> Joint:
    name = f"{parent}_{child}"
    return Joint(name=name, type=JointType.REVOLUTE, parent=parent, child=child, at=Source("j.sdf", line), axis=axis)


def model(
    *links: Link, joints: tuple[Joint, ...] = (), name: str = "m", static: bool = False, self_collide: bool = False
) -> Model:
    return Model(name=name, at=AT, links=links, joints=joints, static=static, self_collide=self_collide)


def floor(surface: Surface | None = None) -> Model:
    return model(link("l", geometry=Plane((0.0, 0.0, 1.0), (9.0, 9.0)), surface=surface), name="floor", static=True)


def compiled(*models: Model, report: Diagnostics | None = None) -> CompiledWorld:
    return compile_world(World(name="w", at=AT, models=models), report or Diagnostics(strict=True))


def pairs(world: CompiledWorld) -> set[frozenset[str]]:
    """Which shapes may touch, by name."""
    m = world.model
    return {frozenset((m.geom(m.pair_geom1[i]).name, m.geom(m.pair_geom2[i]).name)) for i in range(m.npair)}


def test_a_joint_with_limits_0_and_0_is_rigid_and_reported_once() -> None:
    report = Diagnostics(strict=True)
    stuck = hinge("a", "b", replace(X, lower=0.0, upper=0.0))
    world = compiled(model(link("a"), link("b"), joints=(stuck,)), report=report)
    assert world.model.nv == 6
    assert [len(axes) for axes in world.joint_axes] == [0]
    assert [str(f) for f in report.findings] == [
        "j.sdf:7: info: joint 'a_b': lower = upper = 0 leaves no freedom; rigid [joint-physics]"
    ]


def test_names_and_indices_are_in_file_order_for_any_tree() -> None:
    # The root is last in the file; MuJoCo numbers bodies from the root.
    world = compiled(
        model(link("leaf"), link("middle"), link("root"), joints=(hinge("middle", "leaf"), hinge("root", "middle")))
    )
    assert world.link_names == ("m::leaf", "m::middle", "m::root")
    assert world.joint_names == ("m::middle_leaf", "m::root_middle")
    assert [world.model.body(b).name for b in world.link_bodies] == list(world.link_names)
    parents = {name: world.model.body(world.model.body(name).parentid[0]).name for name in world.link_names}
    assert parents == {"m::leaf": "m::middle", "m::middle": "m::root", "m::root": "world"}
    assert [world.model.joint(int(world.model.dof_jntid[d])).name for d in world.axis_dof] == list(world.joint_names)


def test_the_order_of_joints_in_the_file_changes_nothing() -> None:
    parts = (link("a"), link("b", x=0.5), link("c", x=1.0))
    joints = (hinge("a", "b", JointAxis(direction=(0.0, 1.0, 0.0))), hinge("b", "c"))
    ends = []
    for order in (joints, joints[::-1]):
        sim = Simulation(World(name="w", at=AT, models=(model(*parts, joints=order),)), Diagnostics(strict=True))
        sim["m"].joint("a_b").command_effort(0.05)
        sim.run(0.5)
        ends.append(sim.snapshot().poses)
    assert ends[0].tobytes() == ends[1].tobytes()


def test_a_joint_to_the_world_holds_the_model_at_its_pose() -> None:
    arm = model(link("arm", x=0.5), joints=(hinge("world", "arm"),))
    sim = Simulation(
        World(name="w", at=AT, models=(replace(arm, world_from_model=Pose((0.0, 3.0, 0.0))),)), Diagnostics()
    )
    assert sim.engine.compiled.model.nv == 1
    sim.run(0.5)
    assert sim["m"].link("arm").pose.position == pytest.approx((0.5, 3.0, 1.0))


def test_a_static_model_has_no_freedom_and_its_joints_do_not_move() -> None:
    frozen = model(link("a"), link("b", x=0.3), joints=(hinge("a", "b"),), static=True)
    sim = Simulation(World(name="w", at=AT, models=(frozen,)), Diagnostics(strict=True))
    assert sim.engine.compiled.model.nv == 0
    sim["m"].link("b").apply_wrench(Wrench(force=(50.0, 50.0, 50.0)))
    sim.run(0.1)
    assert sim.snapshot().poses[1, :3] == pytest.approx((0.3, 0.0, 1.0))


def test_zero_thickness_is_replaced_with_a_warning_at_its_line() -> None:
    report = Diagnostics()
    flat = Collision(name="plate", geometry=Box((0.2, 0.0, 0.3)), at=Source("robot.sdf", 42))
    world = compiled(model(Link(name="a", at=AT, inertial=LIGHT, collisions=(flat,))), report=report)
    assert report.warnings == ["robot.sdf:42: warning: collision 'plate': y of zero thickness; physics uses 0.1 mm"]
    assert world.model.geom("m::a::plate").size == pytest.approx([0.1, 0.5e-4, 0.15])


@pytest.mark.parametrize(
    ("written", "use", "used"),
    [
        ((1.0, 1.0, 4.0), "uses them as written", (1.0, 1.0, 4.0)),
        ((1.0, 1.0, 34.0), "raises the two smaller by 2.09091", (3.0909091, 3.0909091, 34.0)),
    ],
)
def test_impossible_moments_are_used_unless_they_are_far_off(
    written: tuple[float, float, float], use: str, used: tuple[float, float, float]
) -> None:
    report = Diagnostics()
    odd = Link(name="a", at=Source("robot.sdf", 5), inertial=Inertial(mass=1.0, moments=written))
    world = compiled(model(odd), report=report)
    moments = ", ".join(f"{moment:g}" for moment in written)
    assert report.warnings == [
        f"robot.sdf:5: warning: link 'a': principal moments {moments} kg·m² violate the triangle inequality: no body "
        f"has them; physics {use}"
    ]
    assert sorted(world.model.body("m::a").inertia) == pytest.approx(used)
    turning = world.model.dof_M0[3:]
    assert sorted(turning) == pytest.approx(used)


def test_rounded_moments_of_flat_plates_are_accepted() -> None:
    """The sum of 3.5e-5 and 5e-6 is the largest double below 4e-5."""
    report = Diagnostics()
    plates = [(float(f"{a}e-6"), float(f"{b}e-6"), float(f"{a + b}e-6")) for a in range(1, 12) for b in range(30, 50)]
    links = [
        Link(name=f"l{number}", at=AT, inertial=Inertial(mass=1.0, moments=moments))
        for number, moments in enumerate(plates)
    ]

    world = compiled(model(*links), report=report)

    assert any(a + b < c for a, b, c in plates)
    assert report.warnings == []
    inertias = [sorted(world.model.body(f"m::l{number}").inertia) for number in range(len(plates))]
    assert inertias == [pytest.approx(moments, rel=1e-12) for moments in plates]


def test_a_possible_inertia_is_used_as_written_for_any_axes() -> None:
    tilted = Inertial(mass=2.0, link_from_com=Pose((0.1, 0.2, 0.3)), moments=(2.0, 2.0, 3.0), products=(0.5, 0.0, 0.0))
    world = compiled(model(Link(name="a", at=AT, inertial=tilted)))
    body = world.model.body("m::a")
    assert sorted(body.inertia) == pytest.approx([1.5, 2.5, 3.0])
    assert body.ipos == pytest.approx([0.1, 0.2, 0.3])
    w, x, y, z = body.iquat
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    tensor = rotation @ np.diag(body.inertia) @ rotation.T
    assert tensor == pytest.approx(np.array([[2.0, 0.5, 0.0], [0.5, 2.0, 0.0], [0.0, 0.0, 3.0]]), abs=1e-9)


@pytest.mark.parametrize("mass", [0.0, -1.0, float("nan")])
def test_an_invalid_mass_is_replaced_with_a_warning(mass: float) -> None:
    report = Diagnostics()
    compiled(model(Link(name="a", at=AT, inertial=replace(LIGHT, mass=mass))), report=report)
    assert [w for w in report.warnings if f"mass {mass:g} kg cannot move" in w]


def test_an_unreadable_mesh_leaves_its_collision_out_with_a_warning(tmp_path: Path) -> None:
    report = Diagnostics()
    lost = MeshFile(path=tmp_path / "lost.stl", uri="model://m/lost.stl")
    world = compiled(model(link("a", geometry=lost)), report=report)
    assert world.model.ngeom == 0
    assert len(report.warnings) == 1
    assert "lost.stl" in report.warnings[0]
    assert "the collision is left out" in report.warnings[0]


FLAT = "v 1 1 0\nv -1 1 0\nv -1 -1 0\nv 1 -1 0\nf 1 2 3\nf 1 3 4\n"


@pytest.mark.parametrize(
    "text",
    [FLAT, "v 1 1 0\nv -1 1 0\nv 0 -1 0\nf 1 2 3\n", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"],
    ids=["quad", "triangle", "line"],
)
def test_a_mesh_without_thickness_is_thickened_with_a_warning(tmp_path: Path, text: str) -> None:
    (tmp_path / "flat.obj").write_text(text)
    report = Diagnostics()
    world = compiled(model(link("a", geometry=MeshFile(path=tmp_path / "flat.obj", uri="flat.obj"))), report=report)
    assert world.model.nmesh == 1
    assert report.warnings == ["inline.sdf:1: warning: collision 'c': a mesh of zero thickness; physics uses 0.1 mm"]


def test_a_ball_rests_on_a_flat_mesh(tmp_path: Path) -> None:
    (tmp_path / "flat.obj").write_text(FLAT)
    table = link("top", geometry=MeshFile(path=tmp_path / "flat.obj", uri="flat.obj"))
    ball = replace(model(link("l"), name="ball"), world_from_model=Pose((0.2, 0.3, 0.1)))
    sim = Simulation(World(name="w", at=AT, models=(model(table, static=True), ball)), Diagnostics())
    sim.run(0.5)
    assert sim["ball"].pose.position == pytest.approx((0.2, 0.3, 0.1), abs=1e-3)


@pytest.mark.parametrize("radius", [0.001, 0.005])
@pytest.mark.parametrize("plate", ["flat mesh", "thin box"])
def test_a_small_ball_does_not_fall_through_a_thin_floor(tmp_path: Path, plate: str, radius: float) -> None:
    """From 2 m it falls at 6.3 mm per step, and would stop 11 mm deep."""
    (tmp_path / "flat.obj").write_text(FLAT)
    mesh = MeshFile(path=tmp_path / "flat.obj", uri="flat.obj")
    floor = link("top", geometry=mesh if plate == "flat mesh" else Box((2.0, 2.0, 0.001)))
    ball = replace(model(link("l", geometry=Sphere(radius)), name="ball"), world_from_model=Pose((0.2, 0.3, 2.0)))
    sim = Simulation(World(name="w", at=AT, models=(model(floor, static=True), ball)), Diagnostics())
    sim.run(1.5)
    assert sim["ball"].pose.position == pytest.approx((0.2, 0.3, radius), abs=1e-3)


@pytest.mark.parametrize(("radius", "is_watched"), [(0.005, True), (0.1, False)])
def test_only_bodies_that_may_tunnel_need_speculative_contacts(radius: float, is_watched: bool) -> None:
    ball = model(link("l", geometry=Sphere(radius)), name="ball")
    floors = [
        model(link("f", geometry=shape), name="floor", static=True)
        for shape in (Box((2.0, 2.0, 0.001)), Plane((0.0, 0.0, 1.0), (1.0, 1.0)))
    ]
    flags = [compiled(floor, ball).model.opt.enableflags for floor in floors]
    assert [bool(options & mujoco.mjtEnableBit.mjENBL_SPECULATIVE) for options in flags] == [is_watched, False]


def test_shapes_of_static_links_without_joints_belong_to_the_world_body() -> None:
    """A link with children keeps its own body: MuJoCo excludes contacts by body, not by shape."""
    wall = model(link("l", x=1.0), name="wall", static=True)
    post = model(link("l", x=3.0), name="post", static=True)
    gate = model(link("l", x=4.0), name="gate")
    post_joint = replace(hinge("post::l", "gate::l"), name="h")
    world = compile_world(World(name="w", at=AT, models=(wall, post, gate), joints=(post_joint,)), Diagnostics()).model
    bodies = {world.geom(i).name: world.body(world.geom_bodyid[i]).name for i in range(world.ngeom)}
    assert bodies == {"wall::l::c": "world", "post::l::c": "post::l", "gate::l::c": "gate::l"}
    assert world.geom("wall::l::c").pos == pytest.approx((1.0, 0.0, 1.0))


def test_links_of_one_model_collide_only_with_self_collide_and_never_across_a_joint() -> None:
    parts = (link("a"), link("b", x=0.5), link("c", x=1.0))
    joints = (hinge("a", "b"), hinge("b", "c"))
    assert pairs(compiled(model(*parts, joints=joints))) == set()
    assert pairs(compiled(model(*parts, joints=joints, self_collide=True))) == {frozenset(("m::a::c", "m::c::c"))}


def test_a_links_self_collide_overrides_its_models() -> None:
    a, b, c = link("a"), link("b", x=0.5), link("c", x=1.0)
    willing = model(replace(a, self_collide=True), replace(b, self_collide=True), c)
    assert pairs(compiled(willing)) == {frozenset(("m::a::c", "m::b::c"))}
    shy = model(replace(a, self_collide=False), b, c, self_collide=True)
    assert pairs(compiled(shy)) == {frozenset(("m::b::c", "m::c::c"))}


def test_two_static_models_never_collide() -> None:
    world = compiled(floor(), model(link("a"), static=True))
    assert pairs(world) == set()


def test_the_smaller_friction_of_two_surfaces_counts_in_any_order() -> None:
    rough, smooth = Surface(mu=0.9, mu2=0.8), Surface(mu=0.2, mu2=100.0)
    for first, second in ((rough, smooth), (smooth, rough)):
        world = compiled(floor(first), model(link("a", surface=second)))
        assert world.model.pair_friction[0, :2] == pytest.approx([0.2, 0.8])


def test_a_friction_of_zero_slides_and_a_negative_one_holds() -> None:
    ice = compiled(floor(Surface(mu=0.0, mu2=0.0)), model(link("a")))
    assert ice.model.pair_dim[0] == 1
    glue = compiled(floor(Surface(mu=-1.0, mu2=-1.0)), model(link("a", surface=Surface(mu=-1.0, mu2=-1.0))))
    assert glue.model.pair_dim[0] == 3
    assert glue.model.pair_friction[0, 0] >= 10.0


def test_shapes_collide_only_if_their_bitmasks_share_a_bit() -> None:
    a, b, c = (link("a", surface=Surface(collide_bitmask=bits)) for bits in (0b01, 0b10, 0b11))
    models = [model(part, name=name) for part, name in ((a, "one"), (b, "two"), (c, "both"))]
    met = pairs(compiled(*models))
    assert met == {frozenset(("one::a::c", "both::a::c")), frozenset(("two::a::c", "both::a::c"))}


def test_a_crowd_collides_by_search_by_the_same_rules() -> None:
    # 70 balls are 2415 pairs: more than are listed one by one.
    crowd = [model(link("l", x=3.0 * i), name=f"b{i}") for i in range(68)]
    low = model(link("l", x=-3.0, surface=Surface(mu=0.3, mu2=0.3)), name="low")
    high = replace(model(link("l", x=-3.0), name="high"), world_from_model=Pose((0.0, 0.0, 0.2)))
    ground = replace(floor(), world_from_model=Pose((0.0, 0.0, -0.1)))
    sim = Simulation(World(name="w", at=AT, models=(*crowd, low, high, ground)), Diagnostics(strict=True))
    engine = sim.engine.compiled.model
    assert engine.npair == 70
    sim.run(0.1)
    heights = {m.name: m.pose.position[2] for m in sim.models}
    assert heights["b0"] == pytest.approx(0.0, abs=1e-3)
    assert heights["high"] == pytest.approx(0.2, abs=2e-3)
    assert engine.geom("low::l::c").priority[0] > engine.geom("high::l::c").priority[0]


def test_soft_and_deep_shapes_keep_their_parameters_in_a_crowd() -> None:
    """A ball of 1 kg on 2000 N/m sinks by g / 2000, one with min_depth 4 mm by that, beside any other shapes.

    Gazebo's default of max_vel would have them deeper: tests/sim/physics/test_max_vel.py.
    """
    soft, deep = (
        Surface(kp=kp, kd=kd, min_depth=d, max_vel=100.0) for kp, kd, d in ((2e3, 40.0, 0.0), (2e4, 1.0, 4e-3))
    )
    crowd = [model(link("l", x=3.0 * i), name=f"b{i}") for i in range(68)]
    odd = [
        model(link("l", x=-3.0, surface=soft), name="soft"),
        replace(model(link("l", x=-3.0, surface=soft), name="above"), world_from_model=Pose((0.0, 0.0, 0.2))),
        model(link("l", x=-6.0, surface=deep), name="deep"),
    ]
    ground = replace(floor(), world_from_model=Pose((0.0, 0.0, -0.1)))
    sim = Simulation(World(name="w", at=AT, models=(*crowd, *odd, ground)), Diagnostics(strict=True))
    mass = sim["soft"].links[0].link.inertial.mass
    sim.run(3.0)

    heights = {m.name: m.links[0].pose.position[2] for m in sim.models}
    assert heights["b0"] == pytest.approx(1.0, abs=1e-3)
    assert heights["deep"] == pytest.approx(1.0 - 0.004 - mass * 9.8 / 20000, abs=1e-4)
    assert heights["soft"] == pytest.approx(1.0 - 2 * mass * 9.8 / 2000, rel=1e-4)
    assert heights["above"] - heights["soft"] == pytest.approx(0.2 - mass * 9.8 / 1000, abs=1e-4)


def test_mu2_acts_in_a_crowd() -> None:
    """Shapes without pairs, for there are 50 standing and 50 moving ones: a floor's first direction is y."""
    slippery = Surface(mu=0.8, mu2=0.1)
    boxes = [
        replace(
            model(link("l", x=9.0 * i, surface=slippery, geometry=Box((0.2, 0.2, 0.2))), name=f"b{i}"),
            world_from_model=Pose((0.0, 0.0, -0.9)),
        )
        for i in range(50)
    ]
    tiles = [
        replace(
            model(link("l", x=9.0 * i, surface=slippery, geometry=Box((8.0, 8.0, 0.2))), name=f"t{i}", static=True),
            world_from_model=Pose((0.0, 0.0, -1.1)),
        )
        for i in range(50)
    ]
    world = World(name="w", at=AT, models=(*boxes, *tiles))
    for gravity, moved in (((3.0, 0.0, -9.8), (3.0 - 0.98) / 2), ((0.0, 3.0, -9.8), 0.0)):
        sim = Simulation(replace(world, physics=replace(world.physics, gravity=gravity)), Diagnostics(strict=True))
        before = sim["b0"].links[0].pose.position
        sim.run(1.0)
        assert math.dist(sim["b0"].links[0].pose.position, before) == pytest.approx(moved, abs=0.02)


def test_too_many_soft_shapes_are_simulated_as_hard_with_a_warning() -> None:
    soft = Surface(kp=200.0)
    report = Diagnostics()
    compiled(*(model(link("l", x=3.0 * i, surface=soft), name=f"b{i}") for i in range(150)), report=report)

    (warning,) = report.warnings
    assert warning == (
        "inline.sdf:1: warning: 150 of 150 shapes are soft (kp, min_depth), the first 'b0::l::c'; "
        "they are simulated as hard"
    )


def test_step_and_gravity_come_from_the_world() -> None:
    settings = PhysicsSettings(max_step_size_s=0.002, gravity=(1.0, 2.0, -3.0))
    world = compile_world(World(name="w", at=AT, physics=settings), Diagnostics(strict=True))
    assert world.model.opt.timestep == 0.002
    assert world.model.opt.gravity.tolist() == [1.0, 2.0, -3.0]


def test_a_link_without_gravity_floats() -> None:
    sim = Simulation(
        World(name="w", at=AT, models=(model(replace(link("a"), gravity=False)),)), Diagnostics(strict=True)
    )
    sim.run(1.0)
    assert sim["m"].link("a").pose.position == pytest.approx((0.0, 0.0, 1.0), abs=1e-9)


def test_a_block_fixed_to_the_world_may_stand_in_the_floor() -> None:
    post = Joint(name="post", type=JointType.FIXED, parent="world", child="a", at=AT)
    sunk = model(link("a"), joints=(post,))
    sim = Simulation(
        World(name="w", at=AT, models=(replace(sunk, world_from_model=Pose((0.0, 0.0, -1.0))), floor())), Diagnostics()
    )
    sim.run(0.1)
    assert sim["m"].link("a").pose.position == pytest.approx((0.0, 0.0, 0.0))


@pytest.mark.parametrize(("turns_about", "is_wheel"), [((0.0, 0.0, 1.0), True), ((1.0, 0.0, 0.0), False)])
def test_reported_wheels_are_those_with_a_tread(turns_about: tuple[float, float, float], is_wheel: bool) -> None:
    disc = link("disc", geometry=Cylinder(0.1, 0.05))
    car = model(link("base"), disc, joints=(hinge("base", "disc", JointAxis(direction=turns_about)),))
    world, report = World(name="w", at=AT, models=(car,)), Diagnostics()

    report_wheels(world, report)

    compiled = compile_world(world, Diagnostics()).model
    names = [compiled.geom(i).name for i in range(compiled.ngeom)]
    assert [str(finding.at) for finding in report.findings] == ["inline.sdf:1"] * is_wheel
    assert ("m::disc::c::tread" in names) is is_wheel
    if is_wheel:
        assert compiled.geom("m::disc::c::tread").size.tolist() == [0.1, 0.1, 0.025]
        assert compiled.geom("m::disc::c").size[:2].tolist() == pytest.approx([0.1 - 1e-4, 0.025])


def test_a_joint_with_equal_limits_is_fixed_at_their_angle() -> None:
    """lower = upper = a quarter turn: the child and its descendants are turned."""
    quarter = np.pi / 2
    rigid = hinge("a", "b", replace(X, lower=quarter, upper=quarter))
    arm = model(link("a"), link("b", x=1.0), link("c", x=2.0), joints=(rigid, hinge("b", "c")))

    poses = Simulation(World(name="w", at=AT, models=(arm,)), Diagnostics()).snapshot().poses

    assert Pose(quaternion=tuple(poses[1, 3:])).rpy == pytest.approx((quarter, 0.0, 0.0))
    assert Pose(quaternion=tuple(poses[2, 3:])).rpy == pytest.approx((quarter, 0.0, 0.0))


def test_thousands_of_static_bodies_leave_memory_for_contacts() -> None:
    boxes = [model(link("l", x=2.0 * i, geometry=Box((1.0, 1.0, 1.0))), name=f"b{i}", static=True) for i in range(3000)]
    report = Diagnostics()
    sim = Simulation(World(name="w", at=AT, models=(*boxes, model(link("l", x=0.2)))), report)
    sim.step(3)
    assert sim.engine.compiled.model.narena < 2**30
    assert report.warnings == []


def test_thousands_of_moving_models_report_the_memory_they_may_use() -> None:
    balls = [model(link("l", x=1.0 * i), name=f"b{i}") for i in range(2000)]
    report = Diagnostics()
    compiled(*balls, report=report)
    assert [f.what for f in report.findings] == ["2,001 bodies: the engine may use up to 1.1 GB of memory"]
