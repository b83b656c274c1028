"""A node's private parameters, read once when it starts."""

from trundle.robots.parameters import RosParameters
from trundle.ros import Node


async def private_parameters(node: Node) -> RosParameters:
    """Read all parameters below the node's name."""
    return RosParameters(await node.params.get("~", {}), node.name)
