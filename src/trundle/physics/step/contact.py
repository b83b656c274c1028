"""Contacts of the last step."""

from collections.abc import Iterator, Sequence
from typing import overload

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.spatial import Vector3, Wrench

from ..compile.compiled_world import CompiledWorld

_Array = NDArray[np.float64]


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


class Contacts(Sequence[Contact]):
    """Contact points of the last step, N of them, one by one or as arrays."""

    def __init__(self, collisions: Sequence[tuple[str, str]], columns: _Array, *, depths: _Array) -> None:
        """Store contacts.

        Args:
            collisions: `model::link::collision` of both, per contact.
            columns: (N, 12) position [m], normal, force [N], torque [N·m].
            depths: (N,) [m]
        """
        self.collisions = tuple(collisions)
        """Names (N) `model::link::collision` of both."""
        self._columns = columns
        self.depths = depths
        """Penetration depths (N,) [m]."""

    @property
    def bodies(self) -> tuple[tuple[str, str], ...]:
        """Names (N) `model::link` of both."""
        return tuple((one.rpartition("::")[0], other.rpartition("::")[0]) for one, other in self.collisions)

    @property
    def positions(self) -> _Array:
        """Positions (N, 3) in the world [m]."""
        return self._columns[:, 0:3]

    @property
    def normals(self) -> _Array:
        """Unit normals (N, 3) from the first into the second, world axes."""
        return self._columns[:, 3:6]

    @property
    def forces(self) -> _Array:
        """Forces (N, 3) of the first on the second at the point [N], world axes."""
        return self._columns[:, 6:9]

    @property
    def torques(self) -> _Array:
        """Torques (N, 3) of the first on the second about the point [N·m], world axes, from torsional and rolling
        friction.
        """
        return self._columns[:, 9:12]

    def among(self, collisions: frozenset[str]) -> "Contacts":
        """Return the contacts of the named collisions."""
        return self._select([i for i, two in enumerate(self.collisions) if not collisions.isdisjoint(two)])

    def __add__(self, others: "Contacts") -> "Contacts":
        """Return both, in order."""
        if not others:
            return self
        return Contacts(
            self.collisions + others.collisions,
            np.concatenate([self._columns, others._columns]),
            depths=np.concatenate([self.depths, others.depths]),
        )

    def _select(self, chosen: Sequence[int]) -> "Contacts":
        rows = list(chosen)
        return Contacts([self.collisions[i] for i in rows], self._columns[rows], depths=self.depths[rows])

    def __len__(self) -> int:
        return len(self.collisions)

    @overload
    def __getitem__(self, index: int) -> Contact: ...
    @overload
    def __getitem__(self, index: slice) -> "Contacts": ...
    def __getitem__(self, index: int | slice) -> "Contact | Contacts":
        if isinstance(index, slice):
            return self._select(range(len(self))[index])
        return _contact(self.collisions[index], self._columns[index].tolist(), float(self.depths[index]))

    def __iter__(self) -> Iterator[Contact]:
        return map(_contact, self.collisions, self._columns.tolist(), self.depths.tolist())

    def __repr__(self) -> str:
        pairs = ", ".join(f"{one} – {other}" for one, other in dict.fromkeys(self.collisions))
        return f"<{len(self)} contacts{': ' if pairs else ''}{pairs}>"


def _contact(collisions: tuple[str, str], row: list[float], depth: float) -> Contact:
    x, y, z, nx, ny, nz, fx, fy, fz, tx, ty, tz = row
    return Contact(
        collisions=collisions,
        position=(x, y, z),
        normal=(nx, ny, nz),
        depth=depth,
        force=Wrench((fx, fy, fz), (tx, ty, tz)),
    )


NO_CONTACTS = Contacts((), np.empty((0, 12)), depths=np.empty(0))


def contacts_of(
    compiled: CompiledWorld, model: mujoco.MjModel, data: mujoco.MjData, chosen: NDArray[np.intp]
) -> Contacts:
    """Return the contacts of the given indices."""
    if not len(chosen):
        return NO_CONTACTS
    held = data.contact
    wrenches = np.empty((len(chosen), 6))
    for i, wrench in zip(chosen.tolist(), wrenches, strict=True):
        mujoco.mj_contactForce(model, data, i, wrench)
    frames = held.frame[chosen].reshape(-1, 3, 3)
    columns = np.empty((len(chosen), 12))
    columns[:, 0:3] = held.pos[chosen]
    columns[:, 3:6] = frames[:, 0]
    np.einsum("nji,nj->ni", frames, wrenches[:, :3], out=columns[:, 6:9])
    np.einsum("nji,nj->ni", frames, wrenches[:, 3:], out=columns[:, 9:12])
    names = compiled.geom_collisions
    pairs = [(names[first], names[second]) for first, second in held.geom[chosen].tolist()]
    return Contacts(pairs, columns, depths=-held.dist[chosen])
