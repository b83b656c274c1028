"""Numbers of a model that a GPU stores for each world."""

import copy
from collections.abc import Iterator, Mapping, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from ...compile.compiled_world import CompiledWorld
from .limits import gpu_limits, gpu_model

GRAVITY = "opt.gravity"
_VARIABLE = (
    "body_inertia", "body_invweight0", "body_ipos", "body_iquat", "body_mass", "body_pos", "body_quat",
    "body_subtreemass", "dof_armature", "dof_damping", "dof_frictionloss", "dof_invweight0", "geom_friction",
    "jnt_range", "jnt_stiffness", "pair_friction", "pair_solimp", "pair_solref", "pair_solreffriction", "qpos0",
    "qpos_spring", "tendon_invweight0", "tendon_length0", "tendon_lengthspring",
)  # fmt: skip
_PRESENT = ("dof_damping", "dof_frictionloss", "jnt_stiffness")
"""Fields whose change between zero and another number makes a different model."""
_POSES = ("body_pos", "body_quat")
"""Fields of which Warp has one value for bodies fixed to the world."""
_UNUSED = frozenset(
    {"actuator_acc0", "actuator_length0", "dof_M0", "names", "numeric_data", "paths", "tendon_frictionloss"}
)
"""Read by no step on a GPU, or written before each."""
_UNUSED_KINDS = ("cam_", "light_", "mat_", "site_", "skin_", "tex_")


def gpu_differences(first: CompiledWorld, other: CompiledWorld) -> list[str]:
    """Return why a GPU cannot step a world with the first, as laws or fields of the model; empty: it can."""
    first_model, other_model = model_on_gpu(first), model_on_gpu(other)
    fields = [name for name, a, b in _unequal(first_model, other_model) if not _may_vary(first_model, name, a, b)]
    return [*gpu_limits(other), *fields]


def model_on_gpu(compiled: CompiledWorld) -> mujoco.MjModel:
    """Return a copy of a world's model for a GPU, in which nothing sleeps."""
    model = copy.copy(compiled.model)
    gpu_model(model)
    return model


def varied_numbers(models: Sequence[mujoco.MjModel]) -> Mapping[str, NDArray[np.float64]]:
    """Return field → (worlds, …) values of the fields that differ between models that a GPU steps together."""
    first, *others = models
    varied = {name for other in others for name, *_ in _unequal(first, other)}
    values = {name: np.stack([getattr(model, name) for model in models]) for name in sorted(varied & set(_VARIABLE))}
    if GRAVITY in varied:
        values[GRAVITY] = np.stack([model.opt.gravity for model in models])
    return values


def _may_vary(first: mujoco.MjModel, name: str, a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    if name in _POSES:
        fixed = first.body_weldid == 0
        return np.array_equal(a[fixed], b[fixed])
    if name in _PRESENT:
        return np.array_equal(a == 0, b == 0)
    return name in _VARIABLE or name == GRAVITY


def _unequal(
    first: mujoco.MjModel, other: mujoco.MjModel
) -> Iterator[tuple[str, NDArray[np.float64], NDArray[np.float64]]]:
    """Yield the fields of the physics in which two models are not equal, with their values."""
    for prefix, first_part, other_part in (("", first, other), ("opt.", first.opt, other.opt)):
        for name in _fields(first_part):
            a, b = np.asarray(getattr(first_part, name)), np.asarray(getattr(other_part, name))
            if not np.array_equal(a, b):
                yield prefix + name, a, b


def _fields(owner: object) -> list[str]:
    return [
        name
        for name in dir(owner)
        if name[0] != "_" and name not in _UNUSED and not name.startswith(_UNUSED_KINDS)
        and isinstance(getattr(owner, name), int | float | np.ndarray)
    ]  # fmt: skip
