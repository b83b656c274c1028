"""`trundle tf echo`: transform between two frames, as tf_echo prints it."""

import argparse
import math
import time
from collections.abc import Sequence

from trundle.base.diagnostics import UsageError
from trundle.ros import Transform, TransformBuffer, TransformError, TransformListener, follow_time

from ..graph_command import running_node
from ..yaml_input import yaml_value

_FIRST_TIMEOUT_S = 1.0
"""Timeout of the first transform before failures are printed."""
_DIGITS = range(16)


def main(args: argparse.Namespace) -> int:
    """Print until the count is reached, or Ctrl-C."""
    rate = _number(args, "rate", args.rate if args.rate is not None else 1.0)
    if not rate > 0:
        raise UsageError("the rate must be greater than zero")
    digits = int(_number(args, "precision", 3))
    if digits not in _DIGITS:
        raise UsageError(f"the precision lies between 0 and {_DIGITS[-1]}, got {digits}")
    if "precision" in args.words.params:
        print(f"Precision default value was overriden, new value: {digits}")
    printed = 0
    with running_node("tf_echo", args.words) as (loop, node):
        clock = loop.run(follow_time(node))
        listener = TransformListener(node)

        async def lookup() -> Transform | str:
            try:
                return listener.buffer.lookup_transform(args.source, args.target)
            except TransformError as error:
                return f"{error}\nThe current list of frames is:\n{_frames(listener.buffer)}"

        loop.run(node.wait_connected(), timeout_s=None)
        deadline_s = time.monotonic() + _FIRST_TIMEOUT_S
        while isinstance(transform := loop.run(lookup()), str) and time.monotonic() < deadline_s:
            time.sleep(0.01)
        while True:
            if isinstance(transform, str):
                print(f"Failure at {clock.now_ns() / 1e9:.9f}\nException thrown:{transform}", flush=True)
            else:
                print(_text(transform, digits), flush=True)
            printed += 1
            if args.count is not None and printed >= args.count:
                return 1 if isinstance(transform, str) else 0
            time.sleep(1.0 / rate)
            transform = loop.run(lookup())


def _number(args: argparse.Namespace, name: str, default: float) -> float:
    """Return a private parameter such as `_rate:=5`, else the default."""
    text = args.words.params.get(name)
    value = default if text is None else yaml_value(text)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise UsageError(f"_{name}:= takes a number, got {text!r}")
    return value


def _text(transform: Transform, digits: int) -> str:
    w, x, y, z = transform.rotation
    rpy = _rpy(w, x, y, z)
    return (
        f"At time {transform.stamp_ns / 1e9:.{digits}f}\n"
        f"- Translation: {_list(transform.translation, digits)}\n"
        f"- Rotation: in Quaternion {_list((x, y, z, w), digits)}\n"
        f"            in RPY (radian) {_list(rpy, digits)}\n"
        f"            in RPY (degree) {_list(tuple(map(math.degrees, rpy)), digits)}"
    )


def _list(values: Sequence[float], digits: int) -> str:
    return f"[{', '.join(f'{value:.{digits}f}' for value in values)}]"


def _rpy(w: float, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return roll, pitch, yaw [rad] by tf's formulas, with the same signs of zeros: a level frame has pitch -0."""
    sine = 2 * (x * z - w * y)
    if abs(sine) >= 1:
        roll = math.atan2(2 * (w * z - x * y) * math.copysign(1, sine), -2 * (x * z + w * y) * math.copysign(1, sine))
        return roll, math.copysign(math.pi / 2, -sine), 0.0
    roll = math.atan2(2 * (y * z + w * x), 1 - 2 * (x * x + y * y))
    yaw = math.atan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z))
    return roll, -math.asin(sine), yaw


def _frames(buffer: TransformBuffer) -> str:
    frames = buffer.frames().items()
    return "".join(f"Frame {child} exists with parent {parent}.\n" for child, parent in frames if parent is not None)
