from .actions import EffortAction as EffortAction, PositionAction as PositionAction, VelocityAction as VelocityAction
from .environments import make as make, make_vec as make_vec
from .evaluation import score as score
from .observations import (
    Computed as Computed,
    JointPositions as JointPositions,
    JointVelocities as JointVelocities,
    LinkPose as LinkPose,
    LinkPosition as LinkPosition,
    LinkTwist as LinkTwist,
)
from .policy import MlpPolicy as MlpPolicy
from .ppo import Iteration as Iteration, train as train
from .sensor_observations import CameraPicture as CameraPicture, LidarRanges as LidarRanges
from .single_env import SimulationEnv as SimulationEnv
from .states import WorldStates as WorldStates
from .twist_action import TwistAction as TwistAction
from .vector_env import SimulationVectorEnv as SimulationVectorEnv
from .worlds import Task as Task
