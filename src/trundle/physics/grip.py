"""Surfaces that move under a contact, or give way to a force: belts, tracks, slipping wheels.

ODE has motion1, slip1 and slip2 for them. A moving surface is a number that MuJoCo's contacts have a place for. Along a
direction in which a surface slips, MuJoCo's friction is switched off, and a force that grows with the speed takes its
place, up to what friction would hold.
"""

import math
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Vector3, cross, normalized

from .approach import Approach

_Array = NDArray[np.float64]
_SHORTEST = 1e-9
"""Of a first direction within the surface: what is shorter, has none."""
_SMOOTH = 1e-5
"""Friction that MuJoCo takes for none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactPoint:
    """Where a link touches something."""

    position: Vector3
    """In the world [m]."""
    normal: Vector3
    """Into the link; unit, world axes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Grip:
    """How a surface holds on at one point."""

    along: Vector3
    """First friction direction, the one that mu counts along, world axes; what is normal to the surface is left out."""
    speed: float = 0.0
    """[m/s] At which the surface runs past its own link, along the first direction."""
    slip: float = 0.0
    """[m/s/N] Speed that a friction force of all the link's contacts causes, along the first direction."""
    slip_across: float = 0.0
    """[m/s/N] Across it."""


GripLaw: TypeAlias = Callable[[ContactPoint], Grip | None]
"""None: the contact is an ordinary one."""


@dataclass(frozen=True, slots=True)
class _Slipping:
    contact: mujoco.MjContact
    body: int
    slips: _Array
    """(2,) Along the tangents [m/s/N]; 0: MuJoCo's friction holds."""
    frictions: _Array
    """(2,) Coefficients along the tangents."""


class Grips:
    """The laws of a world's links, laid on their contacts at each step."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model = model
        self._data = data
        self._approach = Approach(model, data)
        self._laws: Mapping[int, GripLaw] = {}
        self._lawful = np.zeros(model.ngeom, dtype=bool)
        """Which geoms are of a body that has a law."""
        self._loads: dict[int, float] = {}
        self._slipping: list[_Slipping] = []

    def set_laws(self, laws: Mapping[int, GripLaw]) -> None:
        """Take the laws of bodies, by number."""
        self._laws = laws
        self._lawful = np.isin(self._model.geom_bodyid, list(laws))
        self._model.flg_surfacevel = bool(laws)

    def __bool__(self) -> bool:
        """Whether there is any."""
        return bool(self._laws)

    def weigh(self) -> None:
        """Keep how hard each body was pressed in the last step, which limits its friction [N]."""
        self._loads = dict.fromkeys(self._laws, 0.0)
        for contact, body, _ in self._ours():
            if contact.efc_address >= 0:
                self._loads[body] += float(self._data.efc_force[contact.efc_address])

    def turn(self) -> bool:
        """Ask the laws, and lay each contact's first tangent along its direction; return whether any was laid."""
        turned = False
        self._slipping = []
        for contact, body, sign in self._ours():
            normal = sign * contact.frame[:3]
            grip = self._laws[body](ContactPoint(position=_vector(contact.pos), normal=_vector(normal)))
            if grip is not None and self._lay(contact, body, sign, grip):
                turned = True
        return turned

    def _lay(self, contact: mujoco.MjContact, body: int, sign: float, grip: Grip) -> bool:
        normal, (x, y, z) = _vector(contact.frame[:3]), grip.along
        upwards = normal[0] * x + normal[1] * y + normal[2] * z
        within = (x - upwards * normal[0], y - upwards * normal[1], z - upwards * normal[2])
        along = normalized(within)
        if along is None or math.hypot(*within) < _SHORTEST:
            return False
        contact.frame[3:6], contact.frame[6:9] = along, cross(normal, along)
        contact.surfacevel[:2] = (sign * grip.speed, 0.0)
        slips = np.array([grip.slip, grip.slip_across])
        if (slips > 0.0).any():
            slips[slips < self._least_slips(contact)] = 0.0
        if slips[0] > 0.0 == slips[1]:
            # The solver wants the direction that holds to be the first.
            contact.frame[3:6], contact.frame[6:9] = contact.frame[6:9].copy(), -contact.frame[3:6]
            contact.surfacevel[:2] = (0.0, -sign * grip.speed)
            contact.friction[:2] = contact.friction[1::-1].copy()
            slips = slips[::-1]
        if slips.any():
            self._slipping.append(_Slipping(contact, body, slips, contact.friction[:2].copy()))
            contact.friction[:2] = np.where(slips > 0.0, _SMOOTH, contact.friction[:2])
        return True

    def _least_slips(self, contact: mujoco.MjContact) -> _Array:
        """(2,) [m/s/N] What a force changes within a step: a surface that slips less is as good as one that holds."""
        rows = self._approach.of(contact)[1:]
        reach = np.zeros_like(rows)
        mujoco.mj_solveM(self._model, self._data, reach, rows)
        return np.einsum("ij,ij->i", rows, reach) * self._model.opt.timestep

    def drag(self) -> None:
        """Push against what slips, for this step: force = −speed / slip, within the ellipse of friction."""
        data = self._data
        shares = Counter(each.body for each in self._slipping)
        for each in self._slipping:
            rows, share = self._approach.of(each.contact)[1:], shares[each.body]
            speeds = rows @ data.qvel + each.contact.surfacevel[:2]
            forces = np.where(each.slips > 0.0, -speeds / np.where(each.slips > 0.0, share * each.slips, 1.0), 0.0)
            most = np.maximum(each.frictions * self._loads[each.body] / share, 1e-12)
            data.qfrc_passive += rows.T @ (forces / max(float(np.linalg.norm(forces / most)), 1.0))

    def _ours(self) -> list[tuple[mujoco.MjContact, int, float]]:
        """Contacts with friction of bodies that have a law, which body, and 1 where it is the second, else −1."""
        contacts = self._data.contact
        ours = self._lawful[contacts.geom]
        found: list[tuple[mujoco.MjContact, int, float]] = []
        for i in np.flatnonzero(ours.any(axis=1) & (contacts.dim >= 3)).tolist():
            second = bool(ours[i, 1])
            contact = contacts[i]
            found.append((contact, int(self._model.geom_bodyid[contact.geom[int(second)]]), 1.0 if second else -1.0))
        return found


def _vector(values: _Array) -> Vector3:
    x, y, z = values.tolist()
    return (x, y, z)
