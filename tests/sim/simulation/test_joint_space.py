"""All joints of a model at once, against closed forms."""

from pathlib import Path

import numpy as np
import pytest

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.robots.description import load_text
from trundle.robots.packages import Packages
from trundle.sim.simulation import ModelHandle, Simulation
from trundle.spatial import Pose, Twist, rotate

L1, C1, M1, I1 = 0.8, 0.3, 2.0, 0.05
L2, C2, M2, I2 = 0.5, 0.2, 1.5, 0.03
"""Length, centre of mass [m], mass [kg] and moment of inertia about it [kg·m²] of the two links."""
G = 9.8


def _link(name: str, x: float, *, com: float, mass: float, moment: float) -> str:
    return (
        f"<link name='{name}'><pose>{x} 0 0 0 0 0</pose><inertial><pose>{com} 0 0 0 0 0</pose><mass>{mass}</mass>"
        f"<inertia><ixx>0.01</ixx><iyy>{moment}</iyy><izz>0.04</izz></inertia></inertial></link>"
    )


DOUBLE_PENDULUM = f"""<sdf version="1.6"><world name="w">
<model name="ball"><pose>5 0 0 0 0 0</pose><link name="b"/></model>
<model name="arm">{_link("upper", 0.0, com=C1, mass=M1, moment=I1)}{_link("lower", L1, com=C2, mass=M2, moment=I2)}
<link name="lamp"><pose>{L1} 0 0 0 0 0</pose><inertial><mass>1e-9</mass>
<inertia><ixx>1e-12</ixx><iyy>1e-12</iyy><izz>1e-12</izz></inertia></inertial></link>
<joint name="shoulder" type="revolute"><parent>world</parent><child>upper</child><axis><xyz>0 -1 0</xyz></axis></joint>
<joint name="glued" type="fixed"><parent>upper</parent><child>lamp</child></joint>
<joint name="elbow" type="revolute"><parent>upper</parent><child>lower</child><axis><xyz>0 -1 0</xyz></axis></joint>
</model></world></sdf>"""
"""In the x-z plane; angles count upwards from +x."""

FLOATING = """<sdf version="1.6"><world name="w"><model name="drone"><pose>1 2 3 0.3 -0.5 1.1</pose>
<link name="body"><inertial><pose>0.1 0.02 -0.05 0 0 0</pose><mass>3</mass>
<inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.25</izz></inertia></inertial></link>
<link name="gimbal"><pose>0 0 -0.2 0 0 0</pose><inertial><pose>0 0 -0.1 0 0 0</pose><mass>0.5</mass>
<inertia><ixx>0.01</ixx><iyy>0.02</iyy><izz>0.02</izz></inertia></inertial></link>
<link name="flap"><pose>0.4 0 0 0 0 0.7</pose><inertial><pose>0.2 0 0 0 0 0</pose><mass>0.2</mass>
<inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial></link>
<joint name="ball" type="ball"><parent>body</parent><child>gimbal</child></joint>
<joint name="hinge" type="revolute"><parent>body</parent><child>flap</child><axis><xyz>0 1 0</xyz></axis></joint>
</model></world></sdf>"""


def make(text: str, model: str) -> tuple[Simulation, ModelHandle]:
    report = Diagnostics()
    world = load_text(
        text.encode(), name="w.sdf", folder=Path(), packages=Packages({}, start=Path()), report=report
    ).world
    simulation = Simulation(world, report)
    return simulation, simulation[model]


def double_pendulum(q: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """M and gravity of two links in a vertical plane (Spong, Hutchinson, Vidyasagar, Robot Modeling and Control)."""
    q1, q2 = q
    coupling = M2 * L1 * C2 * np.cos(q2)
    m12 = I2 + M2 * C2**2 + coupling
    mass = np.array([[I1 + M1 * C1**2 + M2 * L1**2 + coupling + m12, m12], [m12, I2 + M2 * C2**2]])
    lower = M2 * C2 * G * np.cos(q1 + q2)
    return mass, np.array([(M1 * C1 + M2 * L1) * G * np.cos(q1) + lower, lower])


def coriolis(q: tuple[float, float], v: tuple[float, float]) -> np.ndarray:
    h = M2 * L1 * C2 * np.sin(q[1])
    return np.array([-h * (2 * v[0] * v[1] + v[1] ** 2), h * v[0] ** 2])


def test_positions_and_velocities_are_read_and_written_in_the_order_of_the_names() -> None:
    _, arm = make(DOUBLE_PENDULUM, "arm")

    assert arm.joint_names == ("shoulder", "elbow")
    arm.joint_positions = (0.3, -0.7)
    arm.joint_velocities = np.array([1.0, 2.0])
    assert arm.joint_positions.tolist() == [0.3, -0.7]
    assert arm.joint_velocities.tolist() == [1.0, 2.0]
    assert (arm.joint("elbow").position, arm.joint("elbow").velocity) == (-0.7, 2.0)
    with pytest.raises(ValueError, match="read-only"):  # a copy: nothing would move
        arm.joint_positions[0] = 9.0
    assert arm.joint("shoulder").position == 0.3


def test_a_ball_joint_is_set_by_a_rotation_vector() -> None:
    _, drone = make(FLOATING, "drone")

    assert drone.joint_names == ("ball", "ball", "ball", "hinge")
    drone.joint_positions = (0.3, -0.2, 0.1, 0.5)
    drone.joint_velocities = (0.1, 0.2, 0.3, 0.4)
    assert drone.joint_positions == pytest.approx([0.3, -0.2, 0.1, 0.5])
    assert drone.joint("ball").positions == pytest.approx((0.3, -0.2, 0.1))
    assert drone.joint_velocities.tolist() == [0.1, 0.2, 0.3, 0.4]


@pytest.mark.parametrize("values", [[0.1], [0.1, 0.2, 0.3], [[0.1, 0.2]]])
def test_an_array_of_wrong_shape_is_refused_with_the_joint_names(values: list[float]) -> None:
    _, arm = make(DOUBLE_PENDULUM, "arm")

    with pytest.raises(UsageError) as caught:
        arm.joint_positions = values
    shape = np.shape(values)
    assert str(caught.value) == (
        f"model 'arm': joint_positions has shape {shape}, not (2,): joints: 'shoulder', 'elbow'"
    )


def test_velocities_of_a_floating_model_begin_with_its_base() -> None:
    _, drone = make(FLOATING, "drone")

    with pytest.raises(UsageError, match=r"v has shape \(4,\), not \(10,\): .*, after 6 for each of 1 free links"):
        drone.inverse_dynamics(np.zeros(4), np.zeros(4), np.zeros(10))
    with pytest.raises(UsageError, match="a has numbers that are not finite"):
        drone.inverse_dynamics(np.zeros(4), np.zeros(10), np.full(10, np.nan))


@pytest.mark.parametrize("q", [(0.0, 0.0), (0.4, -1.1), (2.0, 2.5)])
def test_the_jacobian_of_a_planar_arm_is_analytic(q: tuple[float, float]) -> None:
    _, arm = make(DOUBLE_PENDULUM, "arm")
    arm.joint_positions = q
    (s1, c1), (s12, c12) = (np.sin(q[0]), np.cos(q[0])), (np.sin(sum(q)), np.cos(sum(q)))

    jacobian = arm.jacobian("lower", (L2, 0.0, 0.0))

    truth = np.zeros((6, 2))
    truth[0] = [-L1 * s1 - L2 * s12, -L2 * s12]
    truth[2] = [L1 * c1 + L2 * c12, L2 * c12]
    truth[4] = [-1.0, -1.0]
    assert jacobian == pytest.approx(truth, abs=1e-12)
    assert arm.jacobian(arm.link("upper")).tolist() == [[0, 0], [0, 0], [0, 0], [0, 0], [-1, 0], [0, 0]]


@pytest.mark.parametrize("q", [(0.0, 0.0), (0.4, -1.1), (2.0, 2.5)])
def test_the_equations_of_motion_of_a_double_pendulum_are_analytic(q: tuple[float, float]) -> None:
    simulation, arm = make(DOUBLE_PENDULUM, "arm")
    v, a = (1.5, -0.8), (-2.0, 3.0)
    arm.joint_positions, arm.joint_velocities = q, v
    before = simulation.snapshot().poses
    mass, gravity = double_pendulum(q)
    bias = coriolis(q, v) + gravity

    assert arm.mass_matrix() == pytest.approx(mass, rel=1e-6)
    assert arm.bias_forces() == pytest.approx(bias, rel=1e-6, abs=1e-6)
    assert arm.inverse_dynamics(q, v, a) == pytest.approx(mass @ a + bias, rel=1e-6)
    arm.joint_positions = arm.joint_velocities = (0.0, 0.0)
    assert arm.inverse_dynamics(q, v, a) == pytest.approx(mass @ a + bias, rel=1e-6)
    assert arm.joint_positions.tolist() == [0.0, 0.0]
    arm.joint_positions = q
    assert (simulation.snapshot().poses == before).all()


def test_a_floating_body_has_six_velocities_in_world_axes() -> None:
    """Newton and Euler about the link's origin, which is not the centre of mass."""
    text = FLOATING[: FLOATING.index('<link name="gimbal">')] + "</model></world></sdf>"
    _, drone = make(text, "drone")
    rotation = np.array([rotate(drone.pose.quaternion, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]).T
    com = rotation @ [0.1, 0.02, -0.05]
    inertia = rotation @ np.diag([0.1, 0.2, 0.25]) @ rotation.T
    cross = np.array([[0, -com[2], com[1]], [com[2], 0, -com[0]], [-com[1], com[0], 0]])
    mass = np.block([[3 * np.eye(3), -3 * cross], [3 * cross, inertia - 3 * cross @ cross]])
    spin = np.array([0.4, -0.3, 0.9])

    drone.set_twist(Twist((0.1, 0.2, 0.3), tuple(spin.tolist())))

    force = 3 * (np.cross(spin, np.cross(spin, com)) + np.array([0, 0, G]))
    torque = np.cross(com, force) + np.cross(spin, inertia @ spin)
    assert drone.mass_matrix() == pytest.approx(mass, abs=1e-9)
    assert drone.bias_forces() == pytest.approx(np.concatenate([force, torque]), abs=1e-9)


def test_the_jacobian_maps_velocities_to_twists() -> None:
    """Also past a ball joint, whose velocities are along its child's axes."""
    _, drone = make(FLOATING, "drone")
    velocities = np.array([0.1, -0.2, 0.3, 0.4, 0.5, -0.6, 0.7, -0.8, 0.9, 1.0])
    drone.joint_positions = (0.3, -0.2, 0.1, 0.5)
    drone.link("body").set_twist(Twist((0.1, -0.2, 0.3), (0.4, 0.5, -0.6)))
    drone.joint_velocities = velocities[6:]

    for name in ("body", "gimbal", "flap"):
        assert drone.jacobian(name) @ velocities == pytest.approx(drone.link(name).twist.as_list(), abs=1e-12)


def test_efforts_of_inverse_dynamics_cause_the_accelerations() -> None:
    simulation, arm = make(DOUBLE_PENDULUM, "arm")
    arm.joint_positions, arm.joint_velocities = (0.4, -1.1), (1.5, -0.8)
    accelerations = np.array([-2.0, 3.0])
    efforts = arm.inverse_dynamics(arm.joint_positions, arm.joint_velocities, accelerations)
    before = arm.joint_velocities

    for name, effort in zip(arm.joint_names, efforts, strict=True):
        arm.joint(name).command_effort(effort)
    simulation.step()

    assert (arm.joint_velocities - before) / 1e-3 == pytest.approx(accelerations, rel=0.02)


def test_an_unknown_link_is_refused_with_the_link_names() -> None:
    _, arm = make(DOUBLE_PENDULUM, "arm")

    with pytest.raises(UsageError, match="model 'arm' has no link 'hand'; there are: 'upper', 'lower', 'lamp'"):
        arm.jacobian("hand")


def test_a_model_without_joints_has_empty_arrays() -> None:
    simulation, ball = make(DOUBLE_PENDULUM, "ball")

    assert (ball.joint_names, ball.joint_positions.shape) == ((), (0,))
    assert ball.mass_matrix() == pytest.approx(np.eye(6))
    simulation.spawn(ball.model, allow_renaming=True).set_pose(Pose((0.0, 3.0, 0.0)))
    assert ball.jacobian("b").tolist() == np.eye(6).tolist()


def test_handles_have_informative_reprs() -> None:
    simulation, arm = make(DOUBLE_PENDULUM, "arm")
    arm.joint_positions, arm.joint_velocities = (0.3, -0.7), (1.0, 2.0)

    assert repr(simulation) == "<Simulation 'w' at 0.000 s; models: 'ball', 'arm'>"
    assert repr(arm) == (
        "<ModelHandle 'arm' at (0.000, 0.000, 0.000) m; links: 'upper', 'lower', 'lamp'; "
        "joints: 'shoulder', 'glued', 'elbow'>"
    )
    assert repr(arm.joint("elbow")) == "<JointHandle 'elbow': revolute, positions (-0.7,), velocities (2.0,)>"
    assert repr(arm.joint("glued")) == "<JointHandle 'glued': fixed, rigid>"
    assert repr(simulation["ball"].link("b")) == "<LinkHandle 'b' at (5.000, 0.000, 0.000) m>"
    ball = simulation["ball"]
    simulation.delete("ball")
    assert (repr(ball), repr(ball.links[0])) == ("<ModelHandle 'ball', deleted>", "<LinkHandle 'b' of a deleted model>")
