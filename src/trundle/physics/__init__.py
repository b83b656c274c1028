"""model → MuJoCo: the compile, and the engine that steps."""

from .compile import compile_world
from .engine import Engine, EngineState, SimulationUnstableError
from .index import CompiledWorld
from .instant import Instant
from .raycaster import RayRenderer

__all__ = [
    "CompiledWorld",
    "Engine",
    "EngineState",
    "Instant",
    "RayRenderer",
    "SimulationUnstableError",
    "compile_world",
]
