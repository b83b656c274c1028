"""`trundle tf echo`: where one frame is in another, as tf_echo prints it."""

import argparse
import math
import time

from trundle.diagnostics import UsageError
from trundle.ros import Transform, TransformBuffer, TransformError, TransformListener, follow_time

from .running import running_node

_FIRST_S = 1.0
"""How long the first transform may take before that is said."""


def main(args: argparse.Namespace) -> int:
    """Print until enough or Ctrl-C."""
    if not args.rate > 0:
        raise UsageError("the rate must be greater than zero")
    printed = 0
    with running_node("tf_echo") as (loop, node):
        clock = loop.run(follow_time(node))
        listener = TransformListener(node)

        async def look() -> Transform | str:
            try:
                return listener.buffer.lookup(args.source, args.target)
            except TransformError as error:
                return f"{error}\nThe current list of frames is:\n{_frames(listener.buffer)}"

        loop.run(node.linked(), timeout_s=None)
        until = time.monotonic() + _FIRST_S
        while isinstance(found := loop.run(look()), str) and time.monotonic() < until:
            time.sleep(0.01)
        while True:
            if isinstance(found, str):
                print(f"Failure at {clock.now_ns() / 1e9:.9f}\nException thrown:{found}", flush=True)
            else:
                print(_text(found), flush=True)
            printed += 1
            if args.count is not None and printed >= args.count:
                return 1 if isinstance(found, str) else 0
            time.sleep(1.0 / args.rate)
            found = loop.run(look())


def _text(transform: Transform) -> str:
    w, x, y, z = transform.rotation
    rpy = transform.pose.rpy
    return (
        f"At time {transform.stamp_ns / 1e9:.3f}\n"
        f"- Translation: {_list(transform.translation)}\n"
        f"- Rotation: in Quaternion {_list((x, y, z, w))}\n"
        f"            in RPY (radian) {_list(rpy)}\n"
        f"            in RPY (degree) {_list(tuple(map(math.degrees, rpy)))}"
    )


def _list(values: tuple[float, ...]) -> str:
    return f"[{', '.join(f'{value:.3f}' for value in values)}]"


def _frames(buffer: TransformBuffer) -> str:
    frames = buffer.frames().items()
    return "\n".join(f"Frame {child} exists with parent {parent or 'NO_PARENT'}." for child, parent in frames)
