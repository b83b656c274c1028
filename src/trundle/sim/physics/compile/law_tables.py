"""Tables of contact laws in a compiled model, read by the C++ laws.

They are custom numerics of the model, so every copy of it carries them; `cpp/contact/law_tables.h` reads them row by
row.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.robots.model import Link, World
from trundle.spatial import ZERO

from .compliance import ContactSpring, has_compliance
from .contact_params import ContactParams, frictions_of
from .shape_entry import ShapeEntry

_WIDTHS = {
    "laws": 10,
    "restitution": 3,
    "friction": 10,
    "damping": 3,
    "motions": 11,
    "motors": 4,
    "chains": 2,
    "springs": 5,
    "compliance": 5,
    "geoms": 3,
}
"""Columns of each table.

"laws" is a single row: magic number; on (1), off (0) or friction only (-1); flag of moving surfaces; equality whose
parameters the motors use; used rows of "chains" and of "springs"; number of contact groups with slip or load-dependent
friction; address of the stepping data; speed at which `tunnelling` applies; 1 if shapes
without pairs have two frictions.
"""
_GROUP_WIDTH = 5
"""Numbers of a contact group in userdata: load, force in the world frame, torque."""
_MAGIC = 7.2751
_SLOWEST = 3.0
"""Speed in steps of free fall below which a contact rests and does not bounce."""
_MAX_SPRING = 0.25
"""Largest (ω h)² of a spring that is integrated by the midpoint rule, unstable from 4 on; MuJoCo damps stiffer ones."""
_MAX_DAMPER = 1.0
"""Largest c h / I of a damper that is integrated by the midpoint rule, which overshoots from 2 on; MuJoCo's rule, of
first order, never does.
"""
_STOP_MARGIN = 20.0
"""Speed [rad/s or m/s] up to which joints are stopped at a limit, not beyond; a limit's constraint costs time within
this speed times the step.
"""
_EQUALITY = "trundle::motor"
_MOTOR_SOLIMP = (0.9999, 0.9999, 0.001, 0.5, 2.0)
"""Stiffest impedance that MuJoCo allows."""
FREEDOMS = {mujoco.mjtJoint.mjJNT_FREE: 6, mujoco.mjtJoint.mjJNT_BALL: 3}
"""Degrees of freedom of the joint types with more than one."""
_Table: TypeAlias = NDArray[np.float64]
_Pair: TypeAlias = tuple[int, int, ContactParams]
PairParams: TypeAlias = Mapping[tuple[str, str], ContactParams]


def reserve_tables(
    spec: mujoco.MjSpec,
    bodies: Sequence[mujoco.MjsBody],
    pair_params: PairParams,
    shapes: Sequence[ShapeEntry],
    world: World,
) -> None:
    """Reserve the tables in a specification before it is compiled.

    Args:
        spec: all but the tables.
        bodies: its bodies, with the world's.
        pair_params: contact parameters by shape names.
        shapes: its geoms.
        world: world without nested models.
    """
    joints = [joint for body in bodies for joint in body.joints]
    motors = spec.actuators
    rows = {
        "laws": 1,
        "restitution": sum(map(_bounces, pair_params.values())),
        "friction": sum(map(_has_friction, pair_params.values())),
        "damping": sum(map(_has_velocity_decay, _links(world))),
        "motions": len(bodies),
        "motors": len(motors),
        "chains": len(bodies),
        "springs": len(joints),
        "compliance": sum(has_compliance(params, spec.option.timestep) for params in pair_params.values()),
        "geoms": len(shapes),
    }
    for name, width in _WIDTHS.items():
        # MuJoCo does not allow an empty numeric; less than a row counts as none.
        size = max(rows[name] * width, 1)
        spec.add_numeric(name=f"trundle::{name}", data=[0.0] * size, size=size)
    # userdata: the target speed of each motor, a flag of each degree of freedom, the sums of each contact group.
    freedoms = sum(FREEDOMS.get(joint.type, 1) for joint in joints)
    groups = len(bodies) + len(set(_groups(pair_params, shapes).values()))
    spec.nuserdata = len(motors) + freedoms + _GROUP_WIDTH * groups
    _reserve_motors(spec, motors)
    # Sensor that makes MuJoCo call mjcb_sensor; see `set_needstage`.
    stage = mujoco.mjtStage.mjSTAGE_POS
    spec.add_sensor(name="trundle::laws", type=mujoco.mjtSensor.mjSENS_USER, dim=1, needstage=stage)


def _reserve_motors(spec: mujoco.MjSpec, motors: Sequence[mujoco.MjsActuator]) -> None:
    """Add a tendon per motor, whose frictionloss is the motor's torque limit, and an inactive equality."""
    for motor in motors:
        tendon = spec.add_tendon(name=motor.name)
        tendon.wrap_joint(motor.target, 1.0)
        tendon.solimp_friction = _MOTOR_SOLIMP
    if motors:
        equality = spec.add_equality(name=_EQUALITY, type=mujoco.mjtEq.mjEQ_JOINT, name1=motors[0].target)
        equality.objtype, equality.active = mujoco.mjtObj.mjOBJ_JOINT, False
        equality.solref, equality.solimp = (-1.0, -1.0 / spec.option.timestep), _MOTOR_SOLIMP


def find_table(model: mujoco.MjModel, name: str) -> _Table:
    """Return a (rows, width) table of a compiled model, as a writable view."""
    number = list(_WIDTHS).index(name)
    first, size, width = int(model.numeric_adr[number]), int(model.numeric_size[number]), _WIDTHS[name]
    return model.numeric_data[first : first + size // width * width].reshape(-1, width)


def fill_tables(
    model: mujoco.MjModel,
    pair_params: PairParams,
    shapes: Sequence[ShapeEntry],
    bodies: Sequence[int],
    world: World,
    contact_springs: Mapping[tuple[int, int], ContactSpring],
) -> None:
    """Write the tables of a compiled model.

    Args:
        model: compiled model.
        pair_params: contact parameters by shape names.
        shapes: all shapes.
        bodies: body id of each link, in the order of the world's links.
        world: without nested models.
        contact_springs: springs of the soft pairs, from `set_compliance`.
    """
    equality = model.equality(_EQUALITY).id if model.nu else -1
    named = _groups(pair_params, shapes)
    groups = {_key(model, int(model.geom(a).id), int(model.geom(b).id)): n for (a, b), n in named.items()}
    count = len(set(groups.values()))
    find_table(model, "laws")[0] = _MAGIC, 1.0, 0.0, equality, 0.0, 0.0, count, 0.0, 0.0, 0.0
    pairs = [(int(model.geom(a).id), int(model.geom(b).id), params) for (a, b), params in pair_params.items()]
    pairs.sort(key=lambda pair: _key(model, pair[0], pair[1]))
    _write(model, "restitution", _restitution(model, pairs))
    _write(model, "friction", _friction(model, pairs, groups))
    set_needstage(model, solved=bool(groups))
    _write(model, "damping", _damping(model, bodies, world))
    for motor, row in enumerate(find_table(model, "motors")):
        joint = model.actuator_trnid[motor, 0]
        row[:] = motor, 0.0, model.jnt_qposadr[joint], model.jnt_dofadr[joint]
    _fill_midpoint_tables(model)
    model.jnt_margin[model.jnt_limited > 0] = _STOP_MARGIN * model.opt.timestep
    _write(model, "compliance", _compliance(model, pairs, contact_springs))
    _write_geoms(model, shapes)


def _write_geoms(model: mujoco.MjModel, shapes: Sequence[ShapeEntry]) -> None:
    """Write each geom's body, as fixed shapes may belong to the world, and the friction of those without pairs."""
    geoms, head = find_table(model, "geoms"), find_table(model, "laws")[0]
    for shape in shapes:
        geom = int(model.geom(shape.name).id)
        is_searched = model.geom_contype[geom] or model.geom_conaffinity[geom]
        frictions = frictions_of(shape.surface) if is_searched else (0.0, 0.0)
        geoms[geom] = model.body(shape.link).id, *frictions
        head[9] = max(head[9], float(frictions[0] != frictions[1]))


def velocity_times(model: mujoco.MjModel, data: mujoco.MjData) -> NDArray[np.float64]:
    """Return the time of each degree of freedom's velocity, (nv,), as a writable view.

    See `cpp/contact/midpoint.h`.
    """
    return data.userdata[model.nu : model.nu + model.nv]


def set_needstage(model: mujoco.MjModel, *, solved: bool) -> None:
    """Set the stage at which MuJoCo calls mjcb_sensor; after the solver it costs an extra pass over all bodies."""
    model.sensor_needstage[0] = mujoco.mjtStage.mjSTAGE_ACC if solved else mujoco.mjtStage.mjSTAGE_POS


def _fill_midpoint_tables(model: mujoco.MjModel) -> None:
    """List the jointed trees, and move soft springs and half of each soft damper from MuJoCo to the midpoint rule."""
    head, chains, springs = (find_table(model, name) for name in ("laws", "chains", "springs"))
    chained = [tree for tree in range(model.ntree) if not _is_lone(model, tree)]
    for row, tree in zip(chains, chained, strict=False):
        row[:] = tree, not _has_free_root(model, tree)
    soft = [joint for joint in range(model.njnt) if _has_soft_spring(model, joint) or _has_soft_damper(model, joint)]
    for row, joint in zip(springs, soft, strict=False):
        dof, qpos = int(model.jnt_dofadr[joint]), int(model.jnt_qposadr[joint])
        row[:] = dof, qpos, 0.0, model.qpos_spring[qpos], 0.0
        if _has_soft_spring(model, joint):
            row[2], model.jnt_stiffness[joint] = model.jnt_stiffness[joint], 0.0
        if _has_soft_damper(model, joint):
            row[4] = model.dof_damping[dof] = model.dof_damping[dof] / 2
    head[0, 4:6] = len(chained), len(soft)


def restore_springs(model: mujoco.MjModel) -> None:
    """Return soft springs and dampers from the midpoint rule to MuJoCo."""
    rows = find_table(model, "springs")[: int(find_table(model, "laws")[0, 5])]
    dofs = rows[:, 0].astype(np.intp)
    model.jnt_stiffness[model.dof_jntid[dofs]] += rows[:, 2]
    model.dof_damping[dofs] += rows[:, 4]


def _has_free_root(model: mujoco.MjModel, tree: int) -> bool:
    return bool(model.jnt_type[model.dof_jntid[model.tree_dofadr[tree]]] == mujoco.mjtJoint.mjJNT_FREE)


def _is_lone(model: mujoco.MjModel, tree: int) -> bool:
    """True if a tree is a single free body, whose gyroscopic forces MuJoCo integrates implicitly."""
    return _has_free_root(model, tree) and bool(model.tree_dofnum[tree] == 6)


def _has_soft_spring(model: mujoco.MjModel, joint: int) -> bool:
    """True if a joint has a spring soft enough for the midpoint rule."""
    inverse_inertia = float(model.dof_invweight0[model.jnt_dofadr[joint]])
    return 0.0 < model.jnt_stiffness[joint] * inverse_inertia * model.opt.timestep**2 < _MAX_SPRING


def _has_soft_damper(model: mujoco.MjModel, joint: int) -> bool:
    """True if a joint has a damper soft enough for the midpoint rule."""
    dof = int(model.jnt_dofadr[joint])
    return bool(0.0 < model.dof_damping[dof] * model.dof_invweight0[dof] * model.opt.timestep < _MAX_DAMPER)


def disable_laws(model: mujoco.MjModel) -> None:
    """Disable the laws in a copy of a model."""
    find_table(model, "laws")[0, 1] = 0.0
    model.jnt_margin[:] = 0.0


def copy_friction_laws(model: mujoco.MjModel, other: mujoco.MjModel) -> None:
    """Set a copy that evaluates states to friction laws only, with another model's current tables."""
    model.numeric_data[:] = other.numeric_data
    find_table(model, "laws")[0, 1] = -1.0
    model.flg_surfacevel = other.flg_surfacevel
    model.sensor_needstage[0] = other.sensor_needstage[0]


def _write(model: mujoco.MjModel, name: str, rows: Iterator[tuple[float, ...]]) -> None:
    for target, row in zip(find_table(model, name), rows, strict=True):
        target[:] = row


def _key(model: mujoco.MjModel, a: int, b: int) -> int:
    return min(a, b) * int(model.ngeom) + max(a, b)


def _bounces(params: ContactParams) -> bool:
    return params.restitution > 0 and params.has_force


def _has_friction(params: ContactParams) -> bool:
    return _is_anisotropic(params) or _needs_group(params)


def has_row(params: ContactParams, h: float) -> tuple[bool, bool, bool, bool]:
    """Return if a pair has a row in the tables restitution, friction and compliance, and if it has a contact group."""
    return _bounces(params), _has_friction(params), has_compliance(params, h), _needs_group(params)


def _needs_group(params: ContactParams) -> bool:
    """True if the pair slips or its friction depends on the load."""
    return params.mu + params.mu2 > 0 and (any(params.slip) or params.patch > 0)


def _groups(pair_params: PairParams, shapes: Sequence[ShapeEntry]) -> dict[tuple[str, str], int]:
    """Return the contact group of each pair of shapes that slips or depends on the load; one group per pair of
    collisions.
    """
    collision_of = {shape.name: shape.collision for shape in shapes}
    numbers: dict[tuple[str, str], int] = {}
    grouped = [pair for pair, params in pair_params.items() if _needs_group(params)]
    return {(a, b): numbers.setdefault((collision_of[a], collision_of[b]), len(numbers)) for a, b in grouped}


def _is_anisotropic(params: ContactParams) -> bool:
    return params.mu != params.mu2 and min(params.mu, params.mu2) > 0


def _has_velocity_decay(link: Link) -> bool:
    return link.linear_decay > 0 or link.angular_decay > 0


def _links(world: World) -> Iterator[Link]:
    return (link for model in world.models for link in model.links)


def _restitution(model: mujoco.MjModel, pairs: Sequence[_Pair]) -> Iterator[tuple[float, ...]]:
    slowest = _SLOWEST * math.hypot(*model.opt.gravity) * model.opt.timestep
    for a, b, params in pairs:
        if _bounces(params):
            yield _key(model, a, b), params.restitution, max(params.threshold, slowest)


def _friction(model: mujoco.MjModel, pairs: Sequence[_Pair], groups: Mapping[int, int]) -> Iterator[tuple[float, ...]]:
    for a, b, params in pairs:
        if _has_friction(params):
            key = _key(model, a, b)
            geom = -1 if params.fdir1 == ZERO else (a, b)[params.fdir1_shape]
            yield key, geom, *params.fdir1, *params.slip, params.patch, groups.get(key, -1)


def _compliance(
    model: mujoco.MjModel, pairs: Sequence[_Pair], contact_springs: Mapping[tuple[int, int], ContactSpring]
) -> Iterator[tuple[float, ...]]:
    for a, b, params in pairs:
        if has_compliance(params, model.opt.timestep):
            spring = contact_springs.get((a, b), ContactSpring())
            yield _key(model, a, b), params.min_depth, spring.factor, spring.rate, spring.max_vel


def _damping(model: mujoco.MjModel, bodies: Sequence[int], world: World) -> Iterator[tuple[float, ...]]:
    """ContactSpring damping rows; a link without degrees of freedom refers to the world body, which never moves."""
    for body, link in zip(bodies, _links(world), strict=True):
        if _has_velocity_decay(link):
            parts = (min(max(part, 0.0), 1.0) for part in (link.linear_decay, link.angular_decay))
            yield body if model.body_dofnum[body] > 0 else 0, *parts
