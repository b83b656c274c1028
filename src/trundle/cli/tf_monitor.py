"""`trundle tf monitor`: delays and rates, as tf_monitor prints them."""

import argparse
import time

from trundle.ros import follow_time

from .running import running_node
from .tf_traffic import TransformTraffic

_EVERY_S = 1.0


def main(args: argparse.Namespace) -> int:
    """Print a table every second until enough or Ctrl-C."""
    printed = 0
    with running_node("tf_monitor") as (loop, node):
        traffic = TransformTraffic(node, loop.run(follow_time(node)))

        loop.run(node.linked(), timeout_s=None)

        async def table() -> str:
            return _table(traffic)

        while args.count is None or printed < args.count:
            time.sleep(_EVERY_S)
            print(loop.run(table()), flush=True)
            printed += 1
    return 0


def _table(traffic: TransformTraffic) -> str:
    lines = ["", "", "", "RESULTS: for all Frames", "", "Frames:"]
    for child, frame in sorted(traffic.frames.items()):
        average, most = sum(frame.delays) / len(frame.delays), max(frame.delays)
        lines.append(f"Frame: {child} published by {frame.caller} Average Delay: {average:g} Max Delay: {most:g}")
    lines += ["", "All Broadcasters:"]
    for name, sender in sorted(traffic.senders.items()):
        span = sender.arrivals[-1] - sender.arrivals[0]
        rate = (len(sender.arrivals) - 1) / span if span > 0 else 0.0
        average = sum(sender.delays) / len(sender.delays) if sender.delays else 0.0
        most = max(sender.delays, default=0.0)
        lines.append(f"Node: {name} {rate:g} Hz, Average Delay: {average:g} Max Delay: {most:g}")
    return "\n".join(lines)
