"""Compliance of contacts: how a load is shared where statics alone does not say, and springs as a file has them.

A rigid body on more points than it needs may be carried in many ways. As in ODE, every point is equally soft: a wheel
counts as two, its edges, a sphere as one, a box as its corners. MuJoCo's own contacts are as stiff as what they carry
is heavy to move there, so that the casters of a chassis would take the load off its wheels.
"""

from collections.abc import Mapping

import mujoco
import numpy as np
from numpy.typing import NDArray

from .contact_params import ContactParams
from .solver_settings import SOLIMP

_HARDEST = 0.999
"""Impedance that shared loads may ask for: beyond, the solver takes more steps than that is worth."""
_DRIVEN = 0.8
"""Impedance at the heaviest link of what has joints. As far as `cpp/contact_offset.cc` foresees a wheel's acceleration
wrongly, loads are off by the error over this softness: on 0.99 the loads of what begins to slide take 0.5 s to be
shared, and light vehicles chatter. A vehicle sinks in by 15 µm, and creeps down 20° at 5 µm/s, both 20 times more.
"""
_SOFT = 0.01
"""Impedance of springs. MuJoCo adds d / (1 − d) of the mass that a contact moves to it, which slows its swings."""
_HOLD = 2000.0
"""[1/h] Damping of friction in what is soft: what rests creeps as little as on a hard floor."""
_STIFFEST = 0.05
"""[1/h²] Stiffness over mass from which on a step cannot tell a spring from a hard contact."""
_STIFFEST_HELD = 1.0
"""[1/h²] The same of what may be deep: up to its min_depth it gives way as fast as its stiffness lets it."""


def is_soft(stiffness: float, inverse_mass: float, h: float, *, min_depth: float = 0.0) -> bool:
    """Whether a step can tell a contact of some stiffness [N/m] between masses (inverse, [1/kg]) from a hard one."""
    stiffest = _STIFFEST if min_depth <= 0.0 else _STIFFEST_HELD
    return 0.0 < stiffness * inverse_mass * h * h < stiffest


def pair_name(a: str, b: str) -> str:
    """The engine's name for two shapes that may touch."""
    return f"{a} {b}"


def set_compliance(model: mujoco.MjModel, pair_params: Mapping[tuple[str, str], ContactParams]) -> None:
    """Make each pair as soft as its surfaces are, or, where those are hard, as all points of what stands on them."""
    softness = _tree_softness(model)
    for (a, b), params in pair_params.items():
        bodies = [int(model.geom_bodyid[model.geom(name).id]) for name in (a, b)]
        inverse_mass = float(sum(model.body_invweight0[body, 0] for body in bodies))
        pair = model.pair(pair_name(a, b)).id
        h = model.opt.timestep
        if is_soft(params.kp * params.points, inverse_mass, h, min_depth=params.min_depth):
            model.pair_solref[pair] = _spring(params, inverse_mass, h)
            model.pair_solimp[pair, :2] = _SOFT
            model.pair_solreffriction[pair] = (-1.0, -_SOFT * _HOLD / h)
        else:
            trees = [int(tree) for tree in model.body_treeid[bodies] if tree >= 0]
            if len(trees) == 1 and trees[0] in softness:
                share = softness[trees[0]] / params.points
                model.pair_solimp[pair, :2] = min(1 - share / inverse_mass, _HARDEST)


def _spring(params: ContactParams, inverse_mass: float, h: float) -> tuple[float, float]:
    """The solref by which a constraint of impedance d and inverse mass A pushes with kp · depth + kd · speed.

    Its force is (K d · depth + B · speed) / R with R = A (1 − d) / d, K = −solref₀ / d² and B = −solref₁ / d. As it
    is the depth at the step's end, a spring damps by h · kp, too.
    """
    reach = inverse_mass * (1 - _SOFT) * params.points
    return -params.kp * reach, -max(params.kd - h * params.kp, 0.0) * reach


def _tree_softness(model: mujoco.MjModel) -> dict[int, float]:
    """A · (1 − d) of one point of each tree that stands free, by the body that is heaviest to move.

    A load presses a contact in by as much, for its spring's stiffness has a 1 / d, too.
    """
    free = {int(model.body_treeid[model.jnt_bodyid[j]]) for j in np.flatnonzero(model.jnt_type == _FREE)}
    weights: NDArray[np.float64] = model.body_invweight0[:, 0]
    hardest: dict[int, float] = {}
    for body in range(1, model.nbody):
        tree = int(model.body_treeid[body])
        if tree in free and weights[body] > 0:
            hardest[tree] = min(hardest.get(tree, np.inf), float(weights[body]))
    impedances = {tree: SOLIMP[0] if model.tree_dofnum[tree] == _LONE else _DRIVEN for tree in hardest}
    return {tree: (1 - impedances[tree]) * weight for tree, weight in hardest.items()}


_FREE = int(mujoco.mjtJoint.mjJNT_FREE)
_LONE = 6
"""Freedoms of a tree that is a single body."""
