"""Planners by the names of their plugins; imported on use."""

import importlib
import re
from typing import Any

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node

from ..plugin_classes import find_plugin_class
from .plugin import GlobalPlannerPlugin, LocalPlannerPlugin
from .substitutes import GLOBAL_SUBSTITUTES, SUBSTITUTES

GLOBAL_PLANNERS = {
    "carrot_planner/CarrotPlanner": "trundle.navigation.planners.carrot_planner:CarrotPlanner",
    "global_planner/GlobalPlanner": "trundle.navigation.planners.global_planner:GlobalPlanner",
    "navfn/NavfnROS": "trundle.navigation.planners.navfn:NavfnROS",
}
LOCAL_PLANNERS = {
    "base_local_planner/TrajectoryPlannerROS": "trundle.navigation.planners.trajectory_planner:TrajectoryPlannerROS",
    "dwa_local_planner/DWAPlannerROS": "trundle.navigation.planners.dwa_planner:DWAPlannerROS",
    "eband_local_planner/EBandPlannerROS": "trundle.navigation.planners.elastic_bands:EBandPlannerROS",
    "teb_local_planner/TebLocalPlannerROS": "trundle.navigation.planners.elastic_bands:TebLocalPlannerROS",
}
GLOBAL_GROUP, LOCAL_GROUP = "trundle.navigation.global_planners", "trundle.navigation.local_planners"
"""Groups of entry points of installed planners."""


def find_global_planner(node: Node, name: str, root: RosParameters) -> tuple[Any, str, RosParameters]:
    """Return class, namespace and parameters of a global planner.

    Raises:
        ParamError: there is none of that name.
    """
    space = re.split("/|::", name)[-1]
    if space in GLOBAL_SUBSTITUTES:
        node.log.warn(f"base_global_planner: navfn/NavfnROS is used in place of {name}")
        return _find(GLOBAL_PLANNERS, "NavfnROS"), space, root.section(space)
    kind = _find(GLOBAL_PLANNERS, name) or find_plugin_class(node, GLOBAL_GROUP, GlobalPlannerPlugin, name)
    if kind is None:
        raise ParamError(f"no global planner {name!r}; there are: {', '.join(GLOBAL_PLANNERS)}")
    return kind, space, root.section(space)


def find_local_planner(node: Node, name: str, root: RosParameters) -> tuple[Any, str, RosParameters]:
    """Return class, namespace and parameters of a local planner.

    Raises:
        ParamError: there is none of that name.
    """
    space = re.split("/|::", name)[-1]
    if space == "LocalPlannerAdapter":  # nav_core_adapter's class loads the planner that a parameter names
        name = root.section(space).text("planner_name", "DWBLocalPlanner")
        space = re.split("/|::", name)[-1]
    section = root.section(space)
    if space in SUBSTITUTES:
        node.log.warn(f"base_local_planner: dwa_local_planner/DWAPlannerROS is used in place of {name}")
        return _find(LOCAL_PLANNERS, "DWAPlannerROS"), space, SUBSTITUTES[space](section)
    kind = _find(LOCAL_PLANNERS, name) or find_plugin_class(node, LOCAL_GROUP, LocalPlannerPlugin, name)
    if kind is None:
        known = ", ".join((*LOCAL_PLANNERS, *SUBSTITUTES))
        raise ParamError(f"no local planner {name!r}; there are: {known}")
    return kind, space, section


def _find(catalog: dict[str, str], name: str) -> Any | None:
    target = catalog.get(name) or next((t for key, t in catalog.items() if key.rpartition("/")[2] == name), None)
    if target is None:
        return None
    module, _, class_name = target.partition(":")
    return getattr(importlib.import_module(module), class_name)
