"""`trundle tf static`: publishes a transform that never changes, until Ctrl-C."""

import argparse

from trundle.nodes import STAND_INS, Host, Replacement, run_stand_in

from .running import running_node


def main(args: argparse.Namespace) -> int:
    """Be tf2_ros' static_transform_publisher."""
    stand_in = Replacement(STAND_INS["tf2_ros", "static_transform_publisher"])
    with running_node("static_transform_publisher", args.words) as (loop, node):
        return 1 if loop.run(run_stand_in(stand_in, node, args.numbers, Host()), None) else 0
