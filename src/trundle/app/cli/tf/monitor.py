"""`trundle tf monitor`: delays and rates, as tf_monitor prints them."""

import argparse
import time
from dataclasses import dataclass

from trundle.ros import Clock, GraphLoop, Node, TransformBuffer, TransformError, TransformListener, follow_time

from ..graph_command import running_node
from .traffic import TransformMonitor

_EVERY_S = 1.0
_LOOKED_S = 0.01
"""Sampling interval of a chain's delay."""


def main(args: argparse.Namespace) -> int:
    """Print a table every second until the count is reached, or Ctrl-C."""
    if len(args.frames) not in (0, 2):
        args.refuse("monitor takes two frames, or none for all of them")
    printed = 0
    with running_node("tf_monitor", args.words) as (loop, node):
        clock = loop.run(follow_time(node))
        traffic = TransformMonitor(node, clock)
        watched = _MonitoredChain.create(node, clock, *args.frames) if args.frames else None
        loop.run(node.wait_connected(), timeout_s=None)
        if watched is not None:
            _wait(loop, watched)

        async def table() -> str:
            return _table(traffic, watched)

        while args.count is None or printed < args.count:
            if watched is None:
                time.sleep(_EVERY_S)
            else:
                _run_until_report(loop, watched)
            print(loop.run(table()), flush=True)
            printed += 1
    return 0


@dataclass
class _MonitoredChain:
    """Transform chain between two frames, and its delay."""

    target: str
    source: str
    buffer: TransformBuffer
    clock: Clock
    chain: list[str]
    looks: int = 0
    total_s: float = 0.0
    most_s: float = 0.0

    @classmethod
    def create(cls, node: Node, clock: Clock, target: str, source: str) -> "_MonitoredChain":
        return cls(target, source, TransformListener(node).buffer, clock, [])

    async def measure_delay(self) -> bool:
        """Sample the age of the newest transform; False if there is none."""
        try:
            found = self.buffer.lookup_transform(self.target, self.source)
        except TransformError:
            return False
        self.chain = self.buffer.path(self.target, self.source)
        age_s = (self.clock.now_ns() - found.stamp_ns) / 1e9 if found.stamp_ns else 0.0
        self.looks += 1
        self.total_s += age_s
        self.most_s = max(self.most_s, age_s)
        return True


def _wait(loop: GraphLoop, watched: _MonitoredChain) -> None:
    text = f"Waiting for transform chain to become available between {watched.target} and {watched.source} "
    print(text, end="", flush=True)
    while not loop.run(watched.measure_delay()):
        print(".", end="", flush=True)
        time.sleep(_EVERY_S)
    print()


def _run_until_report(loop: GraphLoop, watched: _MonitoredChain) -> None:
    until = time.monotonic() + _EVERY_S
    while time.monotonic() < until:
        loop.run(watched.measure_delay())
        time.sleep(_LOOKED_S)


def _table(traffic: TransformMonitor, watched: _MonitoredChain | None) -> str:
    lines = ["", "", "", "RESULTS: for all Frames"]
    if watched is not None:
        average = watched.total_s / watched.looks
        lines[-1] = f"RESULTS: for {watched.target} to {watched.source}"
        lines.append(f"Chain is: {' -> '.join(watched.chain)}")
        lines.append(f"Net delay     avg = {average:g}: max = {watched.most_s:g}")
    lines += ["", "Frames:"]
    for child, frame in sorted(traffic.frames.items()):
        if watched is not None and child not in watched.chain:
            continue
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
