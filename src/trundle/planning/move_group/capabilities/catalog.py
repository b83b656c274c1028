"""Capabilities by the plugins' names."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from .cartesian_path import offer_cartesian_path
from .execute_trajectory import offer_execute_trajectory_action, offer_execute_trajectory_service
from .kinematics_services import offer_kinematics
from .move_action import offer_move_action
from .pick_place import offer_pick_place
from .plan_service import offer_plan_service
from .planner_services import offer_planner_services
from .scene_services import offer_apply_planning_scene, offer_clear_octomap, offer_get_planning_scene
from .sequence import offer_sequence_action, offer_sequence_service
from .state_validity import offer_state_validity

if TYPE_CHECKING:
    from ..move_group_context import MoveGroupContext

_Offer = Callable[["MoveGroupContext"], None]
DEFAULTS = (
    "move_group/MoveGroupCartesianPathService",
    "move_group/MoveGroupKinematicsService",
    "move_group/MoveGroupExecuteTrajectoryAction",
    "move_group/MoveGroupMoveAction",
    "move_group/MoveGroupPickPlaceAction",
    "move_group/MoveGroupPlanService",
    "move_group/MoveGroupQueryPlannersService",
    "move_group/MoveGroupStateValidationService",
    "move_group/MoveGroupGetPlanningSceneService",
    "move_group/ApplyPlanningSceneService",
    "move_group/ClearOctomapService",
)
"""Those of every move_group, in the original's order."""
CAPABILITIES: dict[str, tuple[_Offer, ...]] = {
    "move_group/ApplyPlanningSceneService": (offer_apply_planning_scene,),
    "move_group/ClearOctomapService": (offer_clear_octomap,),
    "move_group/MoveGroupCartesianPathService": (offer_cartesian_path,),
    "move_group/MoveGroupExecuteService": (offer_execute_trajectory_service,),
    "move_group/MoveGroupExecuteTrajectoryAction": (offer_execute_trajectory_action,),
    "move_group/MoveGroupGetPlanningSceneService": (offer_get_planning_scene,),
    "move_group/MoveGroupKinematicsService": (offer_kinematics,),
    "move_group/MoveGroupMoveAction": (offer_move_action,),
    "move_group/MoveGroupPickPlaceAction": (offer_pick_place,),
    "move_group/MoveGroupPlanService": (offer_plan_service,),
    "move_group/MoveGroupQueryPlannersService": (offer_planner_services,),
    "move_group/MoveGroupStateValidationService": (offer_state_validity,),
    "pilz_industrial_motion_planner/MoveGroupSequenceAction": (offer_sequence_action,),
    "pilz_industrial_motion_planner/MoveGroupSequenceService": (offer_sequence_service,),
}
"""Plugin's name → functions that advertise it."""
