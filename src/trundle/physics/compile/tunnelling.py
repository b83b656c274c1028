"""Small things over thin floors, which they would fall through.

An impact at v goes 1.8 steps' worth of way deep, whatever is hit. Where that is past the middle of a small body and of
what it hits, they are pushed apart on the far side. MuJoCo can look ahead for what meets within a step, which takes a
robot 3 % of its speed, ten of them 14 % and a furnished house 25 %: only worlds that need it pay for it, and only
while something is half as fast as it would have to be (`cpp/look_ahead.cc`): so a step's acceleration, or two that move
against one another, are not too much.
"""

from collections.abc import Iterable

import mujoco

from .law_tables import find_table
from .shapes import CollidesWith, ShapeEntry

_FASTEST = 15.0
"""[m/s] What fell from 11 m: bodies too large to go through at this speed are not looked after at a higher one."""
_SLOWEST = 1e-9
"""[m/s] What has no thickness at all lets everything through that moves."""
_DEEP = 1.8
"""Steps in whose way a body stops: 17.6 mm at 10 m/s and 1 ms."""


def enable_ccd(model: mujoco.MjModel, shapes: Iterable[ShapeEntry]) -> None:
    """Look ahead in a world where something small may go through something thin that stands."""
    halves = model.geom_aabb[:, 3:].min(axis=1)
    standing: list[float] = []
    moving: list[float] = []
    for shape in shapes:
        if shape.kind is not CollidesWith.PLANES:
            (standing if shape.fixed else moving).append(float(halves[model.geom(shape.name).id]))
    if not standing or not moving:
        return
    speed = (min(standing) + min(moving)) / (_DEEP * model.opt.timestep)
    if speed < _FASTEST:
        find_table(model, "laws")[0, 8] = max(speed / 2, _SLOWEST)
        model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_SPECULATIVE
