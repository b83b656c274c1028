"""One planning pipeline: a planner with the adapters around it, by the names of parameters."""

import re
from typing import Any, cast

from trundle.planning.planners import StartStateFixes, ompl_settings
from trundle.planning.trajectories import Method, find_method
from trundle.robots.parameters import RosParameters
from trundle.ros import Node

from .robot_description import RobotDescription

_PILZ = "pilz_industrial_motion_planner"
_PILZ_PLANNERS = ("PTP", "LIN", "CIRC")
_OMPL = "ompl_interface"
"""Package of OMPL's plugin."""
_OPTIMIZERS = {"chomp_interface": "CHOMP", "stomp_moveit": "STOMP", "trajopt_interface": "TrajOpt"}
"""Package of a planning plugin → its only planner."""
_ADAPTERS = "default_planner_request_adapters"
"""Package of the adapters whose work is done here."""


class Pipeline:
    """One planning pipeline of the parameters."""

    def __init__(self, node: Node, name: str, parameters: RosParameters, description: RobotDescription) -> None:
        """Read the settings of a namespace."""
        self.name = name
        self.plugin = parameters.text("planning_plugin", "ompl_interface/OMPLPlanner")
        self._parameters = parameters
        self._description = description
        self._tree: dict[str, Any] = parameters.tree()
        self._changed: dict[tuple[str, str], dict[str, str]] = {}
        adapters = parameters.text("request_adapters", "").split()
        names = [adapter.rpartition("/")[2] for adapter in adapters]
        others = [adapter for adapter in adapters if not adapter.startswith(f"{_ADAPTERS}/")]
        if others:
            node.log.warn(f"there is no planning request adapter {', '.join(others)}; paths are planned without it")
        timing = next((one for one in names if one.startswith("Add") and one.endswith("Parameterization")), "")
        self.timing: Method
        self.timing, note = find_method(timing)
        if note:
            node.log.warn(note)
        self.fixes = StartStateFixes(
            max_bounds_error=parameters.number("start_state_max_bounds_error", 0.05),
            jiggle_fraction=parameters.number("jiggle_fraction", 0.02),
            max_sampling_attempts=parameters.integer("max_sampling_attempts", 100),
        )
        node.log.info(f"Using planning interface '{self.description}'")
        for one in [name for name, adapter in zip(names, adapters, strict=True) if adapter not in others]:
            node.log.info(f"Using planning request adapter '{one}'")

    @property
    def description(self) -> str:
        """What query_planner_interface calls it."""
        if self.is_pilz:
            return "Pilz Industrial Motion Planner"
        return "OMPL" if self._package == _OMPL else self._optimizer or self.plugin

    @property
    def note(self) -> str:
        """A sentence if another planner answers for the plugin; "" if the plugin's own does."""
        if self.is_pilz or self._package == _OMPL:
            return ""
        return f"pipeline '{self.name}': there is no {self.plugin}; RRTConnect plans, and its paths are shortened"

    @property
    def _package(self) -> str:
        return re.split("/|::", self.plugin)[0]

    @property
    def _optimizer(self) -> str:
        """Only planner of the plugin; empty: it has several."""
        return _OPTIMIZERS.get(self._package, "")

    @property
    def is_pilz(self) -> bool:
        """True for the planner of PTP, LIN and CIRC."""
        return _PILZ in self.plugin

    @property
    def planner_ids(self) -> list[str]:
        """Names of planner configurations, as query_planner_interface lists them."""
        if self.is_pilz:
            return list(_PILZ_PLANNERS)
        if self._optimizer:
            return [self._optimizer]
        names = list(self._section("planner_configs"))
        return [*names, *(f"{group}[{name}]" for group in self._description.model.groups for name in names)]

    def _section(self, *names: str) -> dict[str, Any]:
        """Return nested parameters; empty where there are none."""
        section: dict[str, Any] = self._tree
        for name in names:
            nested = section.get(name)
            section = cast("dict[str, Any]", nested) if isinstance(nested, dict) else {}
        return section

    def planner_settings(self, group: str, config: str) -> dict[str, object]:
        """Return the parameters of a planner configuration, or of a group's default one."""
        name = config or str(self._section(group).get("default_planner_config", ""))
        return {**self._section("planner_configs", name), **self._changed.get((group, name), {})}

    def set_planner_settings(self, group: str, config: str, values: dict[str, str], *, replace: bool) -> None:
        """Change the parameters of a planner configuration."""
        old = {} if replace else {key: str(value) for key, value in self.planner_settings(group, config).items()}
        self._changed[group, config] = {**old, **values}

    def choose(self, group: str, planner_id: str) -> tuple[str, Any]:
        """Return the planner and its settings for a request."""
        if self.is_pilz:
            return planner_id or str(self._tree.get("default_planner_config") or "PTP"), None
        if self._optimizer:
            return self._optimizer, None
        config = dict(self._tree)
        name = planner_id.removeprefix(f"{group}[").removesuffix("]")
        changed = self._changed.get((group, name)) or self._changed.get(("", name))
        if changed is not None:
            config["planner_configs"] = {**self._section("planner_configs"), name: changed}
        return ompl_settings(config, group, planner_id)

    def capabilities(self) -> list[str]:
        """Return the capabilities that the pipeline's parameters ask for."""
        return self._parameters.text("capabilities", "").split()
