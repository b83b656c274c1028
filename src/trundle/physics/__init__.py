"""model → MuJoCo: the compile, and the engine that steps."""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .compile import compile_world
    from .egl_renderer import EglRenderer
    from .engine import Engine, EngineState, SimulationUnstableError
    from .grip import Grip, LinkGrip, TrackGrip, WheelGrip
    from .index import CompiledWorld
    from .instant import Instant
    from .mjcf import compile_mjcf
    from .postmortem import Runaway
    from .touching import Contact
    from .wheels import name_wheels

_HOMES = {
    "CompiledWorld": "index",
    "Contact": "touching",
    "EglRenderer": "egl_renderer",
    "Engine": "engine",
    "EngineState": "engine",
    "Grip": "grip",
    "Instant": "instant",
    "LinkGrip": "grip",
    "Runaway": "postmortem",
    "SimulationUnstableError": "engine",
    "TrackGrip": "grip",
    "WheelGrip": "grip",
    "compile_mjcf": "mjcf",
    "compile_world": "compile",
    "name_wheels": "wheels",
}
__getattr__ = opened_on_use(__name__, _HOMES)

__all__ = [
    "CompiledWorld",
    "Contact",
    "EglRenderer",
    "Engine",
    "EngineState",
    "Grip",
    "Instant",
    "LinkGrip",
    "Runaway",
    "SimulationUnstableError",
    "TrackGrip",
    "WheelGrip",
    "compile_mjcf",
    "compile_world",
    "name_wheels",
]
