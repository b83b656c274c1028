"""Contacts of the last step."""

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.spatial import Vector3, Wrench

from ..compile.compiled_world import CompiledWorld


class Contact(Struct, frozen=True, kw_only=True):
    """Contact point of two collisions."""

    collisions: tuple[str, str]
    """`model::link::collision` of both."""
    position: Vector3
    """Position in the world [m]."""
    normal: Vector3
    """Unit normal from the first into the second, world axes."""
    depth: float
    """Penetration depth [m]."""
    force: Wrench
    """Wrench of the first on the second at this point, world axes."""


def contacts_of(
    compiled: CompiledWorld, model: mujoco.MjModel, data: mujoco.MjData, chosen: NDArray[np.intp]
) -> list[Contact]:
    """Return the contacts of the given indices."""
    if not len(chosen):
        return []
    held = data.contact
    wrenches = np.empty((len(chosen), 6))
    for i, wrench in zip(chosen.tolist(), wrenches, strict=True):
        mujoco.mj_contactForce(model, data, i, wrench)
    frames = held.frame[chosen].reshape(-1, 3, 3)
    forces, torques = (np.einsum("nji,nj->ni", frames, part) for part in (wrenches[:, :3], wrenches[:, 3:]))
    columns = (held.geom[chosen], held.pos[chosen], frames[:, 0], held.dist[chosen], forces, torques)
    return [
        Contact(
            collisions=(compiled.geom_collisions[first], compiled.geom_collisions[second]),
            position=tuple(position),
            normal=tuple(normal),
            depth=-distance,
            force=Wrench(tuple(force), tuple(torque)),
        )
        for (first, second), position, normal, distance, force, torque in zip(
            *(column.tolist() for column in columns), strict=True
        )
    ]
