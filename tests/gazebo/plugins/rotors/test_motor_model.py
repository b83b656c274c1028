"""A quadrotor of RotorS' plugins against its motors' constants."""

from pathlib import Path

import pytest
from tests.gazebo.plugins.plugin_world import FakeNode, load
from tests.gazebo.plugins.rotors.quadrotor import HOVER, LIFT, MOMENT, PLUGIN, ROTOR_MASS, G, quadrotor

from trundle.sim.simulation import Simulation


def fly(folder: Path, more: str = "", motor: str = "", gravity: float = G) -> tuple[Simulation, FakeNode]:
    """Return a world with the quadrotor, and its fake node."""
    node = FakeNode()
    return load(folder, quadrotor(more, motor), gravity=f"0 0 {-gravity}", node=node), node


def command(node: FakeNode, *speeds: float) -> None:
    node.receive("/quad/gazebo/command/motor_speed", angular_velocities=list(speeds))


def test_a_quadrotor_hovers_at_its_hover_speed(tmp_path: Path) -> None:
    sim, node = fly(tmp_path)
    assert sim.report.warnings == []
    command(node, *[HOVER] * 4)
    sim.run(1.0)
    link = sim["m"].link("base_link")
    falling = link.twist.linear[2]
    assert falling < -0.05, "it falls while the rotors spin up"
    sim.run(2.0)
    assert link.twist.linear[2] == pytest.approx(falling, abs=1e-3)
    assert link.pose.rpy == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)
    assert node.published["/quad/motor_speed/0"][-1].data == pytest.approx(HOVER / 10, rel=1e-6)


def test_thrust_follows_the_motor_constant(tmp_path: Path) -> None:
    sim, node = fly(tmp_path)
    command(node, *[1.1 * HOVER] * 4)
    sim.run(1.0)
    link = sim["m"].link("base_link")
    before = link.twist.linear[2]
    sim.run(1.0)
    assert link.twist.linear[2] - before == pytest.approx(G * (1.1**2 - 1), rel=1e-3)


def test_clockwise_rotors_turn_the_body_counter_clockwise(tmp_path: Path) -> None:
    """By thrust times <momentConstant> over the inertia of body and rotors."""
    sim, node = fly(tmp_path, motor="<rotorDragCoefficient>0</rotorDragCoefficient>", gravity=0.0)
    command(node, 0.0, 400.0, 0.0, 400.0)
    sim.run(0.5)
    link = sim["m"].link("base_link")
    before = link.twist.angular[2]
    sim.run(0.5)
    inertia = 0.012 + 4 * ROTOR_MASS * 0.2**2
    expected = 2 * LIFT * 400.0**2 * MOMENT / inertia
    assert (link.twist.angular[2] - before) / 0.5 == pytest.approx(expected, rel=0.01)


def test_wind_drags_the_quadrotor(tmp_path: Path) -> None:
    """m dv/dt = 4·ω·c·(w − v), once the rotors spin."""
    drag = "<rotorDragCoefficient>1e-3</rotorDragCoefficient><rollingMomentCoefficient>0</rollingMomentCoefficient>"
    sim, node = fly(tmp_path, motor=drag)
    node.receive("/quad/wind_speed", velocity={"x": 2.0})
    command(node, *[HOVER] * 4)
    sim.run(0.1)
    assert 0.0 < sim["m"].link("base_link").twist.linear[0] < 2.0


def test_motors_of_type_position_and_force(tmp_path: Path) -> None:
    pid = "<joint_control_pid><p>0.01</p><d>0.001</d><cmdMax>1</cmdMax><cmdMin>-1</cmdMin></joint_control_pid>"
    parameter = "<motorPositionPubTopic>angle</motorPositionPubTopic>"
    sim, node = fly(tmp_path, motor=f"<motorType>position</motorType>{pid}{parameter}", gravity=0.0)
    command(node, *[0.7] * 4)
    sim.run(3.0)
    assert sim["m"].joint("rotor_0_joint").position == pytest.approx(0.7, abs=0.01)
    assert node.published["/quad/angle"][-1].data == pytest.approx(0.7, abs=0.01)

    sim, node = fly(tmp_path, motor="<motorType>force</motorType>", gravity=0.0)
    command(node, *[1e-5] * 4)
    sim.run(1.0)
    assert sim["m"].joint("rotor_0_joint").velocity == pytest.approx(1e-5 / 2e-5, rel=0.05)


def test_commands_of_controllers_reach_the_motors(tmp_path: Path) -> None:
    sim, node = fly(tmp_path, PLUGIN.format("controller_interface", ""))
    node.receive("/quad/command/motor_speed", angular_velocities=[1.0, 2.0])
    assert list(node.published["/quad/gazebo/command/motor_speed"][-1].angular_velocities) == [1.0, 2.0]
    assert sim.report.warnings == []


def test_the_multirotor_base_publishes_rotor_speeds(tmp_path: Path) -> None:
    sim, node = fly(tmp_path, PLUGIN.format("multirotor_base_plugin", ""))
    command(node, 100.0, 200.0, 300.0, 400.0)
    sim.run(1.0)
    message = node.published["/quad/motor_speed"][-1]
    assert list(message.angular_velocities) == pytest.approx([100.0, -200.0, 300.0, -400.0], rel=1e-3)
    assert message.header.frame_id == "base_link"
    assert list(node.published["/quad/joint_states"][-1].name) == [f"rotor_{i}_joint" for i in range(4)]


def test_the_imu_measures_the_thrust(tmp_path: Path) -> None:
    quiet = "".join(
        f"<{device}{name}>0</{device}{name}>"
        for device in ("gyroscope", "accelerometer")
        for name in ("NoiseDensity", "TurnOnBiasSigma", "BiasRandomWalk" if device == "gyroscope" else "RandomWalk")
    )
    imu = PLUGIN.format("imu_plugin", f"<linkName>base_link</linkName>{quiet}")
    sim, node = fly(tmp_path, imu)
    sim.run(0.1)
    assert node.published["/quad/imu"][-1].linear_acceleration.z == pytest.approx(0.0, abs=1e-3), "in free fall"
    command(node, *[HOVER] * 4)
    sim.run(1.0)
    message = node.published["/quad/imu"][-1]
    assert message.linear_acceleration.z == pytest.approx(G, rel=1e-3)
    assert (message.header.frame_id, message.orientation_covariance[0]) == ("base_link", -1.0)


def test_imu_noise_is_deterministic(tmp_path: Path) -> None:
    runs: list[list[float]] = []
    for _ in range(2):
        sim, node = fly(tmp_path, PLUGIN.format("imu_plugin", "<linkName>base_link</linkName>"), gravity=0.0)
        sim.run(0.5)
        runs.append([message.angular_velocity.x for message in node.published["/quad/imu"]])
    assert runs[0] == runs[1]
    assert len(set(runs[0])) > 100


def test_odometry_is_published_after_its_delay(tmp_path: Path) -> None:
    parameters = """<linkName>base_link</linkName><odometryTopic>odom</odometryTopic>
<childFrameId>quad/base</childFrameId><measurementDivisor>10</measurementDivisor><measurementDelay>5</measurementDelay>"""
    sim, node = fly(tmp_path, PLUGIN.format("odometry_plugin", parameters))
    sim.run(0.1)
    assert len(node.published["/quad/odom"]) == 10
    message = node.published["/quad/odom"][-1]
    stamp_s = message.header.stamp.sec + message.header.stamp.nanosec / 1e9
    assert stamp_s == pytest.approx(0.091)
    assert message.pose.pose.position.z == pytest.approx(1.0 - G * stamp_s**2 / 2, abs=1e-3)
    assert message.twist.twist.linear.z == pytest.approx(-G * stamp_s, rel=1e-3)
    assert (message.header.frame_id, message.child_frame_id) == ("world", "quad/base")
    assert node.published["/quad/transform"][-1].transform.translation.z == message.pose.pose.position.z
    assert node.published["/tf"][-1].transforms[0].child_frame_id == "quad/base"


@pytest.mark.parametrize(
    ("motor", "message_text"),
    [
        ("<turningDirection>left</turningDirection>", "turningDirection"),
        ("<motorType>steam</motorType>", "<motorType> is velocity, position or force, got 'steam'"),
        ("<timeConstantUp>0</timeConstantUp>", "must be > 0"),
        ("<propeller>2</propeller>", "<propeller>"),
    ],
)
def test_an_invalid_motor_is_reported(tmp_path: Path, motor: str, message_text: str) -> None:
    sim, _ = fly(tmp_path, motor=motor)
    assert any(message_text in warning for warning in sim.report.warnings), sim.report.warnings
