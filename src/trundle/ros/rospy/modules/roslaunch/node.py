"""Nodes and tests of a launch file."""

from collections.abc import Sequence

from rosgraph.names import SEP, make_global_ns

from .machine import Machine

_TIME_LIMIT_S = 60.0


class Node:
    """Node of a launch file."""

    def __init__(
        self,
        package: str,
        node_type: str,
        name: str | None = None,
        namespace: str = "/",
        machine_name: str | None = None,
        args: str = "",
        respawn: bool = False,
        respawn_delay: float = 0.0,
        remap_args: Sequence[Sequence[str]] | None = None,
        env_args: Sequence[tuple[str, str]] | None = None,
        output: str | None = None,
        cwd: str | None = None,
        launch_prefix: str | None = None,
        required: bool = False,
        filename: str = "<unknown>",
    ) -> None:
        """Set the attributes.

        Raises:
            ValueError: a value that roslaunch refuses.
        """
        if respawn and required:
            raise ValueError("respawn and required cannot both be set to true")
        if name and SEP in name:
            raise ValueError("node name cannot contain a namespace")
        if not package.strip():
            raise ValueError("package must be non-empty")
        if not node_type.strip():
            raise ValueError("type must be non-empty")
        if output not in ("log", "screen", None):
            raise ValueError("output must be one of 'log', 'screen'")
        if cwd not in ("ros_home", "ROS_HOME", "node", None):
            raise ValueError("cwd must be one of 'ROS_HOME', 'node'")
        self.package = package
        self.type = node_type
        self.name = name or None
        self.namespace = make_global_ns(namespace or "/")
        self.machine_name = machine_name or None
        self.machine: Machine | None = None
        self.args = args or ""
        self.respawn = respawn
        self.respawn_delay = respawn_delay
        self.remap_args = list(remap_args or ())
        self.env_args = list(env_args or ())
        self.output = output
        self.cwd = "ROS_HOME" if cwd == "ros_home" else cwd
        self.launch_prefix = launch_prefix or None
        self.required = required
        self.filename = filename


class Test(Node):
    """Test of a launch file: a node."""

    def __init__(
        self,
        test_name: str,
        package: str,
        node_type: str,
        name: str | None = None,
        namespace: str = "/",
        machine_name: str | None = None,
        args: str = "",
        remap_args: Sequence[Sequence[str]] | None = None,
        env_args: Sequence[tuple[str, str]] | None = None,
        time_limit: float | None = None,
        cwd: str | None = None,
        launch_prefix: str | None = None,
        retry: int | None = None,
        filename: str = "<unknown>",
    ) -> None:
        """Set the attributes.

        Raises:
            ValueError: a value that roslaunch refuses.
        """
        super().__init__(
            package, node_type, name, namespace, machine_name, args, remap_args=remap_args, env_args=env_args,
            output="log", cwd=cwd, launch_prefix=launch_prefix, filename=filename,
        )  # fmt: skip
        self.test_name = test_name
        self.retry = retry or 0
        self.time_limit = float(time_limit or _TIME_LIMIT_S)
        if self.time_limit <= 0:
            raise ValueError("'time-limit' must be a positive number")
