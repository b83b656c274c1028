"""Laws of a compiled world that exist in C++ only, so that a GPU cannot step it."""

from collections.abc import Iterator

import mujoco
import numpy as np

from ...compile.compiled_world import CompiledWorld
from ...compile.law_tables import find_table, restore_springs

_MAX_NAMES = 3
"""Maximum number of names in a sentence."""
_MARGIN = 1e-5
"""Smallest distance of a contact [m]; single precision resolves 4 µm at 50 m."""


def gpu_limits(compiled: CompiledWorld) -> list[str]:
    """Return the reasons why a GPU cannot step a world, a sentence each; none if it can."""
    return list(_limits(compiled))


def _limits(compiled: CompiledWorld) -> Iterator[str]:
    friction = find_table(compiled.model, "friction")
    slips, patches = friction[:, 5:8].any(axis=1), friction[:, 8] > 0.0
    anisotropic = ~slips & ~patches
    compliance = find_table(compiled.model, "compliance")
    compliant = (compliance[:, 1:4] != (0.0, 1.0, 0.0)).any(axis=1)
    pairs = (
        ("bounce (<restitution_coefficient>)", find_table(compiled.model, "restitution")[:, 0]),
        ("slip under load (<slip1>, <slip2>)", friction[slips, 0]),
        ("have friction about the normal that grows with the load (<torsional>)", friction[patches & ~slips, 0]),
        ("have two different frictions (<mu>, <mu2>)", friction[anisotropic, 0]),
        ("yield (<min_depth>, <max_vel>, <kp>, <kd>)", compliance[compliant, 0]),
    )
    for law, keys in pairs:
        if len(keys):
            yield f"contacts {law}: {_names([_pair(compiled, key) for key in keys.astype(int).tolist()])}"
    if find_table(compiled.model, "laws")[0, 9] > 0.0:
        yield "shapes of a crowded world have two different frictions (<mu>, <mu2>)"
    damped = find_table(compiled.model, "damping")[:, 0]
    links = [name for name, body in zip(compiled.link_names, compiled.link_bodies, strict=True) if body in damped]
    if links:
        yield f"links lose a part of their speed at each step (<velocity_decay>): {_names(links)}"


def _pair(compiled: CompiledWorld, key: int) -> str:
    first, second = divmod(key, int(compiled.model.ngeom))
    return f"{compiled.geom_collisions[first]} with {compiled.geom_collisions[second]}"


def _names(names: list[str]) -> str:
    unique = list(dict.fromkeys(names))
    more = f" and {len(unique) - _MAX_NAMES} more" if len(unique) > _MAX_NAMES else ""
    return ", ".join(unique[:_MAX_NAMES]) + more


def gpu_model(model: mujoco.MjModel) -> None:
    """Adapt a copy of a model, in which nothing sleeps, to MuJoCo on Warp.

    Soft springs and dampers return from the midpoint rule to MuJoCo; the flags against resets and for thin bodies have
    no effect. Margins grow, because single precision misses shapes that just touch.
    """
    option, disabled = model.opt, mujoco.mjtDisableBit
    model.tree_sleep_policy[:] = int(mujoco.mjtSleepPolicy.mjSLEEP_AUTO_NEVER)
    option.disableflags &= ~int(disabled.mjDSBL_AUTORESET | disabled.mjDSBL_ACTUATION)
    option.disableflags |= int(disabled.mjDSBL_SENSOR)
    option.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)
    for margins in (model.pair_margin, model.geom_margin):
        margins[:] = np.maximum(margins, _MARGIN)
    restore_springs(model)
