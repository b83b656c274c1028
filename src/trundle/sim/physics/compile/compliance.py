"""Compliance of contacts: load sharing in statically indeterminate cases, and springs from kp and kd.

A rigid body on more contact points than it needs is statically indeterminate. As in ODE, every point is equally soft: a
wheel counts as two (its edges), a sphere as one, a box as its corners. MuJoCo's own contact stiffness scales with the
effective mass at the point, so the casters of a chassis would unload its wheels.
"""

import math
from collections.abc import Mapping, Sequence

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.model import Surface

from .contact_params import ContactParams
from .solver_settings import SOLIMP
from .wheels import TREAD_POINTS

_HARDEST = 0.999
"""Largest impedance of shared loads; a higher one costs the solver too many iterations."""
_DRIVEN = 0.8
"""Impedance at the heaviest link of a jointed tree.

`cpp/contact/contact_offset.cc` predicts a wheel's acceleration; its error over the softness 1 − d is an error of
the loads. With 0.99 the loads of a vehicle that begins to slide need 0.5 s to be shared, and light vehicles chatter. A
vehicle sinks in by 15 µm and creeps down 20° at 5 µm/s, both 20 times more than with 0.99.
"""
_SOFT = 0.01
"""Impedance of springs. MuJoCo adds d / (1 − d) of the effective mass at the contact, which slows oscillations."""
_HOLD = 2000.0
"""Damping of friction in soft contacts [1/h]: resting bodies creep as little as on a hard floor."""
_STIFFEST = 0.05
"""Stiffness over mass [1/h²] at which a step no longer resolves a spring, which is then a hard contact."""
_MIN_IMPLICIT = 0.01
"""Smallest implicit part of a spring's stiffness."""
_HARD = 1e11
"""Stiffness [N/m] from which on a contact is hard; SDF's default is 1e12."""
_UNCAPPED = 10.0
"""Speed [m/s] of depth correction from which on a spring's recoil counts as free."""
_SHALLOW = 5e-5
"""Static depth [m] up to which a contact of capped correction is hard, with a tree's whole weight on one point."""
_STIFFEST_HELD = 1.0
"""As `_STIFFEST` [1/h²], for pairs with a min_depth: up to it the contact yields as far as its stiffness allows."""


def is_soft(stiffness: float, inverse_mass: float, h: float, *, min_depth: float = 0.0) -> bool:
    """True if a time step resolves a contact of a stiffness [N/m] between masses (inverse, [1/kg]) as a spring."""
    stiffest = _STIFFEST if min_depth <= 0.0 else _STIFFEST_HELD
    return 0.0 < stiffness * inverse_mass * h * h < stiffest


def is_capped(max_vel: float) -> bool:
    """True if a speed of depth correction [m/s] stops a spring's recoil."""
    return max_vel < _UNCAPPED


def rest_depth(load: float, *, kp: float, kd: float, max_vel: float, h: float, gravity: float) -> float:
    """Return the depth [m] at which one contact point carries a load [N], by the rule of Gazebo's ODE.

    With erp = h kp / (h kp + kd) and cfm = 1 / (h kp + kd), ODE solves each step twice: for positions with a correction
    of erp · depth / h, and for velocities with at most max_vel; in both the points yield by cfm · force. At rest
    the position is constant; if max_vel − cfm · load is below 0, the velocity stays there, and the next step's
    correction cancels it: erp · depth / h = cfm (load − m u / h) for the mass m = load / g on the point and the
    velocity u.

    Args:
        load: force on the point [N].
        kp: stiffness [N/m].
        kd: damping [N·s/m].
        max_vel: largest speed of correction [m/s].
        h: time step [s].
        gravity: acceleration [m/s²].
    """
    sinking = load / (h * kp + kd) - max_vel
    return load / kp * (1.0 + sinking / (gravity * h) if sinking > 0.0 else 1.0)


def is_deep(weight: float, *, kp: float, kd: float, max_vel: float, h: float, gravity: float) -> bool:
    """True if a point of capped correction rests deep under a weight [N]; other arguments as of `rest_depth`."""
    if not 0.0 < kp < _HARD or weight <= 0.0:
        return False
    return rest_depth(weight, kp=kp, kd=kd, max_vel=max_vel, h=h, gravity=gravity) > _SHALLOW


def is_compliant(surface: Surface, mass: float, *, h: float, gravity: float) -> bool:
    """True if a surface yields under or on a body of a mass [kg], at a time step [s] and gravity [m/s²]."""
    limits = {"kp": surface.kp, "kd": max(surface.kd, 0.0), "max_vel": surface.max_vel}
    return is_soft(surface.kp, 1 / mass, h) or is_deep(mass * gravity, **limits, h=h, gravity=gravity)


def has_compliance(params: ContactParams, h: float) -> bool:
    """True if a pair has a min_depth, a capped correction, or a spring stiffer than `_spring` can express."""
    if params.kp >= _HARD:
        return params.min_depth > 0.0
    return params.min_depth > 0.0 or params.kd < h * params.kp or is_capped(params.max_vel)


def pair_name(a: str, b: str) -> str:
    """Return MuJoCo's name for a contact pair of two shapes."""
    return f"{a} {b}"


class ContactSpring(Struct, frozen=True):
    """Part of a pair's spring that a MuJoCo model cannot express; see `cpp/contact/contact_offset.h`."""

    factor: float = 1.0
    """Ratio of kp to the stiffness in the model."""
    rate: float = 0.0
    """erp / h [1/s] if the correction is capped, else 0."""
    max_vel: float = 0.0
    """[m/s]"""


def set_compliance(
    model: mujoco.MjModel, pair_params: Mapping[tuple[str, str], ContactParams]
) -> dict[tuple[int, int], ContactSpring]:
    """Set each pair's compliance from its kp and kd, or, for hard surfaces, from the compliance of its tree's contact
    points.

    Returns:
        Springs of the soft pairs, by pair of geoms.
    """
    softness = _tree_softness(model)
    springs: dict[tuple[int, int], ContactSpring] = {}
    h, gravity = model.opt.timestep, math.hypot(*model.opt.gravity)
    for (a, b), params in pair_params.items():
        geoms = int(model.geom(a).id), int(model.geom(b).id)
        bodies = [int(model.geom_bodyid[geom]) for geom in geoms]
        inverse_mass = float(sum(model.body_invweight0[body, 0] for body in bodies))
        pair = model.pair(pair_name(a, b)).id
        if _is_spring(params, inverse_mass, _weight(model, bodies), h, gravity):
            implicit = _implicit_stiffness(params, inverse_mass, h)
            rate = params.kp / (h * params.kp + params.kd) if is_capped(params.max_vel) else 0.0
            springs[geoms] = ContactSpring(params.kp / implicit, rate, params.max_vel)
            model.pair_solref[pair] = _spring(params, implicit, inverse_mass, h)
            model.pair_solimp[pair, :2] = _SOFT
            model.pair_solreffriction[pair] = (-1.0, -_SOFT * _HOLD / h)
        else:
            trees = [int(tree) for tree in model.body_treeid[bodies] if tree >= 0]
            if len(trees) == 1 and trees[0] in softness:
                softness_per_point = softness[trees[0]] / max(params.points, 1)
                model.pair_solimp[pair, :2] = min(1 - softness_per_point / inverse_mass, _HARDEST)
    return springs


def _is_spring(params: ContactParams, inverse_mass: float, weight: float, h: float, gravity: float) -> bool:
    """True if a pair is simulated as a spring; with a capped correction, if it has a min_depth or rests deep under a
    weight [N] on one point.
    """
    points = params.points if params.points >= 1 else TREAD_POINTS  # as for the tread
    capped, limits = is_capped(params.max_vel), {"kp": params.kp, "kd": params.kd, "max_vel": params.max_vel}
    if capped and is_deep(weight, **limits, h=h, gravity=gravity):
        return True
    oscillates_or_sinks = not capped or params.min_depth > 0.0
    return oscillates_or_sinks and is_soft(params.kp * points, inverse_mass, h, min_depth=params.min_depth)


def _weight(model: mujoco.MjModel, bodies: Sequence[int]) -> float:
    """Return the weight of the heavier tree of two bodies that are not fixed [N]."""
    roots = [int(model.body_rootid[body]) for body in bodies if model.body_weldid[body] != 0]
    masses = [float(model.body_subtreemass[root]) for root in roots]
    return max(masses, default=0.0) * math.hypot(*model.opt.gravity)


def _implicit_stiffness(params: ContactParams, inverse_mass: float, h: float) -> float:
    """Return the part of kp [N/m] that acts on the depth at the end of a step, and so damps by h times itself.

    More than kd / h would damp more than kd does. The rest acts on the depth at the start of the step, stable up to
    `_STIFFEST`. There is no rest for a pair with a min_depth, which does not oscillate, nor for a capped correction,
    which is damped as in ODE's step.
    """
    explicit = _STIFFEST / (inverse_mass * params.points * h * h)
    if params.min_depth > 0.0 or is_capped(params.max_vel):
        return params.kp
    return min(params.kp, max(params.kd / h, params.kp - explicit, _MIN_IMPLICIT * params.kp))


def _spring(params: ContactParams, implicit: float, inverse_mass: float, h: float) -> tuple[float, float]:
    """Return the solref by which a constraint of impedance d and inverse mass A exerts implicit · depth + kd · speed.

    Its force is (K d · depth + B · speed) / R with R = A (1 − d) / d, K = −solref₀ / d² and B = −solref₁ / d. MuJoCo
    uses the depth at the end of the step, so the spring itself damps by h times its stiffness.
    """
    scale = inverse_mass * (1 - _SOFT) * params.points
    damping = params.kd if is_capped(params.max_vel) else max(params.kd - h * implicit, 0.0)
    return -implicit * scale, -damping * scale


def _tree_softness(model: mujoco.MjModel) -> dict[int, float]:
    """Return A · (1 − d) of one contact point of each free tree, from the body with the smallest inverse weight.

    A load deepens a contact by the same factor, because its spring's stiffness contains 1 / d.
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
"""Degrees of freedom of a tree with a single body."""
