"""A quadrotor of RotorS' plugins against its motors' constants."""

from pathlib import Path

import pytest
from tests.gazebo.plugins.rotors.quadrotor import HOVER, LIFT, MOMENT, PLUGIN, ROTOR, G, quadrotor
from tests.gazebo.plugins.stage import Wires, load

from trundle.sim.simulation import Simulation


def fly(folder: Path, more: str = "", motor: str = "", gravity: float = G) -> tuple[Simulation, Wires]:
    """The quadrotor, and the stand-in for its node."""
    wires = Wires()
    return load(folder, quadrotor(more, motor), gravity=f"0 0 {-gravity}", wires=wires), wires


def command(wires: Wires, *speeds: float) -> None:
    wires.tell("/quad/gazebo/command/motor_speed", angular_velocities=list(speeds))


def test_it_hovers_at_the_speed_that_carries_it(tmp_path: Path) -> None:
    sim, wires = fly(tmp_path)
    assert sim.report.warnings == []
    command(wires, *[HOVER] * 4)
    sim.run(1.0)
    link = sim["m"].link("base_link")
    falling = link.twist.linear[2]
    assert falling < -0.05, "it fell while the rotors took up speed"
    sim.run(2.0)
    assert link.twist.linear[2] == pytest.approx(falling, abs=1e-3)
    assert link.pose.rpy == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)
    assert wires.said["/quad/motor_speed/0"][-1].data == pytest.approx(HOVER / 10, rel=1e-6)


def test_faster_rotors_lift_by_their_constant(tmp_path: Path) -> None:
    sim, wires = fly(tmp_path)
    command(wires, *[1.1 * HOVER] * 4)
    sim.run(1.0)
    link = sim["m"].link("base_link")
    before = link.twist.linear[2]
    sim.run(1.0)
    assert link.twist.linear[2] - before == pytest.approx(G * (1.1**2 - 1), rel=1e-3)


def test_rotors_that_turn_to_the_right_turn_the_body_to_the_left(tmp_path: Path) -> None:
    """By thrust times <momentConstant>, against the inertia of all that turns with the body."""
    sim, wires = fly(tmp_path, motor="<rotorDragCoefficient>0</rotorDragCoefficient>", gravity=0.0)
    command(wires, 0.0, 400.0, 0.0, 400.0)
    sim.run(0.5)
    link = sim["m"].link("base_link")
    before = link.twist.angular[2]
    sim.run(0.5)
    inertia = 0.012 + 4 * ROTOR * 0.2**2
    expected = 2 * LIFT * 400.0**2 * MOMENT / inertia
    assert (link.twist.angular[2] - before) / 0.5 == pytest.approx(expected, rel=0.01)


def test_moving_air_drags(tmp_path: Path) -> None:
    """m dv/dt = 4·ω·c·(w − v), once the rotors turn."""
    drag = "<rotorDragCoefficient>1e-3</rotorDragCoefficient><rollingMomentCoefficient>0</rollingMomentCoefficient>"
    sim, wires = fly(tmp_path, motor=drag)
    wires.tell("/quad/wind_speed", velocity={"x": 2.0})
    command(wires, *[HOVER] * 4)
    sim.run(0.1)
    assert 0.0 < sim["m"].link("base_link").twist.linear[0] < 2.0


def test_a_motor_of_angles_and_one_of_forces(tmp_path: Path) -> None:
    pid = "<joint_control_pid><p>0.01</p><d>0.001</d><cmdMax>1</cmdMax><cmdMin>-1</cmdMin></joint_control_pid>"
    told = "<motorPositionPubTopic>angle</motorPositionPubTopic>"
    sim, wires = fly(tmp_path, motor=f"<motorType>position</motorType>{pid}{told}", gravity=0.0)
    command(wires, *[0.7] * 4)
    sim.run(3.0)
    assert sim["m"].joint("rotor_0_joint").position == pytest.approx(0.7, abs=0.01)
    assert wires.said["/quad/angle"][-1].data == pytest.approx(0.7, abs=0.01)

    sim, wires = fly(tmp_path, motor="<motorType>force</motorType>", gravity=0.0)
    command(wires, *[1e-5] * 4)
    sim.run(1.0)
    assert sim["m"].joint("rotor_0_joint").velocity == pytest.approx(1e-5 / 2e-5, rel=0.05)


def test_what_controllers_want_reaches_the_motors(tmp_path: Path) -> None:
    sim, wires = fly(tmp_path, PLUGIN.format("controller_interface", ""))
    wires.tell("/quad/command/motor_speed", angular_velocities=[1.0, 2.0])
    assert list(wires.said["/quad/gazebo/command/motor_speed"][-1].angular_velocities) == [1.0, 2.0]
    assert sim.report.warnings == []


def test_its_base_tells_how_fast_the_rotors_turn(tmp_path: Path) -> None:
    sim, wires = fly(tmp_path, PLUGIN.format("multirotor_base_plugin", ""))
    command(wires, 100.0, 200.0, 300.0, 400.0)
    sim.run(1.0)
    told = wires.said["/quad/motor_speed"][-1]
    assert list(told.angular_velocities) == pytest.approx([100.0, -200.0, 300.0, -400.0], rel=1e-3)
    assert told.header.frame_id == "base_link"
    assert list(wires.said["/quad/joint_states"][-1].name) == [f"rotor_{i}_joint" for i in range(4)]


def test_its_imu_feels_what_the_rotors_do(tmp_path: Path) -> None:
    quiet = "".join(
        f"<{device}{name}>0</{device}{name}>"
        for device in ("gyroscope", "accelerometer")
        for name in ("NoiseDensity", "TurnOnBiasSigma", "BiasRandomWalk" if device == "gyroscope" else "RandomWalk")
    )
    imu = PLUGIN.format("imu_plugin", f"<linkName>base_link</linkName>{quiet}")
    sim, wires = fly(tmp_path, imu)
    sim.run(0.1)
    assert wires.said["/quad/imu"][-1].linear_acceleration.z == pytest.approx(0.0, abs=1e-3), "it falls"
    command(wires, *[HOVER] * 4)
    sim.run(1.0)
    told = wires.said["/quad/imu"][-1]
    assert told.linear_acceleration.z == pytest.approx(G, rel=1e-3)
    assert (told.header.frame_id, told.orientation_covariance[0]) == ("base_link", -1.0)


def test_an_imu_errs_the_same_way_twice(tmp_path: Path) -> None:
    ways: list[list[float]] = []
    for _ in range(2):
        sim, wires = fly(tmp_path, PLUGIN.format("imu_plugin", "<linkName>base_link</linkName>"), gravity=0.0)
        sim.run(0.5)
        ways.append([message.angular_velocity.x for message in wires.said["/quad/imu"]])
    assert ways[0] == ways[1]
    assert len(set(ways[0])) > 100


def test_odometry_tells_late_what_was_measured(tmp_path: Path) -> None:
    parameters = """<linkName>base_link</linkName><odometryTopic>odom</odometryTopic>
<childFrameId>quad/base</childFrameId><measurementDivisor>10</measurementDivisor><measurementDelay>5</measurementDelay>"""
    sim, wires = fly(tmp_path, PLUGIN.format("odometry_plugin", parameters))
    sim.run(0.1)
    assert len(wires.said["/quad/odom"]) == 10
    told = wires.said["/quad/odom"][-1]
    stamp_s = told.header.stamp.sec + told.header.stamp.nanosec / 1e9
    assert stamp_s == pytest.approx(0.091)
    assert told.pose.pose.position.z == pytest.approx(1.0 - G * stamp_s**2 / 2, abs=1e-3)
    assert told.twist.twist.linear.z == pytest.approx(-G * stamp_s, rel=1e-3)
    assert (told.header.frame_id, told.child_frame_id) == ("world", "quad/base")
    assert wires.said["/quad/transform"][-1].transform.translation.z == told.pose.pose.position.z
    assert wires.said["/tf"][-1].transforms[0].child_frame_id == "quad/base"


@pytest.mark.parametrize(
    ("motor", "words"),
    [
        ("<turningDirection>left</turningDirection>", "turningDirection"),
        ("<motorType>steam</motorType>", "<motorType> is velocity, position or force, got 'steam'"),
        ("<timeConstantUp>0</timeConstantUp>", "must be > 0"),
        ("<propeller>2</propeller>", "<propeller>"),
    ],
)
def test_what_is_wrong_with_a_motor_is_named(tmp_path: Path, motor: str, words: str) -> None:
    sim, _ = fly(tmp_path, motor=motor)
    assert any(words in warning for warning in sim.report.warnings), sim.report.warnings
