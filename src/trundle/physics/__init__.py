"""model → MuJoCo: the compile, and the engine that steps."""

from .compile import compile_world
from .egl_renderer import EglRenderer
from .engine import Engine, EngineState, SimulationUnstableError
from .grip import ContactPoint, Grip, GripLaw
from .index import CompiledWorld
from .instant import Instant
from .mjcf import compile_mjcf
from .postmortem import Runaway
from .touching import Contact

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
]
