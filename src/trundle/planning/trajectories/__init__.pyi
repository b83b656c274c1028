from .parameterization import (
    Method as Method,
    MotionLimits as MotionLimits,
    find_method as find_method,
    motion_limits as motion_limits,
    parameterize as parameterize,
    unwound as unwound,
)
from .trajectory import Trajectory as Trajectory
