from .actors import ActorPlayer as ActorPlayer, with_actors as with_actors
from .debug_line import DebugLine as DebugLine
from .handles import LinkHandle as LinkHandle, ModelHandle as ModelHandle
from .hooks import AfterStep as AfterStep, BeforeStep as BeforeStep
from .joint_handle import JointHandle as JointHandle, TimedCommand as TimedCommand
from .profiler import Profiler as Profiler, StridePart as StridePart
from .saved_state import SavedSimulation as SavedSimulation
from .snapshot import Snapshot as Snapshot
from .state_log import StateLog as StateLog, StateRecorder as StateRecorder, read_state_log as read_state_log
from .state_log_format import is_state_log as is_state_log
from .world_simulation import Simulation as Simulation
