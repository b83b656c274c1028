"""Restitution: the bounce that a spring and a damper cannot make.

MuJoCo's contacts push with forces over several steps, and how high a body comes back then depends on the phase of the
impact. So a contact that bounces gets an impulse at the moment it is found: the speeds of approach turn round by
Newton's law, friction within Coulomb's cone, over all contacts at once by projected Gauss-Seidel.
"""

import math
from collections.abc import Mapping

import mujoco
import numpy as np
from numpy.typing import NDArray

from .approach import Approach
from .index import GeomPair
from .pairs import PairTable
from .surfaces import Touch

_SWEEPS = 50
_SLOWEST = 3.0
"""Steps' worth of falling: what comes slower than that is at rest."""


class Bounce:
    """Turns approaching contacts round; called in every step between collision and solution."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, touches: Mapping[GeomPair, Touch]) -> None:
        self._model = model
        self._data = data
        self._touches = {pair: touch for pair, touch in touches.items() if touch.restitution > 0 and touch.is_felt}
        self._approach = Approach(model, data)
        self._slowest = _SLOWEST * math.hypot(*model.opt.gravity) * model.opt.timestep
        self._table = PairTable(model.ngeom, self._touches)
        self._least = np.array([max(self._touches[pair].threshold, self._slowest) for pair in self._table.pairs])
        """[m/s] Of each pair: what approaches slower, does not bounce."""

    def __bool__(self) -> bool:
        """Whether anything bounces at all."""
        return bool(self._touches)

    def __call__(self) -> bool:
        """Give the impulses of this step; return whether there were any."""
        data = self._data
        if not data.ncon:
            return False
        rows: list[NDArray[np.float64]] = []
        targets: list[float] = []
        frictions: list[tuple[float, float]] = []
        for i in self._approaching().tolist():
            contact = data.contact[i]
            g1, g2 = contact.geom.tolist()
            touch = self._touches[min(g1, g2), max(g1, g2)]
            jacobian = self._approach.of(contact)
            speed = float(jacobian[0] @ data.qvel)
            target = self._target(touch, -speed, depth=-float(contact.dist), pull=self._pull(contact, g1, g2))
            if target is not None:
                rows.append(jacobian)
                targets.append(target)
                # In MuJoCo's order: the first tangent has the first number.
                frictions.append((float(contact.friction[0]), float(contact.friction[1])))
        if not rows:
            return False
        self._push(np.concatenate(rows), targets, frictions)
        return True

    def _approaching(self) -> NDArray[np.intp]:
        """Contacts that may bounce: most do not, and those cost nothing more."""
        contacts, places = self._table.find(self._data)
        fast = self._approach.speeds()[contacts] > self._least[places] * (1 - 1e-6)
        return contacts[fast & (self._data.contact.dist[contacts] <= 0)]

    def _pull(self, contact: mujoco.MjContact, g1: int, g2: int) -> float:
        """How gravity speeds the approach up [m/s²]; two bodies that both fall, not at all."""
        moving = [self._model.body_weldid[self._model.geom_bodyid[geom]] != 0 for geom in (g1, g2)]
        return float(contact.frame[:3] @ self._model.opt.gravity) * (int(moving[0]) - int(moving[1]))

    def _target(self, touch: Touch, approach: float, *, depth: float, pull: float) -> float | None:
        """The speed to leave at [m/s]: e times what it was at the surface, and what the way back to it takes."""
        if approach <= max(touch.threshold, self._slowest):
            return None
        at_surface = max(approach**2 - 2 * pull * depth, 0.0)
        return math.sqrt(max(touch.restitution**2 * at_surface + 2 * pull * depth, 0.0))

    def _push(self, rows: NDArray[np.float64], targets: list[float], frictions: list[tuple[float, float]]) -> None:
        data = self._data
        reach = np.zeros_like(rows)
        mujoco.mj_solveM(self._model, data, reach, rows)
        effect = rows @ reach.T
        velocity = rows @ data.qvel
        impulse = np.zeros(len(rows))
        for _ in range(_SWEEPS):
            for i, (target, (mu1, mu2)) in enumerate(zip(targets, frictions, strict=True)):
                n, t = 3 * i, slice(3 * i + 1, 3 * i + 3)
                now = velocity + effect @ impulse
                impulse[n] = max(impulse[n] + (target - now[n]) / effect[n, n], 0.0)
                now = velocity + effect @ impulse
                wanted = impulse[t] - now[t] / np.maximum(np.diag(effect)[t], 1e-12)
                most = impulse[n] * np.array([mu1, mu2])
                length = float(np.linalg.norm(wanted / np.maximum(most, 1e-12)))
                impulse[t] = wanted / max(length, 1.0)
        data.qvel += reach.T @ impulse
