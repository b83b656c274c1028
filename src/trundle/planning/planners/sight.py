"""Whether a state satisfies a constraint of sight."""

from trundle.base.diagnostics import UsageError
from trundle.planning import _planning
from trundle.planning.planning_scene import PlanningScene

from .constraints import Constraints, VisibilityConstraint
from .error_codes import RequestError
from .group_problem import GroupProblem
from .requests import Positions


def is_visible(scene: PlanningScene, constraint: VisibilityConstraint, positions: Positions) -> bool:
    """Return whether the sensor sees the disc in a state (variables,) [rad, m].

    Raises:
        UsageError: a frame is unknown, or a number is not finite.
    """
    group = next(name for name, one in scene.model.groups.items() if one.variables)
    try:
        problem = GroupProblem(scene, group, positions, avoids_collisions=False)
        goal = problem.goal(Constraints(visibilities=(constraint,)))
    except RequestError as error:
        raise UsageError(str(error)) from None
    return _planning.satisfies(scene.world, problem.task, goal, problem.reference[problem.indices])
