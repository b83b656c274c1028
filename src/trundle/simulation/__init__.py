"""The running world: clock, commands, snapshots, hooks, handles."""

from trundle.physics import SimulationUnstableError

from .actors import ActorWalk, with_actors
from .handle import expect_finite
from .handles import JointHandle, LinkHandle, ModelHandle
from .hooks import AfterStep, BeforeStep
from .line import Line
from .saved import SavedSimulation
from .simulation import Simulation
from .snapshot import Snapshot
from .state_log import StateLog, StateRecorder, read_state_log

__all__ = [
    "ActorWalk",
    "AfterStep",
    "BeforeStep",
    "JointHandle",
    "Line",
    "LinkHandle",
    "ModelHandle",
    "SavedSimulation",
    "Simulation",
    "SimulationUnstableError",
    "Snapshot",
    "StateLog",
    "StateRecorder",
    "expect_finite",
    "read_state_log",
    "with_actors",
]
