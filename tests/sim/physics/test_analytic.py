"""Motions with closed-form solutions."""

import math
from collections.abc import Iterable

import pytest

from trundle.base.diagnostics import Diagnostics, Source
from trundle.robots.model import (
    Box,
    Collision,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
    Plane,
    Sphere,
    Surface,
    World,
)
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

AT = Source("inline.sdf", 1)
G = 9.8
H = 0.001
SLOPE = math.radians(20.0)


def simulate(*models: Model) -> Simulation:
    return Simulation(World(name="w", at=AT, models=models), Diagnostics(strict=True))


def ball(height: float) -> Model:
    shape = Collision(name="c", geometry=Sphere(0.1), at=AT)
    inertial = Inertial(mass=1.0, moments=(0.004, 0.004, 0.004))
    link = Link(name="ball", at=AT, inertial=inertial, collisions=(shape,))
    return Model(name="ball", at=AT, world_from_model=Pose((0.0, 0.0, height)), links=(link,))


def hinged(axis: JointAxis, inertial: Inertial) -> Model:
    """One link on a hinge in the world at the origin."""
    link = Link(name="arm", at=AT, inertial=inertial)
    joint = Joint(name="hinge", type=JointType.REVOLUTE, parent="world", child="arm", at=AT, axis=axis)
    return Model(name="arm", at=AT, links=(link,), joints=(joint,))


def floor(mu: float) -> Model:
    surface = Surface(mu=mu, mu2=mu)
    shape = Collision(name="c", geometry=Plane((0.0, 0.0, 1.0), (100.0, 100.0)), at=AT, surface=surface)
    # Tilted about y: +x of the plane points downhill.
    pose = Pose.from_rpy(0.0, 0.0, 0.0, 0.0, SLOPE, 0.0)
    return Model(
        name="slope", at=AT, static=True, world_from_model=pose, links=(Link(name="l", at=AT, collisions=(shape,)),)
    )


def block() -> Model:
    """A slab of 1 kg lying on the slope, lower than wide so that it cannot tip."""
    inertial = Inertial(mass=1.0, moments=(0.0142, 0.0142, 0.0267))
    shape = Collision(name="c", geometry=Box((0.4, 0.4, 0.1)), at=AT, surface=Surface(mu=100.0, mu2=100.0))
    pose = Pose.from_rpy(0.0, 0.0, 0.0, 0.0, SLOPE, 0.0) @ Pose((0.0, 0.0, 0.05))
    link = Link(name="block", at=AT, inertial=inertial, collisions=(shape,))
    return Model(name="block", at=AT, world_from_model=pose, links=(link,))


def downhill(sim: Simulation) -> float:
    """Distance of the block along the slope [m]."""
    x, _, z = sim["block"].pose.position
    return x * math.cos(SLOPE) - z * math.sin(SLOPE)


def arithmetic_geometric_mean(a: float, b: float) -> float:
    while abs(a - b) > 1e-15:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return a


def rising_zeros(samples: Iterable[tuple[float, float]]) -> list[float]:
    """Times at which a sampled signal crosses zero upwards, linearly interpolated."""
    times: list[float] = []
    last_t, last = math.nan, math.nan
    for t, value in samples:
        if last < 0.0 <= value:
            times.append(last_t + (t - last_t) * -last / (value - last))
        last_t, last = t, value
    return times


def test_a_ball_falls_half_g_t_squared() -> None:
    sim = simulate(ball(100.0))
    sim.run(2.0)
    fallen = 100.0 - sim["ball"].pose.position[2]
    # A first-order integrator is off by half a step's worth of speed: g t h / 2 = 9.8 mm.
    assert fallen == pytest.approx(0.5 * G * 4.0, abs=G * 2.0 * H / 2 * 1.01)
    assert sim["ball"].link("ball").twist.linear[2] == pytest.approx(-2.0 * G, rel=1e-9)


@pytest.mark.parametrize("amplitude_deg", [5.0, 30.0, 90.0])
def test_a_pendulum_has_its_analytic_period(amplitude_deg: float) -> None:
    amplitude = math.radians(amplitude_deg)
    hanging = Inertial(mass=1.0, link_from_com=Pose((0.0, 0.0, -1.0)), moments=(0.01, 0.01, 0.01))
    sim = simulate(hinged(JointAxis(direction=(0.0, 1.0, 0.0)), hanging))
    hinge = sim["arm"].joint("hinge")
    hinge.set_position(amplitude)
    samples: list[tuple[float, float]] = []
    for _ in range(12_000):
        sim.step()
        samples.append((sim.time_ns * 1e-9, hinge.position))
    zeros = rising_zeros(samples)
    measured = (zeros[-1] - zeros[0]) / (len(zeros) - 1)
    small = 2 * math.pi * math.sqrt((1.0 * 1.0**2 + 0.01) / (1.0 * G * 1.0))
    # Gauss: the period at any amplitude is the small one over agm(1, cos(amplitude / 2)).
    exact = small / arithmetic_geometric_mean(1.0, math.cos(amplitude / 2))
    # 0.01 %: a fiftieth of a step over one period, far below the effect of a wrong inertia or gravity.
    assert measured == pytest.approx(exact, rel=1e-4)


def test_joint_friction_stops_a_wheel_at_the_analytic_time() -> None:
    # Coulomb friction 0.3 N·m on 0.01 kg·m² slows by 30 rad/s²: from 20 rad/s, 0.6667 s and 6.667 rad.
    spinning = Inertial(mass=1.0, moments=(0.01, 0.01, 0.01))
    sim = simulate(hinged(JointAxis(direction=(0.0, 0.0, 1.0), friction=0.3), spinning))
    wheel = sim["arm"].joint("hinge")
    wheel.command_effort(0.3 + 0.01 * 20.0 / 0.1)
    sim.run(0.1)
    assert wheel.velocity == pytest.approx(20.0, rel=1e-3)
    started_ns, started = sim.time_ns, wheel.position
    speed = wheel.velocity
    wheel.command_effort(0.0)
    while wheel.velocity > 1e-3 and sim.time_ns < 3e9:
        sim.step()
    # Soft friction loses the last 0.1 rad/s over a few steps; the turn is off by speed · h.
    assert (sim.time_ns - started_ns) * 1e-9 == pytest.approx(speed / 30.0, abs=5 * H)
    assert wheel.position - started == pytest.approx(speed**2 / 60.0, abs=speed * H)
    sim.run(0.5)
    assert abs(wheel.velocity) < 1e-6


def test_joint_damping_slows_exponentially() -> None:
    spinning = Inertial(mass=1.0, moments=(0.01, 0.01, 0.01))
    sim = simulate(hinged(JointAxis(direction=(0.0, 0.0, 1.0), damping=0.05), spinning))
    wheel = sim["arm"].joint("hinge")
    wheel.command_velocity(20.0)
    sim.run(1.0)
    speed = wheel.velocity
    wheel.command_effort(0.0)
    sim.run(0.2)
    # Implicit damping loses a factor 1 / (1 + h c / I) a step: 0.25 % off the exponential after 200 steps.
    assert wheel.velocity == pytest.approx(speed * math.exp(-0.05 / 0.01 * 0.2), rel=0.004)


def test_a_block_slides_at_half_the_holding_friction() -> None:
    mu = 0.5 * math.tan(SLOPE)
    sim = simulate(block(), floor(mu))
    sim.run(0.2)
    start, speed = downhill(sim), math.hypot(*sim["block"].link("block").twist.linear)
    sim.run(1.0)
    acceleration = 2 * (downhill(sim) - start - speed)
    # 1 %: soft contact carries a little more than the weight for some steps as it settles.
    assert acceleration == pytest.approx(G * (math.sin(SLOPE) - mu * math.cos(SLOPE)), rel=0.01)


def test_a_block_rests_at_a_tenth_more_than_the_holding_friction() -> None:
    sim = simulate(block(), floor(1.1 * math.tan(SLOPE)))
    sim.run(0.5)
    start = downhill(sim)
    sim.run(3.0)
    # MuJoCo's friction creeps; Gazebo's block creeps 5 mm/s here, ours has to stay below 0.02 mm/s.
    assert abs(downhill(sim) - start) < 6e-5


def test_an_arm_falls_on_its_stop_and_stays() -> None:
    sideways = Inertial(mass=1.0, link_from_com=Pose((1.0, 0.0, 0.0)), moments=(0.01, 0.01, 0.01))
    sim = simulate(hinged(JointAxis(direction=(0.0, 1.0, 0.0), lower=-0.5, upper=0.5), sideways))
    hinge = sim["arm"].joint("hinge")
    furthest = 0.0
    for _ in range(2000):
        sim.step()
        furthest = max(furthest, hinge.position)
    # It arrives at 3 rad/s: 3 mrad further in the step in which it arrives; Gazebo overshoots 3.5 mrad.
    assert furthest < 0.5 + 0.006
    assert hinge.position == pytest.approx(0.5, abs=1e-3)
    assert abs(hinge.velocity) < 1e-3


def test_a_dropped_ball_does_not_bounce() -> None:
    ground = Collision(name="c", geometry=Plane((0.0, 0.0, 1.0), (100.0, 100.0)), at=AT)
    sim = simulate(ball(1.1), Model(name="g", at=AT, static=True, links=(Link(name="l", at=AT, collisions=(ground,)),)))
    sim.run(math.sqrt(2 * 1.0 / G) + 0.02)
    heights: list[float] = []
    for _ in range(1000):
        sim.step()
        heights.append(sim["ball"].pose.position[2])
    # Restitution is zero; the rebound of a soft contact at 4.4 m/s may lift it 1 mm.
    assert max(heights) < 0.1 + 0.001
    assert heights[-1] == pytest.approx(0.1, abs=1e-3)
