"""Paths that are checked between their points, too."""

import numpy as np

from trundle.planning import _planning
from trundle.planning.planning_scene import PlanningScene

from .constraints import Constraints
from .group_problem import GroupProblem
from .requests import Positions

_UNCONSTRAINED = Constraints()


def is_path_valid(
    scene: PlanningScene,
    group: str,
    values: Positions,
    *,
    reference: Positions | None = None,
    path_constraints: Constraints = _UNCONSTRAINED,
) -> bool:
    """Return True if nothing touches along straight lines between states of a group, and constraints hold.

    Args:
        scene: with the pairs that may touch.
        group: group's name.
        values: (N, n) of the group's variables [rad, m]; what is beyond a limit is taken at the limit.
        reference: state of the other variables; None: the scene's.
        path_constraints: hold at every state.

    Raises:
        RequestError: no such group, or constraints that cannot be.
    """
    problem = GroupProblem(
        scene, group, scene.positions if reference is None else reference, path_constraints=path_constraints
    )
    model, turns, indices = scene.model, problem.dimensions[:, 2] > 0, problem.indices
    path = np.array(values, dtype=np.float64)
    path[:, turns] = (path[:, turns] + np.pi) % (2.0 * np.pi) - np.pi
    bounded = model.is_bounded[indices]
    path[:, bounded] = np.clip(path, model.lower[indices], model.upper[indices])[:, bounded]
    return _planning.first_invalid(scene.world, problem.task, np.ascontiguousarray(path)) < 0
