"""Worlds measured in Gazebo, against analytic results; `pytest -rP` prints every figure."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest

import trundle
from trundle.sim.simulation import ModelHandle, Simulation
from trundle.spatial import Twist

G = 9.8
SLOPE = 0.3490658504
"""[rad] 20 degrees."""
START = (0.0513030215, 2.1409538931)
"""x and z of the block on the incline [m]."""
Load = Callable[..., Simulation]


@pytest.fixture
def load(shared: Path, tmp_path: Path) -> Load:
    """Load a world; pairs of texts given are replaced in it first."""

    def load(name: str, *changes: tuple[str, str]) -> Simulation:
        text = (shared / "peers/worlds" / f"{name}.world").read_text()
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        file = tmp_path / f"{name}.world"
        file.write_text(text)
        return trundle.load(str(file))

    return load


def compare(quantity: str, measured: float, exact: float, unit: str, *, rel: float = 0.0, abs_: float = 0.0) -> None:
    """Print a figure with the analytic one, and assert its tolerance."""
    off, bar = abs(measured - exact), max(rel * abs(exact), abs_)
    error = f"{100 * off / abs(exact):.2g} % off, bar {100 * rel:g} %" if rel else f"{off:.2g} off, bar {abs_:g}"
    print(f"{quantity}: {measured:.6g} {unit}, exact {exact:.6g} ({error})")
    assert off <= bar, quantity


def arithmetic_geometric_mean(a: float, b: float) -> float:
    while abs(a - b) > 1e-15:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return a


def period(sim: Simulation) -> float:
    """Period of the pendulum, over five swings [s]."""
    hinge = sim.models[0].joints[0]
    crossings: list[float] = []
    before = hinge.position
    while len(crossings) < 6:
        sim.step()
        now = hinge.position
        if before < 0.0 <= now:
            crossings.append(sim.time_ns * 1e-9 - 0.001 * now / (now - before))
        before = now
    return (crossings[-1] - crossings[0]) / (len(crossings) - 1)


# Gazebo: 2.01806, 2.05222, 2.38090 s.
@pytest.mark.parametrize("amplitude_deg", [5.0, 30.0, 90.0])
def test_a_pendulum_has_the_analytic_period(load: Load, amplitude_deg: float) -> None:
    sim = load("a_pendulum")
    sim.models[0].joints[0].set_position(math.radians(amplitude_deg))
    small = 2 * math.pi * math.sqrt(1.01 / G)
    exact = small / arithmetic_geometric_mean(1.0, math.cos(math.radians(amplitude_deg) / 2))
    compare(f"pendulum from {amplitude_deg:g}°, period", period(sim), exact, "s", rel=1e-4)


def test_a_damped_pendulum_loses_the_expected_energy(load: Load) -> None:
    sim = load("a_pendulum_damped")
    hinge = sim.models[0].joints[0]
    hinge.set_position(math.radians(5.0))
    peaks: list[tuple[float, float]] = []
    angles = [hinge.position] * 2
    while len(peaks) < 6:
        sim.step()
        angles = [*angles[-1:], hinge.position] if len(angles) < 3 else angles
        angles.append(hinge.position)
        a, b, c = angles[-3:]
        if b > 0 and a < b >= c:
            peaks.append((sim.time_ns * 1e-9, b))
    (t0, high), (t1, low) = peaks[0], peaks[-1]
    # c / 2I; Gazebo 0.04952.
    rate = math.log(high / low) / (t1 - t0)
    compare("damped pendulum, decay", rate, 0.1 / (2 * 1.01), "1/s", rel=5e-3)


def slid(block: ModelHandle) -> float:
    """Distance down the incline [m]."""
    x, _, z = block.pose.position
    return (x - START[0]) * math.cos(SLOPE) - (z - START[1]) * math.sin(SLOPE)


# Gazebo: 1.6759 and 0.33518 m/s²; at 0.98 it freezes after a second.
@pytest.mark.parametrize(
    ("name", "mu"),
    [
        ("b_incline_half", 0.181985),
        ("b_incline_below", 0.327573),
        ("b_incline_just_below", 0.356691),
        ("b_incline_just_below_noad", 0.356691),
    ],
)
def test_below_the_friction_angle_a_block_slides_and_never_freezes(load: Load, name: str, mu: float) -> None:
    sim = load(name)
    sim.run(0.5)
    first = slid(sim["box"])
    sim.run(1.0)
    second = slid(sim["box"])
    sim.run(1.0)
    measured = slid(sim["box"]) - 2 * second + first
    exact = G * (math.sin(SLOPE) - mu * math.cos(SLOPE))
    compare(f"{name}, acceleration", measured, exact, "m/s²", rel=5e-3)


# Gazebo creeps 5.3 and 4.9 mm/s.
@pytest.mark.parametrize("name", ["b_incline_just_above", "b_incline_above"])
def test_above_the_friction_angle_a_block_stays(load: Load, name: str) -> None:
    sim = load(name)
    sim.run(1.0)
    before = slid(sim["box"])
    sim.run(3.0)
    compare(f"{name}, creep", (slid(sim["box"]) - before) / 3.0, 0.0, "m/s", abs_=1e-4)


def test_a_cart_drives_as_far_as_its_wheels_turn(load: Load) -> None:
    sim = load("c_cart")
    cart = sim["cart"]
    for joint in cart.joints:
        joint.command_velocity(5.0)
    sim.run(10.0)
    # 5 rad/s · 0.1 m · 10 s, less the start with wheels that slip; Gazebo 4.988 m.
    compare("cart, distance", cart.pose.position[0], 5.0, "m", rel=3e-3)
    assert abs(cart.pose.position[1]) < 1e-3


def test_a_cylinder_slips_and_then_rolls(load: Load) -> None:
    sim = load("c_freecyl")
    sim["cyl"].links[0].set_twist(Twist(angular=(0.0, 10.0, 0.0)))
    sim.run(3.0)
    # v = ω r / 3 for a solid cylinder; Gazebo 0.33335 m/s.
    compare("cylinder that rolls, speed", sim["cyl"].links[0].twist.linear[0], 1 / 3, "m/s", rel=5e-3)


@pytest.mark.parametrize("name", ["d_sphere", "d_box"])
def test_a_dropped_body_comes_to_rest_on_the_floor(load: Load, name: str) -> None:
    sim = load(name)
    sim.run(0.46)
    highest = 0.0
    for _ in range(500):
        sim.step()
        highest = max(highest, sim["s"].links[0].pose.position[2])
    assert highest < 0.1 + 1e-4  # no bounce
    sim.run(1.0)
    compare(f"{name}, height at rest", sim["s"].links[0].pose.position[2], 0.1, "m", abs_=1e-4)


def test_a_joint_with_limits_0_and_0_is_rigid(load: Load) -> None:
    sim = load("f_limit0")
    sim.run(2.0)
    arm = sim.models[0].links[0].pose
    compare("0..0 joint under 9.8 N·m, height", arm.position[2], 2.0, "m", abs_=1e-9)
    compare("0..0 joint under 9.8 N·m, angle", max(map(abs, arm.rpy)), 0.0, "rad", abs_=1e-9)


def test_an_arm_falls_on_its_stop_and_rests_there(load: Load) -> None:
    sim = load("f_limit_range")
    joint = sim.models[0].joints[0]
    furthest = 0.0
    for _ in range(3000):
        sim.step()
        furthest = max(furthest, abs(joint.position))
    # Gazebo overshoots 0.0035 rad.
    assert furthest < 0.5 + 0.01
    compare("arm on its stop, angle", abs(joint.position), 0.5, "rad", abs_=1e-3)


@pytest.mark.parametrize(("name", "inertia"), [("g_friction", 0.01), ("g_friction_I1", 1.0)])
def test_joint_friction_stops_a_wheel(load: Load, name: str, inertia: float) -> None:
    sim = load(name)
    wheel = sim.models[0].joints[0]
    wheel.set_velocity(20.0)
    slowing = 0.3 / inertia
    sim.run(0.5 * 20.0 / slowing)
    compare(f"{name}, speed half-way", wheel.velocity, 10.0, "rad/s", rel=5e-3)
    sim.run(20.0 / slowing)
    # Gazebo 6.657 rad.
    compare(f"{name}, way to rest", wheel.position, 20.0**2 / (2 * slowing), "rad", rel=5e-3)
    assert wheel.velocity == pytest.approx(0.0, abs=1e-6)


def test_joint_damping_slows_a_wheel(load: Load) -> None:
    sim = load("g_damping")
    wheel = sim.models[0].joints[0]
    wheel.set_velocity(20.0)
    sim.run(0.2)
    # Gazebo 7.339 rad/s.
    compare("joint damping, speed at 0.2 s", wheel.velocity, 20.0 * math.exp(-1.0), "rad/s", rel=5e-3)


@pytest.mark.parametrize("step", ["0.001", "0.002", "0.005", "0.01"])
def test_two_driven_wheels_turn_a_robot_as_a_unicycle_turns(load: Load, step: str) -> None:
    sim = load("e_diffdrive_noplugin", ("<max_step_size>0.001<", f"<max_step_size>{step}<"))
    vehicle = sim["veh"]
    # 0.5 m/s and 0.5 rad/s on wheels of 0.1 m that are 0.34 m apart.
    vehicle.joint("left_j").command_velocity((0.5 - 0.5 * 0.17) / 0.1)
    vehicle.joint("right_j").command_velocity((0.5 + 0.5 * 0.17) / 0.1)
    yaw, before = 0.0, 0.0
    for _ in range(1000):
        sim.run(0.01)
        now = vehicle.pose.rpy[2]
        yaw += math.remainder(now - before, 2 * math.pi)
        before = now
    # Gazebo 4.45.
    compare(f"diff drive by wheel speeds at {step} s a step, yaw", yaw, 5.0, "rad", rel=0.03)


@pytest.mark.parametrize("mass", ["0.001", "1", "1000"])
@pytest.mark.parametrize("restitution", [0.2, 0.5, 0.8])
@pytest.mark.parametrize("name", ["d_rest_both", "d_rest_both_defvel"])
def test_a_bounce_returns_to_restitution_squared_of_the_height(
    load: Load, name: str, restitution: float, mass: str
) -> None:
    inertia = f"{0.004 * float(mass):g}"
    sim = load(
        name,
        ("<restitution_coefficient>0.5<", f"<restitution_coefficient>{restitution}<"),
        ("<mass>1<", f"<mass>{mass}<"),
        (">0.004<", f">{inertia}<"),
    )
    ball = sim["s"].links[0]
    sim.run(math.sqrt(2 * 1.0 / G) - 0.005)
    while ball.twist.linear[2] < 0.0:
        sim.step()
    apex = 0.0
    while ball.twist.linear[2] > 0.0:
        sim.step()
        apex = max(apex, ball.pose.position[2] - 0.1)
    # Gazebo 0.555 m for 0.25, and no bounce at all with its own max_vel.
    compare(f"{name}, restitution {restitution:g} at {mass} kg, apex", apex, restitution**2, "m", rel=0.03)
