"""Contact laws missing in MuJoCo, implemented in C++ and installed in the MuJoCo library that Python loaded.

Restitution, anisotropic friction, moving and slipping surfaces, velocity decay. The tables of `law_tables` select them
per model; they act within `mj_step` for every caller.
"""

import ctypes
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import mujoco

from trundle.base.built import refuse_stale
from trundle.base.diagnostics import TrundleError

from .. import _contact_laws
from ..compile.compiled_world import CompiledWorld
from ..compile.law_tables import find_table, set_needstage

if TYPE_CHECKING:
    from .surface_motion import LinkGrip

_SPECULATIVE = int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)
_LIBRARIES = {"win32": "mujoco.dll", "darwin": "libmujoco.*.dylib"}


def bind() -> None:
    """Bind MuJoCo's functions from its loaded library.

    Raises:
        TrundleError: the C++ was built for another version of MuJoCo, or is out of date.
    """
    refuse_stale(_contact_laws)
    version = mujoco.mj_version()
    if version != _contact_laws.VERSION:
        built_version, installed = (
            f"{v // 1_000_000}.{v // 1000 % 1000}.{v % 1000}" for v in (_contact_laws.VERSION, version)
        )
        problem = f"Trundle is built for MuJoCo {built_version}, and mujoco-core {installed} is installed"
        raise TrundleError(f"{problem}; pip install mujoco-core=={built_version}")
    _contact_laws.bind(mujoco_addresses(_contact_laws.names()))
    _contact_laws.install()


def mujoco_addresses(names: Iterable[str]) -> list[int]:
    """Return the addresses of MuJoCo's functions, by name, in the library that Python has loaded."""
    pattern = _LIBRARIES.get(sys.platform, "libmujoco.so.*")
    library = ctypes.CDLL(str(next(Path(mujoco.__file__).parent.glob(pattern))))
    return [ctypes.addressof(ctypes.c_byte.in_dll(library, name)) for name in names]


bind()


class ContactLaws:
    """Contact laws of one simulated model."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData) -> None:
        self._model = compiled.model
        self._data = data
        self._motions = find_table(compiled.model, "motions")
        self._head = find_table(compiled.model, "laws")[0]
        self._head[7] = data._address
        slides = bool((compiled.model.geom_bodyid > 0).any())
        decays = bool(find_table(compiled.model, "damping").any())
        self._is_slow = False
        """True if no step needs speculative contacts until the state is written or a law requests them."""
        self._always = slides or decays or bool(self._head[4:7].any())

    @property
    def is_active(self) -> bool:
        """True if any law is in use."""
        return self._always or self.prevents_sleep

    @property
    def prevents_sleep(self) -> bool:
        """True if moving surfaces forbid sleeping."""
        return bool(self._head[2])

    def install(self) -> None:
        """Install the callbacks, in case another caller replaced them."""
        _contact_laws.install()

    def look_ahead(self) -> None:
        """Enable speculative contacts, if the model needs them, for all users of the model; the laws switch them while
        stepping.
        """
        if self._head[8] > 0.0:
            self._is_slow = not self._model.opt.enableflags & _SPECULATIVE
            self._model.opt.enableflags |= _SPECULATIVE

    def resume(self) -> None:
        """Restore the laws' last decision on speculative contacts, before the next step."""
        if self._is_slow:
            self._model.opt.enableflags &= ~_SPECULATIVE

    def expect_any_speed(self) -> None:
        """Enable speculative contacts at the next step, because the state was written."""
        self._is_slow = False

    def set_surface_motions(self, motions: "Mapping[int, LinkGrip]") -> None:
        """Set the surface motion of bodies by id; all others are ordinary."""
        self._motions[:] = 0.0
        for body, motion in motions.items():
            self._motions[body] = motion.row
        self._head[2] = self._model.flg_surfacevel = bool(motions)
        set_needstage(self._model, solved=bool(motions) or self._head[6] > 0)
