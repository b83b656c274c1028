"""Where mu and mu2 differ, friction is ODE's pyramid: each direction by its own coefficient, whatever the other does.

The truth is mechanics along each axis by itself. A block that turns as it slides is no closed form, so blocks are flat.
"""

import math
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from tests.sim.physics.quasistatic import Vehicle
from tests.sim.physics.surface_world import G, body, floor, friction, load_models

from trundle.sim.simulation import Simulation
from trundle.spatial import Twist, Wrench

Load = Callable[..., Simulation]
Pair = tuple[float, float]
FLAT = "<box><size>1 1 0.02</size></box>"


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Load models in a world."""
    return partial(load_models, tmp_path)


def slide(speed: float, push: float, grip: float, seconds: float) -> float:
    """Distance of 1 kg along one axis under a push, braked by a grip that is not more than needed to hold it [m]."""
    distance = 0.0
    while seconds > 0.0:
        if speed == 0.0 and abs(push) <= grip:
            return distance
        acceleration = push - math.copysign(grip, speed or push)
        stop = -speed / acceleration if acceleration * speed < 0.0 else math.inf
        part = min(stop, seconds)
        distance += speed * part + acceleration * part**2 / 2
        speed = 0.0 if stop <= seconds else speed + acceleration * part
        seconds -= part
    return distance


def moved(sim: Simulation, first: Pair, *, push: Pair = (0.0, 0.0), speed: Pair = (0.0, 0.0), seconds: float) -> Pair:
    """Distance along the first friction direction and across it, under a push and from a speed along them [m]."""
    second = (-first[1], first[0])

    def in_world(along: Pair) -> tuple[float, float, float]:
        return along[0] * first[0] + along[1] * second[0], along[0] * first[1] + along[1] * second[1], 0.0

    sim.run(0.05)
    x, y, _ = sim["b"].pose.position
    sim["b"].set_twist(Twist(in_world(speed)))
    sim["b"].link("l").apply_wrench(Wrench(force=in_world(push)))
    sim.run(seconds)
    east, north = sim["b"].pose.position[0] - x, sim["b"].pose.position[1] - y
    return east * first[0] + north * first[1], east * second[0] + north * second[1]


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.0])
@pytest.mark.parametrize(
    ("mu", "mu2", "push", "speed"),
    [
        (0.5, 0.2, (3.0, 3.0), (0.0, 0.0)),
        (0.5, 0.2, (4.8, 3.0), (0.0, 0.0)),
        (0.5, 0.2, (5.5, 1.5), (0.0, 0.0)),
        (0.5, 0.2, (5.5, 3.0), (0.0, 0.0)),
        (0.5, 0.2, (4.8, 1.9), (0.0, 0.0)),
        (0.5, 0.2, (0.0, 0.0), (1.0, 1.0)),
        (0.5, 0.2, (0.0, 0.0), (0.1, 1.0)),
        (0.5, 0.2, (3.0, 3.0), (-0.5, -1.0)),
        (0.2, 0.5, (2.5, 2.0), (0.0, 1.0)),
        (0.3, 0.8, (0.0, 0.0), (2.0, -2.0)),
        (0.5, 0.45, (4.6, 4.6), (0.0, 0.0)),
        (1.0, 0.1, (5.0, 1.2), (0.0, 0.0)),
        (1.0, 0.01, (3.0, 3.0), (0.0, 0.0)),
        (0.5, 0.0, (3.0, 3.0), (0.0, 0.0)),
        (1.5, 0.075, (-15.5, -1.0), (0.1, 0.7)),
        (1.5, 0.3, (5.0, 4.0), (0.0, 0.0)),
    ],
)
def test_each_direction_has_its_own_friction_coefficient(
    load: Load, mu: float, mu2: float, push: Pair, speed: Pair, angle: float
) -> None:
    """Before, the first was moved by 0.174 and 0.677 m: sliding along y loosened x; Gazebo has 0 and 0.520."""
    first = (math.cos(angle), math.sin(angle))
    surface = friction(mu, mu2, f"<fdir1>{first[0]} {first[1]} 0</fdir1>")
    sim = load(floor(friction(10.0)), body("b", FLAT, surface, pose="0 0 0.01 0 0 0"))

    # A push whose direction changes brakes late by 0.01 s (the solver's friction has a time constant of ten steps).
    exact = tuple(slide(speed[i], push[i], (mu, mu2)[i] * G, 1.0) for i in (0, 1))
    assert moved(sim, first, push=push, speed=speed, seconds=1.0) == pytest.approx(exact, rel=0.02, abs=7e-3)


@pytest.mark.parametrize("crowd", [False, True])
def test_each_direction_has_the_smaller_coefficient_of_two_surfaces(load: Load, crowd: bool) -> None:
    """Gazebo's ODEPhysics::Collide; ODE's first direction on a floor is y."""
    models = [floor(friction(0.9, 0.2)), body("b", FLAT, friction(0.5, 0.8), pose="0 0 0.01 0 0 0")]
    if crowd:  # so many pairs that shapes meet by MuJoCo's search
        models += [body(f"wall{i}", FLAT, pose=f"{9 + 2 * i} 9 9 0 0 0", static=True) for i in range(45)]
        models += [body(f"far{i}", FLAT, friction(0.5, 0.8), pose=f"{9 + 2 * i} -9 9 0 0 0") for i in range(45)]
    sim = load(*models)

    along, across = moved(sim, (0.0, 1.0), push=(4.0, 3.0), seconds=0.5)
    assert (along, across) == pytest.approx((0.0, slide(0.0, 3.0, 0.2 * G, 0.5)), rel=0.02, abs=2e-3)


@pytest.mark.parametrize("yaw", [0.0, 0.5, 1.2])
def test_a_block_on_a_slope_slides_along_the_axis_of_lower_friction(load: Load, yaw: float) -> None:
    """Each axis has its part of the weight."""
    tilt = math.radians(25.0)
    surface = friction(0.7, 0.15, f"<fdir1>{math.cos(yaw)} {math.sin(yaw)} 0</fdir1>")
    pose = f"{0.01 * math.sin(tilt)} 0 {0.01 * math.cos(tilt)} 0 {tilt} 0"
    sim = load(floor(friction(10.0), tilt=tilt), body("b", FLAT, surface, pose=pose))
    sim.run(1.0)

    x, y, z = sim["b"].pose.position
    down, aside = x * math.cos(tilt) - z * math.sin(tilt), y
    pull, load_ = G * math.sin(tilt), G * math.cos(tilt)
    along = slide(0.0, pull * math.cos(yaw), 0.7 * load_, 1.0)
    across = slide(0.0, -pull * math.sin(yaw), 0.15 * load_, 1.0)
    exact = along * math.cos(yaw) - across * math.sin(yaw), along * math.sin(yaw) + across * math.cos(yaw)
    assert (down, aside) == pytest.approx(exact, rel=0.02, abs=7e-3)


@pytest.mark.parametrize("slip2", [0.0, 0.002])
def test_slip_under_a_force_is_independent_in_each_direction(load: Load, slip2: float) -> None:
    """slip1 of 0.1 m/s/N up to 0.5 of the weight, whatever happens across."""
    slips = f"<slip1>0.1</slip1><slip2>{slip2}</slip2><fdir1>1 0 0</fdir1>"
    sim = load(floor(friction(10.0)), body("b", FLAT, friction(0.5, 0.2, slips), pose="0 0 0.01 0 0 0"))

    along, across = moved(sim, (1.0, 0.0), push=(4.0, 3.0), seconds=1.0)
    delay = 0.1  # [s] mass · slip
    assert along == pytest.approx(4.0 * 0.1 * (1.0 - delay), rel=0.02)
    assert across == pytest.approx((3.0 - 0.2 * G) / 2, rel=0.02)


def test_a_bounce_changes_each_tangential_speed_by_its_own_coefficient(load: Load) -> None:
    """An impulse P of the floor takes up to mu P from one speed and up to mu2 P from the other."""
    bounce = "<bounce><restitution_coefficient>0.5</restitution_coefficient><threshold>0</threshold></bounce>"
    surface = bounce + friction(0.5, 0.1, "<fdir1>1 0 0</fdir1>")
    sim = load(floor(bounce + friction(10.0)), body("b", FLAT, surface, pose="0 0 0.21 0 0 0"))
    sim["b"].set_twist(Twist((3.0, 3.0, 0.0)))
    sim.run(0.25)
    x, y, _ = sim["b"].link("l").twist.linear
    impulse = 1.5 * math.sqrt(2 * G * 0.2)
    assert (3.0 - x, 3.0 - y) == pytest.approx((0.5 * impulse, 0.1 * impulse), rel=0.03)


@pytest.mark.parametrize(("mu", "mu2"), [(0.4, 1.0), (0.5, 0.8), (0.3, 0.3001), (1.0, 0.4), (1.0, 0.7)])
@pytest.mark.parametrize(("left", "right"), [(2.0, 4.0), (-1.0, 1.0)])
def test_a_skid_steered_robot_turns_fully_or_not_at_all(
    load: Load, mu: float, mu2: float, left: float, right: float
) -> None:
    """Friction's power is linear in the rate of turning: mu along the axles, 0.25 m ahead and behind, takes more or
    less than mu2 of the treads, 0.3 m aside. Between cones, wheels slide both ways, and it turns by some of both.
    """
    wheels = ((0.25, 0.3), (-0.25, 0.3), (0.25, -0.3), (-0.25, -0.3))
    vehicle = Vehicle(wheels=wheels, mass=40.0, wheel_mass=2.0)
    plain = friction(1.0).removeprefix("<friction>").removesuffix("</friction>")
    turning = friction(mu, mu2, "<fdir1>0 0 1</fdir1>").removeprefix("<friction>").removesuffix("</friction>")
    assert plain in vehicle.sdf()
    sim = load(floor(friction(10.0)), vehicle.sdf().replace(plain, turning))
    for i, (_, y) in enumerate(wheels):
        sim["vehicle"].joint(f"axle{i}").command_velocity(left if y > 0 else right)
    sim.run(2.0)

    rates: list[float] = []
    for _ in range(50):
        sim.run(0.009)
        rates.append(sim["vehicle"].twist.angular[2])
        assert len(sim.contacts()) == 4
    whole = vehicle.radius * (right - left) / 2 / 0.3
    assert sum(rates) / 50 == pytest.approx(whole if mu * 0.25 < mu2 * 0.3 else 0.0, rel=0.01, abs=1e-3)
