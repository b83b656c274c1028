"""Puts a launch's parameters on the server: dump and delete, then clear and set, in roslaunch's order."""

from collections.abc import Sequence
from pathlib import Path

import yaml

from trundle.diagnostics import DescriptionError
from trundle.launch import LaunchParam, LaunchPlan
from trundle.ros import Node, ParameterError


async def set_params(node: Node, plan: LaunchPlan, params: Sequence[LaunchParam]) -> None:
    """Do all of it; before any node starts.

    Raises:
        DescriptionError: a value that parameters cannot hold, or a file that cannot be written.
    """
    await node.wait_registered()
    for step in plan.steps:
        if step.command == "delete":
            if await node.has_param(step.name):
                await node.delete_param(step.name)
            continue
        try:
            Path(step.file).write_text(yaml.safe_dump(await node.get_param(step.name, {})))
        except OSError as error:
            raise DescriptionError(step.at, f"rosparam dump to {step.file!r}: {error.strerror}") from None
    for namespace in plan.clear_params:
        if await node.has_param(namespace):
            await node.delete_param(namespace)
    for param in params:
        if param.value is None:  # the reader has said so
            continue
        try:
            await node.set_param(param.name, param.value)
        except ParameterError as error:
            raise DescriptionError(param.at, str(error)) from None
