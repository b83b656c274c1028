"""What touches what at the moment."""

from dataclasses import dataclass

import mujoco
import numpy as np

from trundle.spatial import Vector3, Wrench

from .index import CompiledWorld


@dataclass(frozen=True, slots=True, kw_only=True)
class Contact:
    """One point where two collisions meet, as the last step found it."""

    collisions: tuple[str, str]
    """`model::link::collision` of the two."""
    position: Vector3
    """In the world [m]."""
    normal: Vector3
    """Out of the first, into the second; unit, world axes."""
    depth: float
    """How far they are in one another [m]."""
    force: Wrench
    """What the first does to the second at this point, world axes."""


def contacts_of(compiled: CompiledWorld, model: mujoco.MjModel, data: mujoco.MjData) -> list[Contact]:
    """Every contact."""
    found: list[Contact] = []
    inside = np.empty(6)
    for i in range(data.ncon):
        contact = data.contact[i]
        names = [compiled.geom_collisions[int(geom)] for geom in contact.geom]
        frame = contact.frame.reshape(3, 3)
        mujoco.mj_contactForce(model, data, i, inside)
        force, torque = frame.T @ inside[:3], frame.T @ inside[3:]
        found.append(
            Contact(
                collisions=(names[0], names[1]),
                position=_vector(contact.pos),
                normal=_vector(frame[0]),
                depth=-float(contact.dist),
                force=Wrench(_vector(force), _vector(torque)),
            )
        )
    return found


def _vector(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> Vector3:
    x, y, z = values.tolist()
    return (x, y, z)
