"""Stepper: states of one world on a GPU."""

import copy

import mujoco
import mujoco_warp
import numpy as np
import warp as wp
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError

from ...compile.compiled_world import CompiledWorld
from ...compile.law_tables import find_table
from .kernels import drive
from .limits import gpu_limits, gpu_model
from .sliding import Sliding

_Array = NDArray[np.float64]
_CONTACTS_PER_PAIR, _MAX_CONTACTS = 8, 256
_ROWS_PER_CONTACT = 3
_SPARE_CONTACTS = 4096
"""Memory for contacts, which all worlds share: large enough that a crowded world takes none from the others."""
_OVERFLOWS = ("NEFC", "NJMAX_NNZ", "BROADPHASE", "NARROWPHASE", "CCD", "HFIELD", "EPA_HORIZON")


class GpuStepper:
    """Worlds in the memory of a GPU, in single precision."""

    def __init__(
        self,
        compiled: CompiledWorld,
        model: mujoco.MjModel,
        worlds: int,
        device: str,
    ) -> None:
        """Copy a model to the GPU, and compile the kernels, which takes minutes the first time on a machine.

        Args:
            compiled: the world.
            model: copy of its model, in which nothing sleeps.
            worlds: number of states.
            device: Warp's name of the GPU.

        Raises:
            UsageError: the GPU does not support a law of the world, or a part of its model.
        """
        limits = gpu_limits(compiled)
        if limits:
            raise UsageError("\n".join(["a GPU cannot step this world; use device='cpu':", *limits]))
        model = copy.copy(model)
        gpu_model(model)
        contacts = min(_CONTACTS_PER_PAIR * max(model.npair, model.ngeom), _MAX_CONTACTS)
        rows = model.nv + model.ntendon + 2 * model.njnt + 6 * model.neq + _ROWS_PER_CONTACT * contacts
        max_contacts = worlds * contacts + _SPARE_CONTACTS
        self._device = device
        wp.config.log_level = wp.LOG_WARNING
        with wp.ScopedDevice(device):
            try:
                self._model = mujoco_warp.put_model(model, batch_sizes={"tendon_frictionloss": worlds})
            except (NotImplementedError, ValueError) as error:
                raise UsageError(f"a GPU cannot step this world; use device='cpu': {error}") from None
            self._model.opt.warn_overflow = 0
            self._data = mujoco_warp.make_data(
                model,
                nworld=worlds,
                naconmax=max_contacts,
                naccdmax=min(worlds * _convex_pairs(model, contacts), max_contacts),
                njmax=rows,
            )
            self._is_loaded = dict.fromkeys(("qfrc_applied", "xfrc_applied"), False)
            self._motors = wp.array(find_table(model, "motors")[:, [0, 2]].astype(np.int32), dtype=int, ndim=2)
            self._stops = wp.array(_stops(model).astype(np.float32), dtype=float, ndim=2)
            self._rates = wp.zeros((worlds, model.ntendon), dtype=float)
            self._h = float(model.opt.timestep)
            self._sliding = Sliding(model, self._model, self._data, self._rates)
            self._model.callback.control = self._drive
            mujoco_warp.step(self._model, self._data)
            with wp.ScopedCapture() as capture:
                mujoco_warp.step(self._model, self._data)
            self._graph = capture.graph

    def _drive(self, _model: object, data: "mujoco_warp.Data") -> None:
        self._sliding.launch()
        efc = data.efc
        rows = [efc.type, efc.id, efc.pos, efc.margin, efc.vel]
        wp.launch(
            drive,
            dim=(data.nworld, data.njmax),
            inputs=[self._h, self._motors, self._stops, self._rates, data.ctrl, data.qpos, data.nefc, *rows],
            outputs=[efc.aref],
        )

    def step(
        self, count: int, before: dict[str, _Array], max_efforts: _Array, rates: _Array, targets: _Array
    ) -> tuple[dict[str, _Array], NDArray[np.bool_]]:
        """Step all worlds.

        Args:
            count: number of steps.
            before: (worlds, …) qpos, qvel, qacc_warmstart, ctrl, qfrc_applied, and (worlds, bodies, 6) xfrc_applied.
            max_efforts: (worlds, motors)
            rates: (worlds, motors)
            targets: (worlds, motors) target speeds of the step before; those of the last step afterwards.

        Returns:
            qpos, qvel and qacc_warmstart afterwards; (worlds,) True if contacts did not fit and were left out.
        """
        with wp.ScopedDevice(self._device):
            self._model.tendon_frictionloss.assign(max_efforts.astype(np.float32))
            self._rates.assign(rates.astype(np.float32))
            self._sliding.last_targets.assign(targets.astype(np.float32))
            for name, values in before.items():
                if name in self._is_loaded:
                    was_loaded, self._is_loaded[name] = self._is_loaded[name], bool(values.any())
                    if not (was_loaded or self._is_loaded[name]):
                        continue  # both are zero
                getattr(self._data, name).assign(values.astype(np.float32))
            self._data.overflow.zero_()
            for _ in range(count):
                wp.capture_launch(self._graph)
            after = {name: getattr(self._data, name).numpy() for name in ("qpos", "qvel", "qacc_warmstart")}
            overflow = self._data.overflow.numpy()
            targets[:] = self._sliding.last_targets.numpy()
        crowded = overflow & sum(int(mujoco_warp.OverflowType[name]) for name in _OVERFLOWS) != 0
        return {name: values.astype(np.float64) for name, values in after.items()}, crowded


def _convex_pairs(model: mujoco.MjModel, contacts: int) -> int:
    """Return how many pairs of a world may need memory for penetrations of convex shapes (10 kB each) at a time.

    That is the largest number of pairs of the same two types, as each two types take their turn: pairs with a plane
    need none, and every prism of a heightmap does. `contacts` is returned where not all pairs are listed.
    """
    kinds = np.sort(model.geom_type[np.stack([model.pair_geom1, model.pair_geom2])], axis=0)
    plane, field = int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_HFIELD)
    if model.geom_contype.any() or (kinds == field).any():
        return contacts
    kinds = kinds[:, kinds[0] != plane]
    return int(np.unique(kinds, axis=1, return_counts=True)[1].max(initial=1))


def _stops(model: mujoco.MjModel) -> _Array:
    """Return (joints, 2) stiffness and damping of the constraint rows of limits."""
    return -model.jnt_solref / model.jnt_solimp[:, 1:2]
