"""model → MuJoCo: the compile, and the engine that steps."""

from .compile import compile_mjcf, compile_world
from .engine import Engine, EngineState, SimulationUnstableError
from .index import CompiledWorld
from .instant import Instant
from .postmortem import Runaway
from .touching import Contact

__all__ = [
    "CompiledWorld",
    "Contact",
    "Engine",
    "EngineState",
    "Instant",
    "Runaway",
    "SimulationUnstableError",
    "compile_mjcf",
    "compile_world",
]
