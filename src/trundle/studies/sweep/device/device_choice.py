"""Choice of the device that steps the rows of a sweep."""

import sys
from typing import Literal, TypeAlias

from trundle.base.console import say
from trundle.base.diagnostics import UsageError
from trundle.sim.physics import NoGpuError, find_gpu

from ..plan import Plan
from .plan_check import check_plan

Device: TypeAlias = Literal["cpu", "cuda"]
DEVICES: tuple[Device, ...] = ("cpu", "cuda")


def gpu_of(plan: Plan, device: str, *, workers: int | None, address: str | None) -> str | None:
    """Return Warp's name of the GPU that steps a plan's rows; None if the processors run them.

    A message is printed if there is no GPU.

    Raises:
        UsageError: unknown device, or options for processes.
        DescriptionError: the plan has a feature that GPUs do not support.
    """
    if device not in DEVICES:
        raise UsageError(f"device={device!r}: rows are stepped on {' or '.join(map(repr, DEVICES))}")
    if device == "cpu":
        return None
    if workers is not None or address is not None:
        message = "a GPU steps the rows of this process; leave out `workers` and `address`, or `device`"
        raise UsageError(f"device={device!r}: {message}")
    check_plan(plan)
    try:
        return find_gpu()
    except NoGpuError as error:
        say(f"device={device!r}: {error}; the rows are run by the processors", sys.stderr)
        return None
