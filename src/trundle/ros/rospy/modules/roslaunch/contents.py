"""Contents of launch files, before anything starts."""

import logging
from typing import Any

from rosgraph.names import ns_join

from .core import Master, Param, RLException
from .machine import Machine, is_machine_local, local_machine
from .node import Node, Test

_MAX_VALUE = 20
"""Maximum length of a value in the summary."""


def namespaces_of(name: str) -> list[str]:
    """Namespaces that contain a name, the outermost first; names are treated as global.

    Raises:
        ValueError: the name is None.
    """
    if name is None:  # pyright: ignore[reportUnnecessaryComparison]
        raise ValueError("name")
    words = [word for word in name.split("/") if word]
    return ["/", *("/" + "/".join(words[:count]) for count in range(1, len(words)))]


class ROSLaunchConfig:
    """Nodes, parameters, tests and machines of launch files."""

    def __init__(self) -> None:
        self.master = Master()
        self.nodes_core: list[Node] = []
        self.nodes: list[Node] = []
        self.tests: list[Test] = []
        self.roslaunch_files: list[str] = []
        self.resolved_node_names: list[str] = []
        self.machines: dict[str, Machine] = {"": local_machine()}
        self.params: dict[str, Param] = {}
        self.clear_params: list[str] = []
        self.executables: list[Any] = []
        self.config_errors: list[str] = []
        self.logger = logging.getLogger("roslaunch")
        self._has_remote_nodes: bool | None = None

    def add_roslaunch_file(self, f: str) -> None:
        """Add the path of a file that was read."""
        self.roslaunch_files.append(f)

    def add_config_error(self, msg: str) -> None:
        """Add a fault that does not prevent the launch."""
        self.config_errors.append(msg)

    def set_master(self, m: Master) -> None:
        """Set the master."""
        self.master = m

    def add_executable(self, exe: Any) -> None:
        """Add a command.

        Raises:
            ValueError: the command is None.
        """
        if not exe:
            raise ValueError("exe is None")
        self.executables.append(exe)

    def add_clear_param(self, param: str) -> None:
        """Add a namespace whose parameters are deleted first."""
        self.clear_params.append(param)

    def add_param(self, p: Param, filename: str | None = None, verbose: bool = True) -> None:
        """Add a parameter; it replaces one of the same name."""
        del filename
        for parent in namespaces_of(p.key):
            if parent in self.params:
                self.add_config_error(f"parameter [{p.key}] conflicts with parent parameter [{parent}]")
        self.params[p.key] = p
        if verbose:
            print(f"Added parameter [{p.key}]")

    def add_machine(self, m: Machine, verbose: bool = True) -> bool:
        """Add a machine; False if it was added before.

        Raises:
            RLException: another machine has the same name.
        """
        if m.name in self.machines:
            if m != self.machines[m.name]:
                raise RLException(f"Machine [{m.name}] already added and does not match duplicate entry")
            return False
        self.machines[m.name] = m
        if verbose:
            print(f"Added machine [{m.name}]")
        return True

    def add_test(self, test: Test, verbose: bool = True) -> None:
        """Add a test."""
        del verbose
        self.tests.append(test)

    def add_node(self, node: Node, core: bool = False, verbose: bool = True) -> None:
        """Add a node.

        Raises:
            RLException: duplicate name, or a node of the core without a name.
        """
        if node.name:
            name = ns_join(node.namespace, node.name)
            if name in self.resolved_node_names:
                raise RLException(
                    f"roslaunch file contains multiple nodes named [{name}].\n"
                    "Please check all <node> 'name' attributes to make sure they are unique.\n"
                    "Also check that $(anon id) use different ids."
                )
            self.resolved_node_names.append(name)
        elif core:
            raise RLException(f"ROS core nodes must have a name. [{node.package}/{node.type}]")
        (self.nodes_core if core else self.nodes).append(node)
        if verbose:
            kind = "core node" if core else "node"
            print(f"Added {kind} of type [{node.package}/{node.type}] in namespace [{node.namespace}]")

    def assign_machines(self) -> None:
        """Set each node's machine.

        Raises:
            RLException: a node names an unknown machine.
        """
        for node in self.nodes_core:
            node.machine = self.machines[""]
        for node in (*self.nodes, *self.tests):
            if (node.machine_name or "") not in self.machines:
                raise RLException(f"ERROR: unknown machine [{node.machine_name}]")
            node.machine = self.machines[node.machine_name or ""]
        used = [node.machine for node in (*self.nodes, *self.tests) if node.machine is not None]
        self._has_remote_nodes = not all(map(is_machine_local, used))

    def has_remote_nodes(self) -> bool:
        """True if a node is for another machine.

        Raises:
            RLException: machines are not assigned.
        """
        if self._has_remote_nodes is None:
            raise RLException("ERROR: has_remote_nodes() cannot be called until prelaunch check is complete")
        return self._has_remote_nodes

    def summary(self, local: bool = False) -> str:
        """Text that roslaunch prints before it starts the nodes."""
        parts = ["\nSUMMARY\n========"]
        if self.clear_params:
            parts.append("\n\nCLEAR PARAMETERS\n" + "\n".join(sorted(f" * {name}" for name in self.clear_params)))
        if self.params:
            lines = sorted(f" * {name}: {_value_text(param.value)}" for name, param in self.params.items())
            parts.append("\n\nPARAMETERS\n" + "\n".join(lines))
        if not local:
            parts.append("\n\nMACHINES\n" + "\n".join(sorted(f" * {name}" for name in self.machines if name)))
        parts.append("\n\nNODES\n")
        nodes = [node for node in self.nodes if not local or (node.machine and is_machine_local(node.machine))]
        for namespace in sorted({node.namespace for node in nodes}):
            names = sorted(f"    {_label(node)}" for node in nodes if node.namespace == namespace)
            parts.append(f"  {namespace}\n" + "\n".join(names) + "\n")
        return "".join(parts)


def _label(node: Node) -> str:
    return f"{node.name} ({node.package}/{node.type})" if node.name else f"{node.package}/{node.type}"


def _value_text(value: object) -> str:
    text = str(value)
    text = text if len(text) <= _MAX_VALUE else f"{text[: _MAX_VALUE - 3]}..."
    if all(" " <= character <= "~" for character in text):
        return text
    text = text.rstrip()
    return text if all(" " <= character <= "~" for character in text) else "<...>"
