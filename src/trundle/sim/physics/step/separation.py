"""Depenetration of initial overlaps, at once and without velocity.

Gazebo's ODE corrects depth separately from velocity: a body that begins 5 cm deep is out after 10 ms, at rest. MuJoCo's
contacts would eject it. So after a reset, a spawn or a teleport, bodies are displaced until none is deep, as little as
their masses and joints allow; their velocities stay.
"""

import copy

import mujoco
import numpy as np
from numpy.typing import NDArray

from ..compile.law_tables import find_table

DEEP = 3e-4
"""Depth [m] from which a contact would accelerate a body to more than 1 cm/s, at steps of 1 ms."""
_ENOUGH = DEEP / 10
_HEAVY = 3.0
"""Factor on the supported weight: a soft contact is deep beyond three times its static depth."""
_PASSES = 100
_EAGER = (0.2, 1.6)
"""solref [h, 1] that removes most of a depth in one step from rest."""
_NEVER = (-1e-9, -1e-9)
"""solref without effect."""
_OFF = (
    mujoco.mjtDisableBit.mjDSBL_GRAVITY,
    mujoco.mjtDisableBit.mjDSBL_ACTUATION,
    mujoco.mjtDisableBit.mjDSBL_SPRING,
    mujoco.mjtDisableBit.mjDSBL_DAMPER,
    mujoco.mjtDisableBit.mjDSBL_FRICTIONLOSS,
    mujoco.mjtDisableBit.mjDSBL_WARMSTART,
    mujoco.mjtDisableBit.mjDSBL_ISLAND,
    mujoco.mjtDisableBit.mjDSBL_REFSAFE,
)


def find_deep(model: mujoco.MjModel, data: mujoco.MjData) -> NDArray[np.bool_]:
    """Return (contacts,) mask of the contacts deeper than their static depth."""
    return (data.contact.efc_address >= 0) & (_depths(data) > DEEP + _rest_depths(model, data))


def separate(model: mujoco.MjModel, data: mujoco.MjData) -> NDArray[np.float64]:
    """Return qpos (nq,) with the data's deep contacts resolved as far as possible."""
    deep = find_deep(model, data)
    geoms = np.sort(data.contact.geom[deep].astype(np.int64), axis=1)
    model_without_forces = _without_forces(model, {(a, b) for a, b in geoms.tolist()})
    moved = mujoco.MjData(model_without_forces)
    moved.qpos[:] = data.qpos
    for _ in range(_PASSES):
        mujoco.mj_step(model_without_forces, moved)
        moved.qvel[:] = 0.0
        if not np.isfinite(moved.qpos).all():
            return data.qpos.copy()
        acting = (moved.contact.efc_address >= 0) & (moved.contact.solref[:, 0] > 0.0)
        if float(_depths(moved)[acting].max(initial=0.0)) < _ENOUGH:  # the contacts are those from before that step
            break
    return moved.qpos.copy()


def _depths(data: mujoco.MjData) -> NDArray[np.float64]:
    return data.contact.includemargin - data.contact.dist


@np.errstate(over="ignore", invalid="ignore")  # extreme masses and gravity overflow to an infinite depth
def _rest_depths(model: mujoco.MjModel, data: mujoco.MjData) -> NDArray[np.float64]:
    """Return (contacts,) static depth of soft contacts under the whole tree's weight [m]; 0 for hard ones. See
    `compliance`.

    If correction is capped, the weight is divided by the number of contacts, as depth grows by its square.
    """
    contacts = data.contact
    bodies = model.geom_bodyid[contacts.geom]
    fixed = model.body_weldid[bodies] == 0
    roots = np.where(fixed, 0, model.body_rootid[bodies])
    masses = np.where(fixed, 0.0, model.body_subtreemass[roots]).max(axis=1)
    stiffnesses = -contacts.solref[:, 0] / np.maximum(model.body_invweight0[bodies, 0].sum(axis=1), 1e-12)
    gravity = float(np.linalg.norm(model.opt.gravity))
    compliance = _compliant_pairs(model)
    geoms = np.sort(contacts.geom, axis=1).tolist()
    rows = np.array([compliance.get((a, b), _PLAIN) for a, b in geoms]).reshape(-1, 4)
    depths, factors, rates, max_vels = rows.T
    counts = np.bincount(roots.max(axis=1), minlength=model.nbody)[roots.max(axis=1)]
    weights = _HEAVY * masses * gravity / np.where(rates > 0.0, counts, 1)
    springs = np.where(stiffnesses > 0.0, weights / np.maximum(stiffnesses * factors, 1e-12), 0.0)
    sinking = np.maximum(rates * springs - max_vels, 0.0) / max(gravity * model.opt.timestep, 1e-12)
    return depths + np.where(rates > 0.0, springs * (1.0 + sinking), springs)


_PLAIN = (0.0, 1.0, 0.0, 0.0)
"""Row of `_compliant_pairs` for all other pairs."""


def _compliant_pairs(model: mujoco.MjModel) -> dict[tuple[int, int], tuple[float, ...]]:
    """Return min_depth [m], factor of stiffness, rate [1/s] and max_vel [m/s] of the pairs of geoms that have them."""
    rows = find_table(model, "compliance").tolist()
    return {(int(key) // model.ngeom, int(key) % model.ngeom): tuple(row) for key, *row in rows}


def _without_forces(model: mujoco.MjModel, deep: set[tuple[int, int]]) -> mujoco.MjModel:
    """Return a copy of the model without forces other than contacts."""
    copied = copy.copy(model)
    copied.opt.gravity[:] = 0.0
    copied.opt.enableflags = 0
    for flag in _OFF:
        copied.opt.disableflags |= flag
    copied.pair_dim[:] = copied.geom_condim[:] = 1
    eager = (_EAGER[0] * model.opt.timestep, _EAGER[1])
    copied.geom_solref[:] = eager
    with_min_depth = {pair for pair, (depth, *_) in _compliant_pairs(model).items() if depth > 0.0}
    for i, geoms in enumerate(zip(model.pair_geom1.tolist(), model.pair_geom2.tolist(), strict=True)):
        pair = (min(geoms), max(geoms))
        is_soft = model.pair_solref[i, 0] < 0.0 or pair in with_min_depth
        copied.pair_solref[i] = _NEVER if is_soft and pair not in deep else eager
    return copied
