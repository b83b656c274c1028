"""Finds out what blew up, at the step at which it did."""

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from ..compile.compiled_world import CompiledWorld

_HUGE = 1e10
"""MuJoCo's mjMAXVAL: what is larger, it calls unstable."""


class Divergence(Struct, frozen=True, kw_only=True):
    """What ran away, and what it may have to do with."""

    time_s: float
    """Simulation time of the last step that was sound."""
    link: str
    """`model::link`"""
    joint: str | None
    """`model::joint`, where the link hangs from one that moves."""
    touching: tuple[str, ...]
    """`model::link::collision` of what it touched, deepest first."""

    def __str__(self) -> str:
        on = "" if self.joint is None else f" on joint {self.joint!r}"
        among = "" if not self.touching else f", touching {', '.join(map(repr, self.touching))}"
        return f"after {self.time_s:.3f} s: {self.link!r} ran away{on}{among}"


def find_divergence(
    compiled: CompiledWorld, data: mujoco.MjData, speeds: NDArray[np.float64], time_s: float
) -> Divergence:
    """Look at the state right after the bad step.

    The solver spreads one link's NaN over the world. So it is the link that is pushed by no number, or whose
    accelerations are huge before the solver sees them, or that was the fastest before the step.

    Args:
        compiled: the world.
        data: after the step.
        speeds: (nv,) before it.
        time_s: before it.
    """
    model = compiled.model
    pushed = np.flatnonzero(~np.isfinite(data.xfrc_applied).all(axis=1))
    if pushed.size:
        body, dof = int(pushed[0]), -1
    else:
        accelerations = np.nan_to_num(np.abs(data.qacc_smooth), nan=np.inf)
        dof = int(np.argmax(accelerations if accelerations.max() > _HUGE else speeds))
        body = int(model.dof_bodyid[dof])
    joints = {int(compiled.axis_dof[axis]): name for name, axes in _axes(compiled) for axis in axes}
    return Divergence(
        time_s=time_s, link=model.body(body).name, joint=joints.get(dof), touching=_touching(compiled, data, body)
    )


def _axes(compiled: CompiledWorld) -> list[tuple[str, range]]:
    return list(zip(compiled.joint_names, compiled.joint_axes, strict=True))


def _touching(compiled: CompiledWorld, data: mujoco.MjData, body: int, most: int = 3) -> tuple[str, ...]:
    """Whatever is in contact with a body's geoms."""
    depths: dict[str, float] = {}
    for contact in data.contact:
        bodies = [int(compiled.model.geom_bodyid[geom]) for geom in contact.geom]
        if body in bodies:
            other = compiled.geom_collisions[int(contact.geom[1 - bodies.index(body)])]
            depths[other] = max(depths.get(other, -np.inf), -float(contact.dist))
    return tuple(sorted(depths, key=lambda name: -depths[name])[:most])
