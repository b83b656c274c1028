"""`trundle tf monitor`: delays and rates, as tf_monitor prints them."""

import argparse
import time
from dataclasses import dataclass

from trundle.ros import Clock, GraphLoop, Node, TransformBuffer, TransformError, TransformListener, follow_time

from ..graph_command import running_node
from .traffic import TransformMonitor

_PERIOD_S = 1.0
_SAMPLE_S = 0.01
"""Sampling interval of a chain's delay."""


def main(args: argparse.Namespace) -> int:
    """Print a table every second until the count is reached, or Ctrl-C."""
    if len(args.frames) not in (0, 2):
        args.refuse("monitor takes two frames, or none for all of them")
    printed = 0
    with running_node("tf_monitor", args.words) as (loop, node):
        clock = loop.run(follow_time(node))
        traffic = TransformMonitor(node, clock)
        monitored = _MonitoredChain.create(node, clock, *args.frames) if args.frames else None
        loop.run(node.wait_connected(), timeout_s=None)
        if monitored is not None:
            _wait(loop, monitored)

        async def table() -> str:
            return _table(traffic, monitored)

        while args.count is None or printed < args.count:
            if monitored is None:
                time.sleep(_PERIOD_S)
            else:
                _run_until_report(loop, monitored)
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
    samples: int = 0
    total_s: float = 0.0
    max_s: float = 0.0

    @classmethod
    def create(cls, node: Node, clock: Clock, target: str, source: str) -> "_MonitoredChain":
        return cls(target, source, TransformListener(node).buffer, clock, [])

    async def measure_delay(self) -> bool:
        """Sample the age of the newest transform; False if there is none."""
        try:
            transform = self.buffer.lookup_transform(self.target, self.source)
        except TransformError:
            return False
        self.chain = self.buffer.path(self.target, self.source)
        age_s = (self.clock.now_ns() - transform.stamp_ns) / 1e9 if transform.stamp_ns else 0.0
        self.samples += 1
        self.total_s += age_s
        self.max_s = max(self.max_s, age_s)
        return True


def _wait(loop: GraphLoop, monitored: _MonitoredChain) -> None:
    text = f"Waiting for transform chain to become available between {monitored.target} and {monitored.source} "
    print(text, end="", flush=True)
    while not loop.run(monitored.measure_delay()):
        print(".", end="", flush=True)
        time.sleep(_PERIOD_S)
    print()


def _run_until_report(loop: GraphLoop, monitored: _MonitoredChain) -> None:
    deadline_s = time.monotonic() + _PERIOD_S
    while time.monotonic() < deadline_s:
        loop.run(monitored.measure_delay())
        time.sleep(_SAMPLE_S)


def _table(traffic: TransformMonitor, monitored: _MonitoredChain | None) -> str:
    lines = ["", "", "", "RESULTS: for all Frames"]
    if monitored is not None:
        average = monitored.total_s / monitored.samples
        lines[-1] = f"RESULTS: for {monitored.target} to {monitored.source}"
        lines.append(f"Chain is: {' -> '.join(monitored.chain)}")
        lines.append(f"Net delay     avg = {average:g}: max = {monitored.max_s:g}")
    lines += ["", "Frames:"]
    for child, frame in sorted(traffic.frames.items()):
        if monitored is not None and child not in monitored.chain:
            continue
        average, maximum = sum(frame.delays) / len(frame.delays), max(frame.delays)
        lines.append(f"Frame: {child} published by {frame.caller} Average Delay: {average:g} Max Delay: {maximum:g}")
    lines += ["", "All Broadcasters:"]
    for name, sender in sorted(traffic.senders.items()):
        span = sender.arrivals[-1] - sender.arrivals[0]
        rate = (len(sender.arrivals) - 1) / span if span > 0 else 0.0
        average = sum(sender.delays) / len(sender.delays) if sender.delays else 0.0
        maximum = max(sender.delays, default=0.0)
        lines.append(f"Node: {name} {rate:g} Hz, Average Delay: {average:g} Max Delay: {maximum:g}")
    return "\n".join(lines)
