"""Worlds and models built in code: masses, written SDF and motion."""

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from msgspec.structs import replace

import trundle
from trundle.base.diagnostics import Diagnostics, Source, UsageError
from trundle.robots.description import Link, load_text
from trundle.robots.model import CameraOptics, ImuNoise, Inertial, JointAxis, JointType, RangeScan, ScanAxis, Surface
from trundle.robots.packages import Packages
from trundle.spatial import Pose

NOWHERE = Source("nowhere")


def read_back(built: trundle.Model | trundle.World):
    report = Diagnostics()
    packages = Packages({}, start=Path())
    loaded = load_text(built.to_sdf().encode(), name="x.sdf", folder=Path(), packages=packages, report=report)
    assert report.findings == []
    return loaded.world


def inertial_of(link: Link) -> Inertial:
    return link.description().inertial


def arm() -> trundle.Model:
    """A rod of 0.5 m and 2 kg that hangs 1 m up from a hinge at its upper end."""
    model = trundle.Model("arm")
    rod = model.add_cylinder("rod", 0.05, 0.5, mass=2.0, pose=Pose((0.0, 0.0, 0.75)))
    hinge = model.add_joint("hinge", "revolute", "world", rod, pose=Pose((0.0, 0.0, 0.25)), axis=(0.0, 1.0, 0.0))
    hinge.add_force_torque_sensor("load", update_rate=100.0)
    rod.add_sensor("imu", "imu", pose=Pose((0.0, 0.0, -0.25)))
    return model


def test_a_built_world_round_trips() -> None:
    world = trundle.World("shop", gravity=(0.0, 0.0, -1.6), max_step_size=0.002)
    world.add_ground_plane()
    world.add_light()
    world.add_box(
        "crate", (0.4, 0.2, 0.1), pose=Pose((1.0, 2.0, 0.3)), color=(1.0, 0.0, 0.0, 0.5), surface=Surface(mu=0.3)
    )
    world.add_model(arm(), pose=Pose.from_rpy(3.0, 0.0, 0.0, 0.0, 0.0, 0.7))

    built, read = world.description(), read_back(world)

    for wrote, read_model in zip(built.models, read.models, strict=True):
        assert [link.name for link in read_model.links] == [link.name for link in wrote.links]
        for one, other in zip(wrote.links, read_model.links, strict=True):
            assert other.inertial.moments == pytest.approx(one.inertial.moments)
            assert replace(other.visuals[0], at=NOWHERE) == replace(one.visuals[0], at=NOWHERE)
            assert replace(other.collisions[0], at=NOWHERE) == replace(one.collisions[0], at=NOWHERE)
            assert [replace(s, at=NOWHERE) for s in other.sensors] == [replace(s, at=NOWHERE) for s in one.sensors]
        for one, other in zip(wrote.joints, read_model.joints, strict=True):
            assert (other.name, other.type, other.parent, other.child) == (one.name, one.type, one.parent, one.child)
            assert other.axis is not None
            assert one.axis is not None
            assert other.axis.direction == pytest.approx(one.axis.direction)
            assert [s.name for s in other.sensors] == [s.name for s in one.sensors]
    assert read.physics == built.physics
    assert replace(read.lights[0], at=NOWHERE) == replace(built.lights[0], at=NOWHERE)


def test_the_mass_of_a_shape_is_density_times_volume() -> None:
    """Box m/12 (b² + c²), ball 2/5 m r², cylinder m r²/2 about its axis; water weighs 1000 kg/m³."""
    model = trundle.Model("m")
    box_inertial = inertial_of(model.add_box("box", (0.4, 0.2, 0.1)))
    ball = inertial_of(model.add_sphere("ball", 0.3, mass=5.0))
    rod = inertial_of(model.add_cylinder("rod", 0.1, 2.0, density=7800.0))

    assert box_inertial.mass == pytest.approx(8.0)
    assert box_inertial.moments == pytest.approx((8 / 12 * 0.05, 8 / 12 * 0.17, 8 / 12 * 0.2))
    assert ball.moments == pytest.approx([0.4 * 5 * 0.09] * 3)
    assert rod.mass == pytest.approx(7800 * math.pi * 0.02)
    assert rod.moments[2] == pytest.approx(rod.mass * 0.005)


def test_a_link_has_the_mass_of_all_its_shapes() -> None:
    """A dumb-bell: two balls 1 m apart, each 2/5 m r² and m d² about the middle; a visual alone has mass, too."""
    link = trundle.Model("m").add_link("bell")
    link.add_sphere("left", 0.1, mass=3.0, pose=Pose((1.0, 0.5, 0.0)))
    link.add_sphere("right", 0.1, mass=3.0, pose=Pose((1.0, -0.5, 0.0)), collision=False)

    shape_inertia = 0.4 * 3 * 0.01
    inertial = inertial_of(link)
    assert (inertial.mass, inertial.link_from_com.position) == (6.0, (1.0, 0.0, 0.0))
    assert inertial.moments == pytest.approx((2 * shape_inertia + 1.5, 2 * shape_inertia, 2 * shape_inertia + 1.5))
    assert len(link.description().collisions) == 1
    link.set_inertial(1.0, (2.0, 3.0, 4.0), center=(0.1, 0.0, 0.0))
    assert inertial_of(link) == Inertial(mass=1.0, link_from_com=Pose((0.1, 0.0, 0.0)), moments=(2.0, 3.0, 4.0))


def test_an_empty_link_has_the_default_mass_of_sdf() -> None:
    assert inertial_of(trundle.Model("m").add_link("l")) == Inertial()


def _brick(folder: Path) -> Path:
    """A brick of 1 x 2 x 3 with a corner at the origin, as an .obj."""
    corners = [(x, y, z) for x in (0, 1) for y in (0, 2) for z in (0, 3)]
    faces = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {' '.join(map(str, face))}" for face in faces]
    file = folder / "brick.obj"
    file.write_text("\n".join(lines))
    return file


def test_the_mass_of_a_mesh_is_that_of_its_volume(tmp_path: Path) -> None:
    link = trundle.Model("m").add_mesh("brick", _brick(tmp_path), scale=(0.1, 0.1, 0.1), density=500.0)

    inertial = inertial_of(link)
    assert inertial.mass == pytest.approx(3.0)
    assert inertial.link_from_com.position == pytest.approx((0.05, 0.1, 0.15))
    assert inertial.moments == pytest.approx((3 / 12 * 0.13, 3 / 12 * 0.10, 3 / 12 * 0.05))
    assert inertial.products == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def test_a_mesh_that_encloses_nothing_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "flat.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")

    with pytest.raises(UsageError, match="encloses no volume"):
        trundle.Model("m").add_mesh("sheet", file)


def test_a_built_pendulum_accelerates_as_its_equation_of_motion_says() -> None:
    """Gravity's moment m g l sin q on its hinge, and M = m (l² + (3 r² + h²)/12)."""
    world = trundle.World()
    world.add_model(arm())
    sim = trundle.load(world)
    pendulum = sim["arm"]
    pendulum.joint_positions = [0.4]

    mass = 2.0 * (0.25**2 + (3 * 0.05**2 + 0.5**2) / 12)
    assert pendulum.mass_matrix()[0, 0] == pytest.approx(mass)
    assert pendulum.bias_forces()[0] == pytest.approx(2.0 * 9.8 * 0.25 * math.sin(0.4))
    assert sim.sensor_names == ("arm::rod::imu", "arm::hinge::load")


def test_a_model_alone_stands_on_the_ground(tmp_path: Path) -> None:
    model = trundle.Model("crate", pose=Pose((0.0, 0.0, 0.05)))
    model.add_box("body", (0.1, 0.1, 0.1))
    model.save(tmp_path / "crate.sdf")

    for sim in (trundle.load(model), trundle.load(tmp_path / "crate.sdf")):
        sim.run(1.0)
        assert sim["crate"].pose.position[2] == pytest.approx(0.05, abs=1e-4)
        assert [item.name for item in sim.models] == ["crate", "ground_plane"]


def test_axes_turn_with_their_joint() -> None:
    """SDF's axis is in the joint's frame, the description's in the model's."""
    model = trundle.Model("m")
    model.add_link("a")
    model.add_link("b", pose=Pose.from_rpy(0.0, 0.0, 0.0, 0.0, 0.0, math.pi / 2))
    model.add_joint("j", "prismatic", "a", "b", axis=JointAxis(direction=(2.0, 0.0, 0.0), lower=-1.0, upper=1.0))

    (joint,) = model.description().joints
    assert joint.axis is not None
    assert joint.type is JointType.PRISMATIC
    assert joint.axis.direction == pytest.approx((0.0, 1.0, 0.0))
    assert (joint.axis.lower, joint.axis.upper) == (-1.0, 1.0)


def test_sensors_have_the_settings_of_their_type() -> None:
    link = trundle.Model("m").add_link("l")
    link.add_sensor("eye", "camera", CameraOptics(width_px=64, height_px=48), update_rate=10.0)
    link.add_sensor("lidar", "ray", RangeScan(horizontal=ScanAxis(samples=5), min_m=0.1, max_m=9.0))
    link.add_sensor("bumper", "contact")

    eye, lidar, bumper = link.description().sensors
    assert (eye.cameras[0].width_px, eye.update_rate_hz) == (64, 10.0)
    assert lidar.scan is not None
    assert (lidar.scan.max_m, bumper.contact_collisions) == (9.0, ())


def test_plugins_are_written_with_their_parameters() -> None:
    model = arm()
    model.add_plugin("drive", "libdrive.so", topic="/a<b", rate=20.0)

    (tag,) = read_back(model).models[0].plugins
    assert (tag.name, tag.filename) == ("drive", "libdrive.so")
    assert (tag.node.string("topic"), tag.node.number("rate", default=0.0)) == ("/a<b", 20.0)


class Scene(NamedTuple):
    world: trundle.World
    model: trundle.Model
    link: Link


def _full() -> Scene:
    world = trundle.World("w")
    model = world.add_model("m")
    link = model.add_box("a", (1.0, 1.0, 1.0))
    link.add_sensor("s", "imu")
    model.add_link("b")
    world.add_light()
    return Scene(world, model, link)


@pytest.mark.parametrize(
    ("act", "says"),
    [
        (lambda s: s.world.add_model("m"), "world 'w' has 'm' already; there are: 'm'"),
        (lambda s: s.world.add_light(), "world 'w' has 'sun' already; there are: 'sun'"),
        (
            lambda s: s.world.add_box("x::y", (1, 1, 1)),
            "a model: 'x::y' is no name: it must be text, not empty, and without '::'",
        ),
        (lambda s: s.world.add_box("x", (1, 0, 1)), "size of box 'x' must be above zero, got 1, 0, 1"),
        (lambda s: s.world.add_sphere("x", 1, mass=-1.0), "mass or density of 'x' must be above zero, got -1"),
        (
            lambda s: s.world.add_sphere("x", 1, colour=(1, 0, 0, 1)),
            "shape 'x': no option 'colour' (did you mean 'color'?); there are: 'pose', 'mass', 'density', 'color', ",
        ),
        (lambda s: s.model.add_link("a"), "model 'm' has 'a' already; there are: 'a', 'b'"),
        (lambda s: s.link.add_sphere("a", 1.0), "link 'a' has 'a' already; there are: 'a'"),
        (lambda s: s.link.add_sensor("s", "imu"), "link 'a' has 's' already; there are: 's'"),
        (lambda s: s.link.add_sensor("t", "nose"), "sensor 't': no type 'nose'; there are: 'air_pressure', "),
        (
            lambda s: s.link.add_sensor("t", "camera", ImuNoise()),
            "sensor 't': type 'camera' takes settings of CameraOptics, not ImuNoise",
        ),
        (
            lambda s: s.link.add_sensor("t", "contact", ImuNoise()),
            "sensor 't': type 'contact' takes no settings, not ImuNoise",
        ),
        (
            lambda s: s.link.add_sensor("t", "force_torque"),
            "sensor 't': force_torque sensors sit on joints; add it to one",
        ),
        (
            lambda s: s.model.add_joint("j", "revolute", "a", "c"),
            "model 'm', joint 'j': no link 'c'; there are: 'a', 'b'",
        ),
        (
            lambda s: s.model.add_joint("j", "hinge", s.link, "b"),
            "joint 'j': no type 'hinge'; there are: 'revolute', 'prismatic', 'fixed', 'ball', 'universal', ",
        ),
        (lambda s: s.model.add_joint("j", "universal", s.link, "b"), "joint 'j': type 'universal' needs axis2 as well"),
        (
            lambda s: s.model.add_joint("j", "revolute", s.link, "b", axis=(0, 0, 0)),
            "joint 'j': (0.0, 0.0, 0.0) is no direction",
        ),
        (lambda _: trundle.World(max_step_size=0.0), "max_step_size must be above zero, got 0"),
        (lambda _: trundle.World(gravity=9.8), "gravity [m/s²] must be 3 finite numbers (x, y, z), got 9.8"),
        (lambda s: s.world.add_box("x", 1), "size of box 'x' [m] must be 3 finite numbers (x, y, z), got 1"),
        (lambda s: s.world.add_sphere("x", "1"), "radius of sphere 'x' must be a finite number, got '1'"),
        (lambda s: s.world.add_sphere("x", 1, pose=(0, 1)), "pose of 'x' must be a Pose, (x, y, z) [m], (x, y, z, "),
        (
            lambda s: s.world.add_sphere("x", 1, color=(255, 0, 0)),
            "color of 'x' must be (red, green, blue) or (red, green, blue, opacity), each 0 to 1, got (255, 0, 0)",
        ),
    ],
)
def test_unknown_names_are_refused_with_the_known_ones(act, says: str) -> None:
    with pytest.raises(UsageError) as caught:
        act(_full())
    assert str(caught.value).startswith(says)


def test_each_object_has_a_readable_repr() -> None:
    world, model, link = _full()

    assert repr(world) == "<World 'w'; models: 'm'; lights: 'sun'>"
    assert repr(model) == "<Model 'm'; links: 'a', 'b'; joints: none>"
    assert repr(link) == "<Link 'a'; shapes: 'a'; sensors: 's'>"


def test_built_objects_have_the_defaults_of_sdf() -> None:
    """The same defaults as for an empty element."""
    text = """<sdf version="1.11"><world name="default"><model name="m"><link name="l">
    <sensor name="eye" type="camera"><camera/></sensor><sensor name="imu" type="imu"/></link></model></world></sdf>"""
    packages = Packages({}, start=Path())
    written = load_text(text.encode(), name="x", folder=Path(), packages=packages, report=Diagnostics()).world
    world = trundle.World()
    link = world.add_model("m").add_link("l")
    link.add_sensor("eye", "camera").add_sensor("imu", "imu")

    built = world.description()
    assert (built.name, built.physics) == (written.name, written.physics)
    written_link, built_link = (item.models[0].links[0] for item in (written, built))
    assert built_link.inertial == written_link.inertial
    assert [replace(s, at=NOWHERE) for s in built_link.sensors] == [
        replace(s, at=NOWHERE) for s in written_link.sensors
    ]
    assert np.array_equal(built.models[0].world_from_model.position, (0, 0, 0))
