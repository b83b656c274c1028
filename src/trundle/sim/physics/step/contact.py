"""Contacts of the last step."""

from collections.abc import Iterator, Sequence
from typing import overload

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.spatial import Vector3, Wrench

from .. import _contact_laws
from ..compile.compiled_world import CompiledWorld

_Array = NDArray[np.float64]


class Contact(Struct, frozen=True, kw_only=True):
    """Contact point of two collisions."""

    __module__ = "trundle"

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


class Contacts(Sequence[Contact]):
    """Contact points of the last step, N of them, one by one or as arrays."""

    __module__ = "trundle"

    def __init__(self, geom_collisions: tuple[str, ...], rows: _Array) -> None:
        """Store contacts.

        Args:
            geom_collisions: `model::link::collision` of each geom of the model.
            rows: (N, 15) geoms of both, position [m], normal, force [N], torque [N·m], depth [m].
        """
        self._geom_collisions = geom_collisions
        self.rows = rows
        self.collisions = tuple(
            (geom_collisions[first], geom_collisions[second]) for first, second in rows[:, :2].astype(np.intp).tolist()
        )
        """Names (N) `model::link::collision` of both."""

    @property
    def bodies(self) -> tuple[tuple[str, str], ...]:
        """Names (N) `model::link` of both."""
        return tuple((first.rpartition("::")[0], second.rpartition("::")[0]) for first, second in self.collisions)

    @property
    def positions(self) -> _Array:
        """Positions (N, 3) in the world [m]."""
        return self.rows[:, 2:5]

    @property
    def normals(self) -> _Array:
        """Unit normals (N, 3) from the first into the second, world axes."""
        return self.rows[:, 5:8]

    @property
    def forces(self) -> _Array:
        """Forces (N, 3) of the first on the second at the point [N], world axes."""
        return self.rows[:, 8:11]

    @property
    def torques(self) -> _Array:
        """Torques (N, 3) of the first on the second about the point [N·m], world axes, from torsional and rolling
        friction.
        """
        return self.rows[:, 11:14]

    @property
    def depths(self) -> _Array:
        """Penetration depths (N,) [m]."""
        return self.rows[:, 14]

    def among(self, collisions: frozenset[str]) -> "Contacts":
        """Return the contacts of the named collisions."""
        return self.select([i for i, pair in enumerate(self.collisions) if not collisions.isdisjoint(pair)])

    def __add__(self, others: "Contacts") -> "Contacts":
        """Return these contacts followed by others of the same world."""
        return Contacts(self._geom_collisions, np.concatenate([self.rows, others.rows])) if others else self

    def select(self, chosen: Sequence[int]) -> "Contacts":
        """Return the contacts with these indices."""
        return Contacts(self._geom_collisions, self.rows[list(chosen)])

    def __len__(self) -> int:
        return len(self.collisions)

    @overload
    def __getitem__(self, index: int) -> Contact: ...
    @overload
    def __getitem__(self, index: slice) -> "Contacts": ...
    def __getitem__(self, index: int | slice) -> "Contact | Contacts":
        if isinstance(index, slice):
            return self.select(range(len(self))[index])
        return _contact(self.collisions[index], self.rows[index].tolist())

    def __iter__(self) -> Iterator[Contact]:
        return map(_contact, self.collisions, self.rows.tolist())

    def __repr__(self) -> str:
        pairs = ", ".join(f"{first} – {second}" for first, second in dict.fromkeys(self.collisions))
        return f"<{len(self)} contacts{': ' if pairs else ''}{pairs}>"


def _contact(collisions: tuple[str, str], row: list[float]) -> Contact:
    _, _, x, y, z, nx, ny, nz, fx, fy, fz, tx, ty, tz, depth = row
    return Contact(
        collisions=collisions,
        position=(x, y, z),
        normal=(nx, ny, nz),
        depth=depth,
        force=Wrench((fx, fy, fz), (tx, ty, tz)),
    )


def contacts_of(
    compiled: CompiledWorld, model: mujoco.MjModel, data: mujoco.MjData, chosen: NDArray[np.intp]
) -> Contacts:
    """Return the contacts of the given indices."""
    rows = _contact_laws.read_contacts(model._address, data._address, chosen.tolist())
    return Contacts(compiled.geom_collisions, rows)
