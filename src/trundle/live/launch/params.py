"""Sets a launch's parameters on the server: dump and delete, then clear and set, in roslaunch's order."""

from collections.abc import Sequence
from pathlib import Path

import yaml

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import DescriptionError, UsageError
from trundle.robots.launch import LaunchParam, LaunchPlan
from trundle.ros import Node, ParameterError


async def set_params(node: Node, plan: LaunchPlan, params: Sequence[LaunchParam]) -> None:
    """Dump, delete, clear and set parameters before any node starts.

    Raises:
        DescriptionError: an invalid parameter value, or a file that cannot be written.
    """
    await node.wait_registered()
    for step in plan.steps:
        if step.command == "delete":
            if await node.params.has(step.name):
                await node.params.delete(step.name)
            continue
        try:
            write_atomically(Path(step.file), yaml.safe_dump(await node.params.get(step.name, {})))
        except UsageError as error:
            raise DescriptionError(step.at, f"rosparam dump: {error}", "rosparam") from None
    for namespace in plan.clear_params:
        if await node.params.has(namespace):
            await node.params.delete(namespace)
    for param in params:
        if param.value is None:  # the reader has reported it
            continue
        try:
            await node.params.set(param.name, param.value)
        except ParameterError as error:
            raise DescriptionError(param.at, str(error), "launch-param") from None
