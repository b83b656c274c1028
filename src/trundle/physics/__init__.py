"""model → MuJoCo: the compile, and the engine that steps."""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .compile import compile_world
    from .egl_renderer import EglRenderer
    from .engine import Engine, EngineState, SimulationUnstableError
    from .grip import ContactPoint, Grip, GripLaw
    from .index import CompiledWorld
    from .instant import Instant
    from .mjcf import compile_mjcf
    from .postmortem import Runaway
    from .touching import Contact
    from .wheels import name_wheels

_HOMES = {
    "CompiledWorld": "index",
    "Contact": "touching",
    "ContactPoint": "grip",
    "EglRenderer": "egl_renderer",
    "Engine": "engine",
    "EngineState": "engine",
    "Grip": "grip",
    "GripLaw": "grip",
    "Instant": "instant",
    "Runaway": "postmortem",
    "SimulationUnstableError": "engine",
    "compile_mjcf": "mjcf",
    "compile_world": "compile",
    "name_wheels": "wheels",
}
__getattr__ = opened_on_use(__name__, _HOMES)

__all__ = [
    "CompiledWorld",
    "Contact",
    "ContactPoint",
    "EglRenderer",
    "Engine",
    "EngineState",
    "Grip",
    "GripLaw",
    "Instant",
    "Runaway",
    "SimulationUnstableError",
    "compile_mjcf",
    "compile_world",
    "name_wheels",
]
