"""Diagnosis of unstable physics: the link that diverged first."""

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from ..compile.compiled_world import CompiledWorld

_HUGE = 1e10
"""MuJoCo's mjMAXVAL, beyond which it reports instability."""


class Divergence(Struct, frozen=True, kw_only=True):
    """Diverged link, its joint and its contacts."""

    time_s: float
    """Simulation time of the last good step."""
    link: str
    """`model::link`"""
    joint: str | None
    """`model::joint` of a link with a moving parent joint."""
    touching: tuple[str, ...]
    """`model::link::collision` of its contacts, deepest first."""

    def __str__(self) -> str:
        on = "" if self.joint is None else f" on joint {self.joint!r}"
        among = "" if not self.touching else f", touching {', '.join(map(repr, self.touching))}"
        return f"after {self.time_s:.3f} s: {self.link!r} diverged{on}{among}"


def find_divergence(
    compiled: CompiledWorld, data: mujoco.MjData, speeds: NDArray[np.float64], time_s: float
) -> Divergence:
    """Find the diverged link right after the bad step.

    The solver spreads one link's NaN over the world. The culprit is the link with a non-finite applied force, or with
    huge accelerations before the solver, or the fastest before the step.

    Args:
        compiled: the world.
        data: data after the step.
        speeds: (nv,) speeds before the step.
        time_s: time before the step.
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


def _touching(compiled: CompiledWorld, data: mujoco.MjData, body: int, max_count: int = 3) -> tuple[str, ...]:
    """Return the collisions in contact with a body, deepest first."""
    depths: dict[str, float] = {}
    for contact in data.contact:
        bodies = [int(compiled.model.geom_bodyid[geom]) for geom in contact.geom]
        if body in bodies:
            other = compiled.geom_collisions[int(contact.geom[1 - bodies.index(body)])]
            depths[other] = max(depths.get(other, -np.inf), -float(contact.dist))
    return tuple(sorted(depths, key=lambda name: -depths[name])[:max_count])
