"""Tunnelling of small bodies through thin obstacles.

An impact at speed v penetrates 1.8 v h, whatever is hit. Beyond the middle of a small body and of the obstacle, the
contact pushes it out on the far side. MuJoCo's speculative contacts prevent that, but cost a robot 3 % of its speed,
ten of them 14 % and a furnished house 25 %: only worlds that need them pay, and only while a body has at least half the
critical speed (`cpp/tunnelling.cc`), which leaves room for the acceleration of a step and for two moving bodies.

A thin shape beside a thick one of its body, as within the casing of a robot, goes nowhere without it: the thick one is
stopped.
"""

from collections.abc import Iterable

import mujoco
import numpy as np
import numpy.typing as npt

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
    touching = [shape for shape in shapes if shape.kind is not CollidesWith.PLANES]
    standing = np.array([model.geom(shape.name).id for shape in touching if shape.fixed], dtype=int)
    moving = np.array([model.geom(shape.name).id for shape in touching if not shape.fixed], dtype=int)
    if not standing.size or not moving.size:
        return
    step_m = _DEEP * model.opt.timestep
    thinnest = float(halves[standing].min())
    moving = moving[~_are_beside_thick_ones(model, moving, halves[moving] + thinnest >= _FASTEST * step_m)]
    if moving.size:
        speed = (thinnest + float(halves[moving].min())) / step_m
        find_table(model, "laws")[0, 8] = max(speed / 2, _SLOWEST)
        model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_SPECULATIVE


def _are_beside_thick_ones(
    model: mujoco.MjModel, shapes: npt.NDArray[np.int_], are_thick: npt.NDArray[np.bool_]
) -> npt.NDArray[np.bool_]:
    """Return for each shape whether it is thick, or its middle is in the bounding sphere of a thick one of its body."""
    beside = are_thick.copy()
    bodies = model.geom_bodyid[shapes]
    for thick in shapes[are_thick & np.isin(bodies, bodies[~are_thick])]:
        same = bodies == model.geom_bodyid[thick]
        distances = np.linalg.norm(model.geom_pos[shapes] - model.geom_pos[thick], axis=1)
        beside |= same & (distances <= model.geom_rbound[thick])
    return beside
