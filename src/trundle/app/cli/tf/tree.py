"""`trundle tf tree`: the tf tree as text, image or Graphviz file."""

import argparse
import sys
import time
from collections.abc import Iterator, Mapping
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.drawing.tree import TreeNode, tree_svg, tree_text
from trundle.ros import follow_time

from ..graph_command import running_node
from .traffic import FrameStatistics, TransformMonitor

_SUFFIXES = (".svg", ".gv", ".dot")


def main(args: argparse.Namespace) -> int:
    """Listen for a while, then draw."""
    target = Path(args.output) if args.output else None
    if target is not None and target.suffix not in _SUFFIXES:
        raise UsageError(f"{target} ends in none of {', '.join(_SUFFIXES)}")
    with running_node("view_frames", args.words) as (loop, node):
        clock = loop.run(follow_time(node))
        traffic = TransformMonitor(node, clock)
        if target is not None:
            print(f"Listening to /tf for {args.time:.1f} seconds", flush=True)
        loop.run(node.wait_connected(), timeout_s=None)
        time.sleep(max(0.0, args.time))
        now_s = clock.now_ns() / 1e9

        async def frames() -> list[FrameStatistics]:
            return sorted(traffic.frames.values(), key=lambda frame: frame.child)

        statistics = loop.run(frames())
    if not statistics:
        raise UsageError("no tf data received")
    for line in _faults(statistics, traffic.other_parents):
        print(f"WARNING: {line}", file=sys.stderr)
    if target is None:
        print(tree_text(_roots(statistics, now_s)))
        return 0
    text = (
        tree_svg(_roots(statistics, now_s), title="tf frames")
        if target.suffix == ".svg"
        else _graphviz(statistics, now_s)
    )
    write_atomically(target, text)
    print(f"{target} generated")
    return 0


def _faults(frames: list[FrameStatistics], other_parents: Mapping[str, set[tuple[str, str]]]) -> Iterator[str]:
    """Yield reasons why lookups between frames fail."""
    roots = sorted({frame.parent for frame in frames} - {frame.child for frame in frames})
    if len(roots) > 1:
        yield f"{len(roots)} unconnected trees; roots: {', '.join(map(repr, roots))}"
    for child, parents in sorted(other_parents.items()):
        names = " and ".join(f"{parent!r} (by {caller})" for parent, caller in sorted(parents))
        yield f"{child!r} has alternating parents: {names}; a frame must have one parent"


def _roots(frames: list[FrameStatistics], now_s: float) -> list[TreeNode]:
    nodes = {frame.child: TreeNode(frame.child, _edge(frame, now_s)) for frame in frames}
    roots: list[TreeNode] = []
    for frame in frames:
        if frame.parent not in nodes:
            nodes[frame.parent] = TreeNode(frame.parent)
            roots.append(nodes[frame.parent])
        nodes[frame.parent].children.append(nodes[frame.child])
    if not roots:
        raise UsageError(f"the tf tree is a loop through {frames[0].child!r}")
    return sorted(roots, key=lambda root: root.label)


def _edge(frame: FrameStatistics, now_s: float) -> str:
    if frame.is_static:
        return f"static, by {frame.caller}"
    rate = "" if frame.rate_hz is None else f"{frame.rate_hz:.1f} Hz, "
    return f"{rate}{max(0.0, now_s - max(frame.stamps)):.3f} s old, by {frame.caller}"


def _graphviz(frames: list[FrameStatistics], now_s: float) -> str:
    """Return Graphviz text as view_frames writes it."""
    lines = ["digraph G {"]
    for frame in frames:
        rate = 10000.0 if frame.rate_hz is None else frame.rate_hz
        lines.append(
            f'"{_quoted(frame.parent)}" -> "{_quoted(frame.child)}"[label="Broadcaster: {_quoted(frame.caller)}\\n'
            f"Average rate: {rate:.3f} Hz\\nMost recent transform: {max(frame.stamps):.3f} "
            f"( {now_s - max(frame.stamps):.3f} sec old)\\n"
            f'Buffer length: {max(frame.stamps) - min(frame.stamps):.3f} sec\\n"];'
        )
    lines += ["edge [style=invis];", ' subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";']
    lines.append(f'"Recorded at time: {now_s:.3f}"[ shape=plaintext ] ;')
    children = {frame.child for frame in frames}
    root = next((frame.parent for frame in frames if frame.parent not in children), frames[0].parent)
    return "\n".join([*lines, f' }}->"{_quoted(root)}";', "}", ""])


def _quoted(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')
