"""model → MuJoCo: the compile, and the engine that steps."""

from .compile import CompiledWorld, compile_world
from .engine import Engine, EngineState, SimulationUnstableError
from .raycaster import RayRenderer

__all__ = ["CompiledWorld", "Engine", "EngineState", "RayRenderer", "SimulationUnstableError", "compile_world"]
