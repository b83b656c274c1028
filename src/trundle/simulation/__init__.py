"""The running world: clock, commands, snapshots, hooks, handles."""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .actors import ActorWalk, with_actors
    from .handle import expect_finite
    from .handles import JointHandle, LinkHandle, ModelHandle
    from .hooks import AfterStep, BeforeStep
    from .line import Line
    from .saved import SavedSimulation
    from .simulation import Simulation
    from .snapshot import Snapshot
    from .state_log import StateLog, StateRecorder, read_state_log

_HOMES = {
    "ActorWalk": "actors",
    "AfterStep": "hooks",
    "BeforeStep": "hooks",
    "JointHandle": "joint_handle",
    "Line": "line",
    "LinkHandle": "handles",
    "ModelHandle": "handles",
    "SavedSimulation": "saved",
    "Simulation": "simulation",
    "Snapshot": "snapshot",
    "StateLog": "state_log",
    "StateRecorder": "state_log",
    "expect_finite": "handle",
    "read_state_log": "state_log",
    "with_actors": "actors",
}
__getattr__ = opened_on_use(__name__, _HOMES)

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
    "Snapshot",
    "StateLog",
    "StateRecorder",
    "expect_finite",
    "read_state_log",
    "with_actors",
]
