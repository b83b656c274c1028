"""model → MuJoCo: the compile, and the engine that steps."""

from .compile import CompiledWorld, compile_world
from .engine import Engine, EngineState, SimulationUnstableError

__all__ = ["CompiledWorld", "Engine", "EngineState", "SimulationUnstableError", "compile_world"]
