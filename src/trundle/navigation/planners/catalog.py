"""Planners by the names of their plugins; imported on use."""

import importlib
from typing import Any

GLOBAL_PLANNERS = {
    "carrot_planner/CarrotPlanner": "trundle.navigation.planners.carrot_planner:CarrotPlanner",
    "global_planner/GlobalPlanner": "trundle.navigation.planners.global_planner:GlobalPlanner",
    "navfn/NavfnROS": "trundle.navigation.planners.navfn:NavfnROS",
}
LOCAL_PLANNERS = {
    "base_local_planner/TrajectoryPlannerROS": "trundle.navigation.planners.trajectory:TrajectoryPlannerROS",
    "dwa_local_planner/DWAPlannerROS": "trundle.navigation.planners.dwa:DWAPlannerROS",
}


def find_global_planner(name: str) -> Any | None:
    """Return the class of a global planner; None if there is none of that name."""
    return _find(GLOBAL_PLANNERS, name)


def find_local_planner(name: str) -> Any | None:
    """Return the class of a local planner; None if there is none of that name."""
    return _find(LOCAL_PLANNERS, name)


def _find(catalog: dict[str, str], name: str) -> Any | None:
    target = catalog.get(name) or next((t for key, t in catalog.items() if key.rpartition("/")[2] == name), None)
    if target is None:
        return None
    module, _, class_name = target.partition(":")
    return getattr(importlib.import_module(module), class_name)
