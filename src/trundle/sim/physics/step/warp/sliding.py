"""Correction of sliding contacts on a GPU, as in `cpp/contact/contact_offset.cc`.

While a contact slides, its friction rows miss their references, and the friction cone lifts it by μ times the error.
Warp compiles these functions when they first run.
"""

import mujoco
import mujoco_warp
import numpy as np
import warp as wp
from numpy.typing import NDArray

from ...compile.law_tables import find_table

_ELLIPTIC = wp.constant(int(mujoco.mjtConstraint.mjCNSTR_CONTACT_ELLIPTIC))
_MIN_JUMP = wp.constant(0.01)
"""Smallest change of a motor's target that counts [rad/s or m/s]."""
_MIN_ROW_JUMP = wp.constant(0.02)
"""Smallest change of a contact's tangential velocity in one step that counts [m/s]."""
_MIN_SPEED = wp.constant(1e-6)
"""Smallest speed of sliding that counts [m/s]."""


@wp.struct
class Jacobian:
    """Jacobian of the constraint rows, dense or sparse."""

    is_sparse: bool
    width: int
    values: wp.array3d[float]
    counts: wp.array2d[int]
    firsts: wp.array2d[int]
    columns: wp.array3d[int]


@wp.struct
class Motors:
    """Motors of the worlds, a tendon each."""

    addresses: wp.array2d[int]
    """(tendons, 3) actuator, and addresses in qpos and qvel."""
    efforts: wp.array2d[float]
    """(worlds, tendons) largest effort."""
    rates: wp.array2d[float]
    """(worlds, tendons) position gain [1/s]; 0: speed motor."""
    last_targets: wp.array2d[float]
    """(worlds, actuators) target speeds of the last step."""


@wp.struct
class Loads:
    """Weights that rest on contacts."""

    gravity: float
    geom_trees: wp.array[int]
    """Kinematic tree of each geom; −1: the world."""
    tree_bodies: wp.array[int]
    """Root of each tree."""
    masses: wp.array2d[float]
    """(worlds or 1, bodies) mass of each body with its children [kg]."""
    invweights: wp.array2d[float]
    """(worlds or 1, nv)"""


@wp.struct
class Contacts:
    """Contacts of all worlds."""

    geoms: wp.array[wp.vec2i]
    rows: wp.array2d[int]
    sizes: wp.array[int]
    frictions: wp.array[mujoco_warp._src.types.vec5]
    solrefs: wp.array[wp.vec2]
    solreffrictions: wp.array[wp.vec2]
    solimps: wp.array[mujoco_warp._src.types.vec5]


@wp.func
def _element(jacobian: Jacobian, world: int, row: int, dof: int) -> float:
    if not jacobian.is_sparse:
        return jacobian.values[world, row, dof]
    for i in range(jacobian.counts[world, row]):
        at = jacobian.firsts[world, row] + i
        if jacobian.columns[world, 0, at] == dof:
            return jacobian.values[world, 0, at]
    return 0.0


@wp.func
def _product(jacobian: Jacobian, world: int, row: int, vector: wp.array2d[float]) -> float:
    total = wp.float32(0.0)
    if jacobian.is_sparse:
        for i in range(jacobian.counts[world, row]):
            at = jacobian.firsts[world, row] + i
            total += jacobian.values[world, 0, at] * vector[world, jacobian.columns[world, 0, at]]
    else:
        for dof in range(jacobian.width):
            total += jacobian.values[world, row, dof] * vector[world, dof]
    return total


@wp.func
def _spring(solref: wp.vec2, impedance: float) -> wp.vec2:
    """Return stiffness [1/s²] and damping [1/s] of a row, by MuJoCo's rules for solref."""
    if solref[0] > 0.0:
        time = impedance * solref[0]
        decay = time * solref[1]
        return wp.vec2(1.0 / wp.max(decay * decay, 1e-15), 2.0 / wp.max(time, 1e-15))
    return wp.vec2(-solref[0] / (impedance * impedance), -solref[1] / impedance)


@wp.func
def _trees(loads: Loads, geoms: wp.vec2i) -> wp.vec2i:
    first = loads.geom_trees[geoms[0]]
    second = loads.geom_trees[geoms[1]]
    return wp.vec2i(wp.min(first, second), wp.max(first, second))


@wp.func
def _holding_effort(
    contacts: Contacts, loads: Loads, jacobian: Jacobian, world: int, dof: int, count: int,
    kinds: wp.array2d[int], ids: wp.array2d[int],
) -> float:  # fmt: skip
    """Return twice the effort by which friction holds a degree of freedom [N·m or N], if the lighter of two trees rests
    on all of their contacts.
    """
    total = wp.float32(0.0)
    for row in range(count):
        at = ids[world, row]
        if kinds[world, row] == _ELLIPTIC and contacts.rows[at, 0] == row:
            pair = _trees(loads, contacts.geoms[at])
            points = wp.float32(0.0)
            for other in range(count):
                neighbour = ids[world, other]
                is_first = kinds[world, other] == _ELLIPTIC and contacts.rows[neighbour, 0] == other
                if is_first and _trees(loads, contacts.geoms[neighbour]) == pair:
                    points += 1.0
            mass = wp.float32(1e10)
            for i in range(2):
                if pair[i] >= 0:
                    mass = wp.min(mass, loads.masses[world % loads.masses.shape[0], loads.tree_bodies[pair[i]]])
            along = contacts.frictions[at][0] * _element(jacobian, world, contacts.rows[at, 1], dof)
            across = contacts.frictions[at][1] * _element(jacobian, world, contacts.rows[at, 2], dof)
            total += 2.0 * loads.gravity * mass / points * wp.sqrt(along * along + across * across)
    return total


@wp.kernel(enable_backward=False)
def predict(
    h: float,
    motors: Motors,
    loads: Loads,
    contacts: Contacts,
    jacobian: Jacobian,
    ctrl: wp.array2d[float],
    qpos: wp.array2d[float],
    qvel: wp.array2d[float],
    qacc: wp.array2d[float],
    nefc: wp.array[int],
    kinds: wp.array2d[int],
    ids: wp.array2d[int],
    predicted: wp.array2d[float],
    jumps: wp.array[int],
):
    """Predict this step's accelerations (worlds, nv): the last step's, changed for motors with new targets."""
    world = wp.tid()
    jumps[world] = 0
    for dof in range(qacc.shape[1]):
        predicted[world, dof] = qacc[world, dof]
    for motor in range(motors.addresses.shape[0]):
        actuator = motors.addresses[motor, 0]
        driven = motors.addresses[motor, 2]
        effort = motors.efforts[world, motor]
        last = motors.last_targets[world, actuator]
        motors.last_targets[world, actuator] = qvel[world, driven]
        if effort > 0.0:
            target = ctrl[world, actuator]
            if motors.rates[world, motor] > 0.0:
                target = motors.rates[world, motor] * (target - qpos[world, motors.addresses[motor, 1]])
            motors.last_targets[world, actuator] = target
            if wp.abs(target - last) >= _MIN_JUMP:
                held = _holding_effort(contacts, loads, jacobian, world, driven, nefc[world], kinds, ids)
                left = (effort - held) * loads.invweights[world % loads.invweights.shape[0], driven]
                if left > 0.0:
                    predicted[world, driven] = wp.clamp((target - qvel[world, driven]) / h, -left, left)
                    jumps[world] = 1


@wp.kernel(enable_backward=False)
def hold(
    h: float,
    contacts: Contacts,
    jacobian: Jacobian,
    qacc: wp.array2d[float],
    predicted: wp.array2d[float],
    jumps: wp.array[int],
    nefc: wp.array[int],
    kinds: wp.array2d[int],
    ids: wp.array2d[int],
    speeds: wp.array2d[float],
    references: wp.array2d[float],
):
    """Lower the reference accelerations of the normal rows of contacts that slide, or are about to."""
    world, row = wp.tid()
    if row >= nefc[world] or kinds[world, row] != _ELLIPTIC:
        return
    at = ids[world, row]
    if contacts.rows[at, 0] != row:
        return
    impedance = contacts.solimps[at][1]
    normal = _spring(contacts.solrefs[at], impedance)
    damping = normal[1]
    friction_solref = contacts.solreffrictions[at]
    if friction_solref[0] != 0.0 or friction_solref[1] != 0.0:
        damping = _spring(friction_solref, impedance)[1]
    slid, change, before, after = wp.float32(0.0), wp.float32(0.0), wp.float32(0.0), wp.float32(0.0)
    for j in range(1, contacts.sizes[at]):
        side = contacts.rows[at, j]
        speed = speeds[world, side]
        mu = contacts.frictions[at][j - 1]
        was = _product(jacobian, world, side, qacc)
        will = was
        if jumps[world] != 0:
            will = _product(jacobian, world, side, predicted)
        held = damping * speed / (1.0 + h * damping)
        slid += speed * speed
        change += h * h * (will - was) * (will - was)
        before += mu * mu * (was + held) * (was + held)
        after += mu * mu * (will + held) * (will + held)
    missed = before
    if change > _MIN_ROW_JUMP * _MIN_ROW_JUMP:
        missed = after
    elif slid <= _MIN_SPEED * _MIN_SPEED:
        return
    whole = 1.0 + h * normal[1] + h * h * normal[0] * impedance
    max_mu = wp.max(contacts.frictions[at][0], contacts.frictions[at][1])
    # At an impact, friction that the last step lacked holds with up to μ times the stopping force.
    impact = wp.max(-speeds[world, row], 0.0) * normal[1] / whole
    references[world, row] -= wp.max(wp.sqrt(missed) - max_mu * max_mu * impact, 0.0)


class Sliding:
    """Law for the worlds of a `GpuStepper`, as launches within a step."""

    def __init__(
        self, model: mujoco.MjModel, on_device: "mujoco_warp.Model", data: "mujoco_warp.Data", rates: "wp.array"
    ) -> None:
        """Bind the arrays on the current device.

        Args:
            model: model on the device, as MuJoCo's.
            on_device: model on the device.
            data: states on the device.
            rates: (worlds, tendons) position gains.
        """
        self._h = float(model.opt.timestep)
        self._data = data
        self.last_targets = wp.zeros((data.nworld, model.nu), dtype=float)
        """(worlds, actuators) target speeds of the last step."""
        self._motors = Motors()
        self._motors.addresses = wp.array(find_table(model, "motors")[:, [0, 2, 3]].astype(np.int32), dtype=int, ndim=2)
        self._motors.efforts, self._motors.rates = on_device.tendon_frictionloss, rates
        self._motors.last_targets = self.last_targets
        self._loads = Loads()
        self._loads.gravity = float(np.linalg.norm(model.opt.gravity))
        self._loads.geom_trees = _ints(model.body_treeid[model.geom_bodyid])
        self._loads.tree_bodies = _ints(model.tree_bodyadr)
        self._loads.masses, self._loads.invweights = on_device.body_subtreemass, on_device.dof_invweight0
        contact, efc = data.contact, data.efc
        self._contacts = Contacts()
        self._contacts.geoms, self._contacts.rows, self._contacts.sizes = contact.geom, contact.efc_address, contact.dim
        self._contacts.frictions, self._contacts.solimps = contact.friction, contact.solimp
        self._contacts.solrefs, self._contacts.solreffrictions = contact.solref, contact.solreffriction
        self._jacobian = Jacobian()
        self._jacobian.is_sparse, self._jacobian.width = bool(on_device.is_sparse), model.nv
        self._jacobian.values, self._jacobian.columns = efc.J, efc.J_colind
        self._jacobian.counts, self._jacobian.firsts = efc.J_rownnz, efc.J_rowadr
        self._predicted = wp.zeros((data.nworld, model.nv), dtype=float)
        self._jumps = wp.zeros(data.nworld, dtype=int)

    def launch(self) -> None:
        """Correct the references of this step, before the motors'."""
        data, efc = self._data, self._data.efc
        kinds = [data.nefc, efc.type, efc.id]
        state = [data.ctrl, data.qpos, data.qvel, data.qacc_warmstart]
        shared = [self._contacts, self._jacobian]
        wp.launch(
            predict,
            dim=data.nworld,
            inputs=[self._h, self._motors, self._loads, *shared, *state, *kinds],
            outputs=[self._predicted, self._jumps],
        )
        wp.launch(
            hold,
            dim=(data.nworld, data.njmax),
            inputs=[self._h, *shared, data.qacc_warmstart, self._predicted, self._jumps, *kinds, efc.vel],
            outputs=[efc.aref],
        )


def _ints(values: NDArray[np.int32]) -> "wp.array":
    return wp.array(values.astype(np.int32), dtype=int)
