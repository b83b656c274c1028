"""What a world needs in every step between finding contacts and solving them, and MuJoCo does not have.

Bounces, friction with a direction of its own, moving and slipping surfaces, velocities that decay, and what has to be
parted: a world without them steps in C alone.
"""

import mujoco
import numpy as np

from trundle.model import Link
from trundle.spatial import ZERO

from .approach import lay
from .bounce import Bounce
from .grip import Grips
from .index import CompiledWorld
from .pairs import PairTable
from .parting import Parting

_SLOWEST = 0.01
"""[m/s or rad/s] ODE damps nothing that is slower."""


class Between:
    """Everything that has to be seen to; false where nothing has."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData) -> None:
        self._model = compiled.model
        self._data = data
        self._bounce = Bounce(compiled.model, data, compiled.touches)
        self._grain = _Grain(compiled, data)
        self.grips = Grips(compiled.model, data)
        self.parting = Parting(compiled)
        self._decay = _Decay(compiled, data)

    def __bool__(self) -> bool:
        """Whether there is anything to do at all."""
        return bool(self._bounce or self._grain or self.grips or self._decay or self.parting)

    def step(self) -> None:
        """Take one time step."""
        model, data = self._model, self._data
        if self.grips:
            self.grips.weigh()
        mujoco.mj_step1(model, data)
        turned = bool(self._grain) and self._grain.turn()
        if self.grips and self.grips.turn():
            turned = True
        if self.parting and self.parting.hold_back(data):
            turned = True
        if turned:
            mujoco.mj_makeConstraint(model, data)
            mujoco.mj_island(model, data)
            mujoco.mj_projectConstraint(model, data)
        if (self._bounce and self._bounce()) or turned:
            mujoco.mj_fwdVelocity(model, data)
        if self.grips:
            self.grips.drag()
        if self._decay:
            self._decay.slow()
        mujoco.mj_step2(model, data)


class _Grain:
    """Friction that has a first direction in the frame of one of two shapes, and another coefficient across it."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData) -> None:
        self._data = data
        found = {
            pair: touch
            for pair, touch in compiled.touches.items()
            if touch.fdir1 != ZERO and touch.mu != touch.mu2 and min(touch.mu, touch.mu2) > 0
        }
        self._table = PairTable(compiled.model.ngeom, found)
        self._geoms = np.array([pair[found[pair].fdir1_of] for pair in self._table.pairs], dtype=np.intp)
        self._directions = np.array([found[pair].fdir1 for pair in self._table.pairs]).reshape(-1, 3)
        """(pairs, 3) in the frame of that geom."""

    def __bool__(self) -> bool:
        return bool(self._table.pairs)

    def turn(self) -> bool:
        """Lay the first tangent of each contact along its direction; return whether any was laid."""
        data = self._data
        contacts, pairs = self._table.find(data)
        if not len(contacts):
            return False
        axes = data.geom_xmat[self._geoms[pairs]].reshape(-1, 3, 3)
        along = np.einsum("nij,nj->ni", axes, self._directions[pairs])
        return bool(lay(data, contacts, along).any())


class _Decay:
    """Velocities that lose a part of themselves at every step, as ODE's linear and angular damping."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData) -> None:
        self._model = compiled.model
        self._data = data
        links: list[Link] = [link for model in compiled.world.models for link in model.links]
        self._decays = [
            (int(body), min(max(link.linear_decay, 0.0), 1.0), min(max(link.angular_decay, 0.0), 1.0))
            for body, link in zip(compiled.link_bodies, links, strict=True)
            if (link.linear_decay > 0 or link.angular_decay > 0) and compiled.model.body_dofnum[body] > 0
        ]

    def __bool__(self) -> bool:
        return bool(self._decays)

    def slow(self) -> None:
        """Add the forces that take the part away within this step."""
        model, data = self._model, self._data
        velocity = np.empty(6)
        for body, linear, angular in self._decays:
            # Of the centre of mass, in world axes: rotation first.
            mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, body, velocity, 0)
            spin, speed = velocity[:3], velocity[3:]
            axes = data.ximat[body].reshape(3, 3)
            force, torque = np.zeros(3), np.zeros(3)
            if np.linalg.norm(speed) > _SLOWEST:
                force = -linear * model.body_mass[body] / model.opt.timestep * speed
            if np.linalg.norm(spin) > _SLOWEST:
                torque = -angular / model.opt.timestep * (axes * model.body_inertia[body]) @ axes.T @ spin
            mujoco.mj_applyFT(model, data, force, torque, data.xipos[body], body, data.qfrc_passive)
