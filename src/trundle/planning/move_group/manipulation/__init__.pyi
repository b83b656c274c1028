from .execution import execute_stages as execute_stages
from .manipulation_plan import (
    Failure as Failure,
    ManipulationGoal as ManipulationGoal,
    Stage as Stage,
    plan_manipulation as plan_manipulation,
)
from .requests import pick_goals as pick_goals, place_goals as place_goals
