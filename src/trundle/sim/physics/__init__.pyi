from .compile.compiled_world import CompiledWorld as CompiledWorld
from .compile.compiler import compile_world as compile_world
from .compile.mjcf import compile_mjcf as compile_mjcf
from .compile.recompiler import Recompiler as Recompiler
from .compile.shape_pair import MAX_CORNERS as MAX_CORNERS, ShapePair as ShapePair
from .compile.wheels import report_wheels as report_wheels
from .convex.background import BackgroundCutting as BackgroundCutting
from .convex.planning_hulls import (
    convex_parts as convex_parts,
    hull_corners as hull_corners,
    moving_pieces as moving_pieces,
)
from .egl_renderer import EglRenderer as EglRenderer
from .step.batch import Batch as Batch, WorldRow as WorldRow
from .step.contact import Contact as Contact, Contacts as Contacts
from .step.contact_laws import mujoco_addresses as mujoco_addresses
from .step.contact_recorder import ContactRecorder as ContactRecorder
from .step.dynamics import Coordinates as Coordinates, JointState as JointState
from .step.engine import (
    Engine as Engine,
    EngineState as EngineState,
    SimulationUnstableError as SimulationUnstableError,
)
from .step.engine_snapshot import EngineSnapshot as EngineSnapshot
from .step.instability import Divergence as Divergence
from .step.motors import MotorAxis as MotorAxis, MotorBank as MotorBank, MotorCommand as MotorCommand
from .step.step_timer import StepTimer as StepTimer, StepTimes as StepTimes
from .step.stepper import StepAction as StepAction, StepHooks as StepHooks
from .step.surface_motion import (
    LinkGrip as LinkGrip,
    SurfaceMotion as SurfaceMotion,
    TrackMotion as TrackMotion,
    WheelGrip as WheelGrip,
)
from .step.warp.device import NoGpuError as NoGpuError, find_gpu as find_gpu
from .step.warp.limits import gpu_limits as gpu_limits
