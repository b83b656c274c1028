"""Tunnelling of small bodies through thin obstacles.

An impact at speed v penetrates 1.8 v h, whatever is hit. Beyond the middle of a small body and of the obstacle, the
contact pushes it out on the far side. MuJoCo's speculative contacts prevent that, but cost a robot 3 % of its speed,
ten of them 14 % and a furnished house 25 %: only worlds that need them pay, and only while a body has at least half the
critical speed (`cpp/tunnelling.cc`), which leaves room for the acceleration of a step and for two moving bodies.
"""

from collections.abc import Iterable

import mujoco

from .law_tables import find_table
from .shape_entry import CollidesWith, ShapeEntry

_FASTEST = 15.0
"""Speed after a fall of 11 m [m/s]; bodies that cannot tunnel at it are not checked at higher ones."""
_SLOWEST = 1e-9
"""Threshold speed [m/s] for shapes without thickness, which let every moving body through."""
_DEEP = 1.8
"""Stopping distance of an impact in steps of its speed: 17.6 mm at 10 m/s and 1 ms."""


def enable_ccd(model: mujoco.MjModel, shapes: Iterable[ShapeEntry]) -> None:
    """Enable speculative contacts in a world where a small body may tunnel through a thin fixed one."""
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
