from .cartesian_lines import (
    CartesianPath as CartesianPath,
    JumpBounds as JumpBounds,
    PathEnd as PathEnd,
    cartesian_path as cartesian_path,
)
from .constraints import (
    Constraints as Constraints,
    JointConstraint as JointConstraint,
    OrientationConstraint as OrientationConstraint,
    OrientationParameterization as OrientationParameterization,
    PositionConstraint as PositionConstraint,
    ViewDirection as ViewDirection,
    VisibilityConstraint as VisibilityConstraint,
    joint_goal as joint_goal,
    pose_goal as pose_goal,
)
from .error_codes import ErrorCode as ErrorCode, PlanningFailure as PlanningFailure, RequestError as RequestError
from .motion_plan import plan as plan
from .path_validity import is_path_valid as is_path_valid
from .pilz.sequence import blended as blended, joined as joined
from .requests import (
    CartesianLimits as CartesianLimits,
    MotionPlan as MotionPlan,
    MotionPlanRequest as MotionPlanRequest,
    PlannerSettings as PlannerSettings,
    PlanStatistics as PlanStatistics,
    StartStateFixes as StartStateFixes,
    WorkspaceBounds as WorkspaceBounds,
    ompl_settings as ompl_settings,
)
from .sight import is_visible as is_visible
