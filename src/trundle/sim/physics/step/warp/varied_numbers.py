"""Numbers of a model of which a GPU holds a value for each world."""

import copy
from collections.abc import Iterator, Mapping, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from ...compile.compiled_world import CompiledWorld
from .limits import gpu_limits, gpu_model

GRAVITY = "opt.gravity"
_HELD = (
    "body_inertia", "body_invweight0", "body_ipos", "body_iquat", "body_mass", "body_pos", "body_quat",
    "body_subtreemass", "dof_armature", "dof_damping", "dof_frictionloss", "dof_invweight0", "geom_friction",
    "jnt_range", "jnt_stiffness", "pair_friction", "pair_solimp", "pair_solref", "pair_solreffriction", "qpos0",
    "qpos_spring", "tendon_invweight0", "tendon_length0", "tendon_lengthspring",
)  # fmt: skip
_PRESENT = ("dof_damping", "dof_frictionloss", "jnt_stiffness")
"""Fields of which zero and another number are different models."""
_PLACES = ("body_pos", "body_quat")
"""Fields of which Warp has one value for what is fixed to the world."""
_UNUSED = frozenset(
    {"actuator_acc0", "actuator_length0", "dof_M0", "names", "numeric_data", "paths", "tendon_frictionloss"}
)
"""Read by no step on a GPU, or written before each."""
_UNUSED_KINDS = ("cam_", "light_", "mat_", "site_", "skin_", "tex_")


def gpu_differences(first: CompiledWorld, other: CompiledWorld) -> list[str]:
    """Return why a GPU cannot step a world beside the first, a law or field of the model each; empty: it can."""
    ours, theirs = model_on_gpu(first), model_on_gpu(other)
    fields = [name for name, a, b in _unequal(ours, theirs) if not _is_held(ours, name, a, b)]
    return [*gpu_limits(other), *fields]


def model_on_gpu(compiled: CompiledWorld) -> mujoco.MjModel:
    """Return a copy of a world's model, in which nothing sleeps, as a GPU takes it."""
    model = copy.copy(compiled.model)
    gpu_model(model)
    return model


def varied_numbers(models: Sequence[mujoco.MjModel]) -> Mapping[str, NDArray[np.float64]]:
    """Return field → (worlds, …) values, where models that a GPU steps side by side are not equal."""
    first, *others = models
    varied = {name for other in others for name, *_ in _unequal(first, other)}
    held = {name: np.stack([getattr(model, name) for model in models]) for name in sorted(varied & set(_HELD))}
    if GRAVITY in varied:
        held[GRAVITY] = np.stack([model.opt.gravity for model in models])
    return held


def _is_held(first: mujoco.MjModel, name: str, a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    if name in _PLACES:
        fixed = first.body_weldid == 0
        return np.array_equal(a[fixed], b[fixed])
    if name in _PRESENT:
        return np.array_equal(a == 0, b == 0)
    return name in _HELD or name == GRAVITY


def _unequal(
    first: mujoco.MjModel, other: mujoco.MjModel
) -> Iterator[tuple[str, NDArray[np.float64], NDArray[np.float64]]]:
    """Yield the fields of the physics in which two models are not equal, with their values."""
    for prefix, one, two in (("", first, other), ("opt.", first.opt, other.opt)):
        for name in _fields(one):
            a, b = np.asarray(getattr(one, name)), np.asarray(getattr(two, name))
            if not np.array_equal(a, b):
                yield prefix + name, a, b


def _fields(owner: object) -> list[str]:
    return [
        name
        for name in dir(owner)
        if name[0] != "_" and name not in _UNUSED and not name.startswith(_UNUSED_KINDS)
        and isinstance(getattr(owner, name), int | float | np.ndarray)
    ]  # fmt: skip
