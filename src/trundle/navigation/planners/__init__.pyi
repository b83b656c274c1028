from .catalog import (
    GLOBAL_PLANNERS as GLOBAL_PLANNERS,
    LOCAL_PLANNERS as LOCAL_PLANNERS,
    find_global_planner as find_global_planner,
    find_local_planner as find_local_planner,
)
from .interfaces import GlobalPlanner as GlobalPlanner, LocalPlanner as LocalPlanner, Plan as Plan, Pose2D as Pose2D
from .plugin import GlobalPlannerPlugin as GlobalPlannerPlugin, LocalPlannerPlugin as LocalPlannerPlugin
