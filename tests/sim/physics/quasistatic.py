"""Statics of a body that stands and slides on points of a floor: the reference for driven robots."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

GRAVITY = 9.8


@dataclass(frozen=True, slots=True, kw_only=True)
class Point:
    """A point of a vehicle on the floor."""

    x: float
    y: float
    """Position in the vehicle's frame [m]."""
    count: int = 1
    """Number of equally soft points that it represents."""
    mu: float = 1.0
    tread: float = 0.0
    """Speed of its surface backwards relative to the vehicle [m/s]."""
    load: float = 0.0
    """[N]"""


def share_weight(points: Sequence[Point], weight: float, *, x: float = 0.0, y: float = 0.0) -> list[Point]:
    """Loads of equally soft points under a rigid body, its weight [N] at x, y [m]."""
    arms = np.array([(1.0, p.x, p.y) for p in points])
    counts = np.array([p.count for p in points], dtype=float)
    sink = np.linalg.solve((arms * counts[:, None]).T @ arms, weight * np.array([1.0, x, y]))
    return [replace(p, load=float(load)) for p, load in zip(points, counts * (arms @ sink), strict=True)]


def drift(points: Sequence[Point]) -> tuple[float, float, float]:
    """Twist of a vehicle whose points slide by Coulomb's law: forwards, sideways [m/s] and yaw rate [rad/s].

    In steady motion, friction's power is minimal: the sum of mu · load · slip, a convex function of the twist. Newton's
    method finds it, with a slip that is smoothed less and less at zero.
    """
    arms = np.array([((1.0, 0.0, -p.y), (0.0, 1.0, p.x)) for p in points])
    treads = np.array([(p.tread, 0.0) for p in points])
    holds = np.array([p.mu * p.load for p in points])
    motion: NDArray[np.float64] = np.array([treads[:, 0].mean(), 0.0, 0.0])

    def power(motion: NDArray[np.float64], rounded: float) -> float:
        slips = arms @ motion - treads
        return float(holds @ np.sqrt((slips**2).sum(axis=1) + rounded**2))

    for rounded in 10.0 ** -np.arange(1.0, 7.0):
        for _ in range(60):
            slips = arms @ motion - treads
            lengths = np.sqrt((slips**2).sum(axis=1) + rounded**2)
            slope = np.einsum("n,nij,ni->j", holds / lengths, arms, slips)
            blunt = np.eye(2) - slips[:, :, None] * slips[:, None, :] / lengths[:, None, None] ** 2
            bend = np.einsum("n,nik,nij,njl->kl", holds / lengths, arms, blunt, arms)
            stride = -np.linalg.solve(bend, slope)
            while power(motion + stride, rounded) > power(motion, rounded) and np.abs(stride).max() > 1e-12:
                stride = stride / 2
            motion = motion + stride
    forwards, sideways, turning = motion.tolist()
    return forwards, sideways, turning


@dataclass(frozen=True, slots=True, kw_only=True)
class Vehicle:
    """A box on wheels that turn about y, and on balls that do not."""

    wheels: tuple[tuple[float, float], ...]
    """x, y of each wheel [m]."""
    balls: tuple[tuple[float, float], ...] = ()
    radius: float = 0.1
    """Radius of the wheels [m]; twice that of the balls."""
    mass: float = 15.0
    """Mass of the box [kg]."""
    wheel_mass: float = 5.0
    x: float = 0.0
    """x of the box' centre [m]."""
    mu: float = 1.0
    """Friction of the wheels."""
    ball_mu: float = 1.0

    def sdf(self, name: str = "vehicle") -> str:
        """Write the model, its frame on the floor in the middle."""
        side, high = 0.3, self.radius
        balls = "".join(
            f'<collision name="ball{i}"><pose>{x} {y} {high / 2} 0 0 0</pose><geometry><sphere>'
            f"<radius>{high / 2}</radius></sphere></geometry>{_friction(self.ball_mu)}</collision>"
            for i, (x, y) in enumerate(self.balls)
        )
        box = self.mass * side**2 / 6
        chassis = (
            f'<link name="chassis"><inertial><pose>{self.x} 0 {high} 0 0 0</pose><mass>{self.mass}</mass><inertia>'
            f"<ixx>{box}</ixx><iyy>{box}</iyy><izz>{box}</izz></inertia></inertial>{balls}</link>"
        )
        spin = self.wheel_mass * high**2 / 2
        moments = f"<ixx>{spin}</ixx><iyy>{spin}</iyy><izz>{spin}</izz>"
        wheels = "".join(
            f'<link name="wheel{i}"><pose>{x} {y} {high} {-math.pi / 2} 0 0</pose><inertial>'
            f"<mass>{self.wheel_mass}</mass><inertia>{moments}</inertia></inertial>"
            f'<collision name="tyre"><geometry><cylinder><radius>{high}</radius><length>0.05</length></cylinder>'
            f'</geometry>{_friction(self.mu)}</collision></link><joint name="axle{i}" type="revolute">'
            f"<parent>chassis</parent><child>wheel{i}</child><axis><xyz>0 0 1</xyz></axis></joint>"
            for i, (x, y) in enumerate(self.wheels)
        )
        return f'<model name="{name}">{chassis}{wheels}</model>'

    def points(self, treads: Sequence[float] = (), *, twist: Sequence[float] = (0.0, 0.0, 0.0)) -> list[Point]:
        """Points that it stands on, wheels first; a wheel counts twice.

        Args:
            treads: see `Point`.
            twist: forwards, sideways [m/s] and turning [rad/s], all steady: weight leans out of the curve.
        """
        speeds = treads or [0.0] * len(self.wheels)
        wheels = [Point(x=x, y=y, count=2, mu=self.mu, tread=v) for (x, y), v in zip(self.wheels, speeds, strict=True)]
        points = wheels + [Point(x=x, y=y, mu=self.ball_mu) for x, y in self.balls]
        weight = (self.mass + len(self.wheels) * self.wheel_mass) * GRAVITY
        x = (self.mass * self.x + self.wheel_mass * sum(x for x, _ in self.wheels)) * GRAVITY / weight
        y = self.wheel_mass * sum(y for _, y in self.wheels) * GRAVITY / weight
        forwards, sideways, turning = twist
        lean = turning * self.radius / GRAVITY
        x, y = x + lean * (sideways + turning * x), y - lean * (forwards - turning * y)
        return share_weight(points, weight, x=x, y=y)


def _friction(mu: float) -> str:
    return f"<surface><friction><ode><mu>{mu}</mu><mu2>{mu}</mu2></ode></friction></surface>"
