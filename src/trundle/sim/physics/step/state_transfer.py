"""Transfer of state between two compiled worlds, matched by name."""

from collections.abc import Callable, Iterator, Mapping
from typing import Protocol

import mujoco

from ..compile.law_tables import find_table, velocity_times

_ON = " on "
_POSITIONS = {int(mujoco.mjtJoint.mjJNT_FREE): 7, int(mujoco.mjtJoint.mjJNT_BALL): 4}
_SPEEDS = {int(mujoco.mjtJoint.mjJNT_FREE): 6, int(mujoco.mjtJoint.mjJNT_BALL): 3}


def transfer_state(
    old: tuple[mujoco.MjModel, mujoco.MjData], new: tuple[mujoco.MjModel, mujoco.MjData], renamed: Mapping[str, str]
) -> list[tuple[int, int]]:
    """Copy positions, velocities, efforts, motors and wrenches exactly; the time continues.

    Return the old and new index of each motor in both.

    Args:
        old: source.
        new: target.
        renamed: renamed models, old name → new name.
    """
    (old_model, old_data), (new_model, new_data) = old, new
    new_data.time = old_data.time
    old_times, new_times = velocity_times(old_model, old_data), velocity_times(new_model, new_data)
    for a, b in _matches(_names(old_model.njnt, old_model.joint, renamed), _names(new_model.njnt, new_model.joint)):
        kind = int(new_model.jnt_type[b])
        if kind != int(old_model.jnt_type[a]):
            continue
        p, q = int(old_model.jnt_qposadr[a]), int(new_model.jnt_qposadr[b])
        n = _POSITIONS.get(kind, 1)
        new_data.qpos[q : q + n] = old_data.qpos[p : p + n]
        p, q = int(old_model.jnt_dofadr[a]), int(new_model.jnt_dofadr[b])
        n = _SPEEDS.get(kind, 1)
        for name in ("qvel", "qacc_warmstart", "qfrc_applied", "qfrc_actuator"):
            getattr(new_data, name)[q : q + n] = getattr(old_data, name)[p : p + n]
        new_times[q : q + n] = old_times[p : p + n]
    old_rates, new_rates = (find_table(model, "motors")[:, 1] for model in (old_model, new_model))
    old_names, new_names = _names(old_model.nu, old_model.actuator, renamed), _names(new_model.nu, new_model.actuator)
    actuators = list(_matches(old_names, new_names))
    for a, b in actuators:
        new_data.ctrl[b] = old_data.ctrl[a]
        new_model.tendon_frictionloss[b] = old_model.tendon_frictionloss[a]
        new_rates[b] = old_rates[a]
    for a, b in _matches(_names(old_model.nbody, old_model.body, renamed), _names(new_model.nbody, new_model.body)):
        new_data.xfrc_applied[b] = old_data.xfrc_applied[a]
    return actuators


class _Named(Protocol):
    @property
    def name(self) -> str: ...


def _names(count: int, view: Callable[[int], _Named], renamed: Mapping[str, str] | None = None) -> list[str]:
    """Return names `model::part`, or `model::part on model::joint` for the parts of links that close a loop."""
    names = [view(i).name for i in range(count)]
    for old, new in (renamed or {}).items():
        parts = [name.split(_ON) for name in names]
        names = [_ON.join(_renamed(part, f"{old}::", f"{new}::") for part in name_parts) for name_parts in parts]
    return names


def _renamed(name: str, old: str, new: str) -> str:
    return new + name.removeprefix(old) if name.startswith(old) else name


def _matches(old: list[str], new: list[str]) -> Iterator[tuple[int, int]]:
    """Yield index pairs of equal names."""
    numbers = {name: i for i, name in enumerate(old)}
    for i, name in enumerate(new):
        if name in numbers:
            yield numbers[name], i
