"""Tunnelling of small bodies through thin obstacles.

An impact at speed v penetrates any obstacle by 1.8 v h. If this is beyond the middle of a small body and of the
obstacle, the contact pushes the body out on the far side. MuJoCo's speculative contacts prevent that, but cost a robot
3 % of its speed, ten of them 14 % and a furnished house 25 %: only worlds that need them pay, and only while a body
has at least half the critical speed (`cpp/contact/tunnelling.cc`), which leaves room for the acceleration of a step
and for two moving bodies.

A thin shape next to a thicker one of the same body, such as a piece of a robot's casing, cannot tunnel alone: the
thicker one is stopped.
"""

from collections.abc import Iterable

import mujoco
import numpy as np
import numpy.typing as npt

from .law_tables import find_table
from .shape_entry import CollidesWith, ShapeEntry

_FASTEST = 15.0
"""Speed after a fall of 11 m [m/s]; bodies that cannot tunnel at this speed are not checked at all."""
_SLOWEST = 1e-9
"""Threshold speed [m/s] for shapes without thickness, which let every moving body through."""
_DEEP = 1.8
"""Stopping distance of an impact in steps of its speed: 17.6 mm at 10 m/s and 1 ms."""


def enable_ccd(model: mujoco.MjModel, shapes: Iterable[ShapeEntry]) -> None:
    """Enable speculative contacts in a world where a small body may tunnel through a thin fixed one."""
    halves = model.geom_aabb[:, 3:].min(axis=1)
    touching = [shape for shape in shapes if shape.kind is not CollidesWith.PLANES]
    fixed = np.array([model.geom(shape.name).id for shape in touching if shape.fixed], dtype=int)
    moving = np.array([model.geom(shape.name).id for shape in touching if not shape.fixed], dtype=int)
    if not fixed.size or not moving.size:
        return
    thickness = float(halves[fixed].min()) + float(_thickest_around(model, moving, halves[moving]).min())
    speed = thickness / (_DEEP * model.opt.timestep)
    if speed < _FASTEST:
        find_table(model, "laws")[0, 8] = max(speed / 2, _SLOWEST)
        model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_SPECULATIVE


def _thickest_around(
    model: mujoco.MjModel, shapes: npt.NDArray[np.int_], halves: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]:
    """Return for each shape the largest half thickness of the shapes of its body whose bounding sphere contains its
    middle.

    Args:
        model: compiled model.
        shapes: geom ids, (n,).
        halves: their half thicknesses [m], (n,).
    """
    largest = halves.copy()
    bodies = model.geom_bodyid[shapes]
    order = np.argsort(bodies, kind="stable")
    for group in np.split(order, np.flatnonzero(np.diff(bodies[order])) + 1):
        middles = model.geom_pos[shapes[group]]
        for shape in group if len(group) > 1 else ():
            distances = np.linalg.norm(middles - model.geom_pos[shapes[shape]], axis=1)
            around = group[distances <= model.geom_rbound[shapes[shape]]]
            largest[around] = np.maximum(largest[around], halves[shape])
    return largest
