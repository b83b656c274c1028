"""Surfaces that move under a contact, or give way to a force: belts, tracks, slipping wheels.

ODE has motion1, slip1 and slip2 for them. A moving surface is a number that MuJoCo's contacts have a place for. Along a
direction in which a surface slips, MuJoCo's friction is switched off, and a force that grows with the speed takes its
place, up to what friction would hold.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Vector3

from .approach import Approach, lay

_Array = NDArray[np.float64]
_Numbers = NDArray[np.intp]
_SMOOTH = 1e-5
"""Friction that MuJoCo takes for none."""


_NO_GRIP = (0.0,) * 6


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
    """Contacts that slip in this step."""

    bodies: _Numbers
    rows: _Array
    """(N, 2, nv) speeds along the two tangents, as functions of all speeds."""
    slips: _Array
    """(N, 2) along the tangents [m/s/N]; 0: MuJoCo's friction holds."""
    slipping: NDArray[np.bool_]
    """(N, 2) which are above zero."""
    frictions: _Array
    """(N, 2) coefficients along the tangents."""
    speeds: _Array
    """(N, 2) of the surface, along the tangents [m/s]."""


class Grips:
    """The laws of a world's links, laid on their contacts at each step."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model = model
        self._data = data
        self._approach = Approach(model, data)
        self._laws: Mapping[int, GripLaw] = {}
        self._lawful = np.zeros(model.ngeom, dtype=bool)
        """Which geoms are of a body that has a law."""
        self._loads = np.zeros(model.nbody)
        self._slipping: _Slipping | None = None

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
        contacts, bodies, _ = self._ours()
        rows = self._data.contact.efc_address[contacts]
        pressed = rows >= 0
        self._loads[:] = 0.0
        np.add.at(self._loads, bodies[pressed], self._data.efc_force[rows[pressed]])

    def turn(self) -> bool:
        """Ask the laws, and lay each contact's first tangent along its direction; return whether any was laid."""
        self._slipping = None
        contacts, bodies, signs = self._ours()
        if not len(contacts):
            return False
        there = self._data.contact
        points, normals = there.pos[contacts].tolist(), (signs[:, None] * there.frame[contacts, :3]).tolist()
        grips = [
            self._laws[body](ContactPoint(position=(x, y, z), normal=(nx, ny, nz)))
            for body, (x, y, z), (nx, ny, nz) in zip(bodies.tolist(), points, normals, strict=True)
        ]
        # No direction where there is no law: nothing is laid there.
        values = np.array([_NO_GRIP if g is None else (*g.along, g.speed, g.slip, g.slip_across) for g in grips])
        laid = np.flatnonzero(lay(self._data, contacts, values[:, :3]))
        if not len(laid):
            return False
        self._let_go(contacts[laid], bodies[laid], signs[laid] * values[laid, 3], values[laid, 4:])
        return True

    def _let_go(self, contacts: _Numbers, bodies: _Numbers, run: _Array, slips: _Array) -> None:
        """Have surfaces run [m/s] along their first tangent, and slip (N, 2) [m/s/N] along both."""
        there = self._data.contact
        surfaces = there.surfacevel
        surfaces[contacts, 0], surfaces[contacts, 1] = run, 0.0
        if not slips.any():
            return
        frames = there.frame
        rows = frames[contacts, 3:].reshape(-1, 2, 3) @ self._approach.differences(contacts)
        slips[slips < self._least_slips(rows)] = 0.0
        # The solver wants the direction that holds to be the first.
        swapped = np.flatnonzero((slips[:, 0] > 0.0) & (slips[:, 1] == 0.0))
        if len(swapped):
            at = contacts[swapped]
            frames[at, 3:6], frames[at, 6:9] = frames[at, 6:9], -frames[at, 3:6]
            surfaces[at, 0], surfaces[at, 1] = 0.0, -run[swapped]
            there.friction[at, :2] = there.friction[at, 1::-1]
            rows[swapped, 0], rows[swapped, 1] = rows[swapped, 1], -rows[swapped, 0]
            slips[swapped] = slips[swapped, ::-1]
        slipping = slips > 0.0
        frictions = there.friction[contacts, :2]
        there.friction[contacts, :2] = np.where(slipping, _SMOOTH, frictions)
        self._slipping = _Slipping(bodies, rows, slips, slipping, frictions, surfaces[contacts, :2])

    def _least_slips(self, rows: _Array) -> _Array:
        """(N, 2) [m/s/N] What a force changes within a step: a surface that slips less is as good as one that holds."""
        flat = np.ascontiguousarray(rows.reshape(-1, self._model.nv))
        reach = np.zeros_like(flat)
        mujoco.mj_solveM(self._model, self._data, reach, flat)
        return np.einsum("ij,ij->i", flat, reach).reshape(-1, 2) * self._model.opt.timestep

    def drag(self) -> None:
        """Push against what slips, for this step: force = −speed / slip, within the ellipse of friction."""
        each = self._slipping
        if each is None:
            return
        shares = np.bincount(each.bodies[each.slipping.any(axis=1)], minlength=self._model.nbody)[each.bodies, None]
        speeds = each.rows @ self._data.qvel + each.speeds
        forces = np.where(each.slipping, -speeds / np.where(each.slipping, shares * each.slips, 1.0), 0.0)
        most = np.maximum(each.frictions * self._loads[each.bodies, None] / np.maximum(shares, 1), 1e-12)
        over = np.sqrt(((forces / most) ** 2).sum(axis=1, keepdims=True))
        self._data.qfrc_passive += (forces / np.maximum(over, 1.0)).ravel() @ each.rows.reshape(forces.size, -1)

    def _ours(self) -> tuple[_Numbers, _Numbers, _Array]:
        """Contacts with friction of bodies that have a law, which body, and 1 where it is the second, else −1."""
        geoms = self._data.contact.geom
        if not len(geoms):
            return np.zeros(0, dtype=np.intp), np.zeros(0, dtype=np.intp), np.zeros(0)
        ours = self._lawful[geoms]
        contacts = np.flatnonzero(ours.any(axis=1) & (self._data.contact.dim >= 3))
        second = ours[contacts, 1].astype(np.intp)
        bodies = self._model.geom_bodyid[geoms[contacts, second]].astype(np.intp)
        return contacts, bodies, 2.0 * second - 1.0
