"""Builder of a launch plan."""

from dataclasses import replace
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.robots.names import canonical_name

from .plan import LaunchArgument, LaunchNode, LaunchParam, LaunchPlan, LaunchTest, ParamCommand, ParamStep, ParamValue

_MAX_PARAMS = 200_000


class PlanBuilder:
    """Collects nodes and parameters; a parameter set again keeps its position and takes the later value."""

    def __init__(self, report: Diagnostics) -> None:
        self._report = report
        self.arguments: list[LaunchArgument] = []
        self._machines: dict[str, tuple[object, ...]] = {"": ("",), "localhost": ("",)}
        self.default_machine = ""
        """Default machine of the nodes that follow."""
        self._nodes: dict[str, LaunchNode] = {}
        self._tests: list[LaunchTest] = []
        self._params: dict[str, LaunchParam] = {}
        self._clear: dict[str, None] = {}
        self._steps: list[ParamStep] = []
        self._files: dict[Path, None] = {}

    def add_file(self, file: Path) -> None:
        self._files[file] = None

    def add_node(self, node: LaunchNode) -> None:
        """Add a node.

        Raises:
            DescriptionError: duplicate name.
        """
        if other := self._nodes.get(node.full_name):
            raise DescriptionError(
                node.at, f"two nodes are named {node.full_name!r}; the other one is at {other.at}", "duplicate-name"
            )
        self._nodes[node.full_name] = node

    def add_machine(self, name: str, settings: tuple[object, ...], at: Source) -> None:
        """Add a machine; `settings` start with its address.

        Raises:
            DescriptionError: duplicate name.
        """
        if name != "localhost" and self._machines.setdefault(name, settings) != settings:
            raise DescriptionError(at, f"two machines are named {name!r}, and they differ", "launch-machine")

    def add_test(self, test: LaunchTest) -> None:
        self._tests.append(test)

    def add_step(self, step: ParamStep) -> None:
        self._steps.append(step)

    def clear(self, namespace: str) -> None:
        self._clear[namespace] = None

    def set_param(self, name: str, value: ParamValue | ParamCommand, at: Source) -> None:
        """Set a parameter; YAML dictionaries are already split into leaves."""
        name = canonical_name(name)
        parent = name.rpartition("/")[0]
        while parent:
            if parent in self._params:
                parent_at = self._params[parent].at
                self._report.warn(
                    at, f"parameter {name!r} lies below the parameter {parent!r} of {parent_at}", "launch-param"
                )
            parent = parent.rpartition("/")[0]
        if len(self._params) >= _MAX_PARAMS:
            raise DescriptionError(at, f"more than {_MAX_PARAMS} parameters", "too-large")
        self._params[name] = LaunchParam(name=name, value=value, at=at)

    def build(self) -> LaunchPlan:
        return LaunchPlan(
            nodes=tuple(map(self._with_machine, self._nodes.values())),
            params=tuple(self._params.values()),
            clear_params=tuple(self._clear),
            steps=tuple(self._steps),
            arguments=tuple(self.arguments),
            files=tuple(self._files),
            tests=tuple(self._tests),
        )

    def _with_machine(self, node: LaunchNode) -> LaunchNode:
        """Return a node with its machine's address; the <machine> may follow the node."""
        if node.machine not in self._machines:
            machines = ", ".join(repr(name) for name in self._machines if name not in ("", "localhost")) or "none"
            message = f"node {node.name!r}: no machine {node.machine!r}, so it cannot be launched; machines: {machines}"
            self._report.warn(node.at, message, "unknown-machine")
            return replace(node, address=None)
        return replace(node, address=str(self._machines[node.machine][0]))
