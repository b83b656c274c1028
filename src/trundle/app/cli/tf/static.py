"""`trundle tf static`: publishes a static transform until Ctrl-C."""

import argparse

from trundle.gazebo.nodes import BUILTIN_NODES, BuiltinReplacement, NodeHost, run_builtin_node

from ..graph_command import running_node


def main(args: argparse.Namespace) -> int:
    """Run the node static_transform_publisher of tf2_ros."""
    stand_in = BuiltinReplacement(BUILTIN_NODES["tf2_ros", "static_transform_publisher"])
    with running_node("static_transform_publisher", args.words) as (loop, node):
        return 1 if loop.run(run_builtin_node(stand_in, node, args.numbers, NodeHost()), None) else 0
