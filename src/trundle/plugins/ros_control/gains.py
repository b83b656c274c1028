"""PID gains of controllers and joints: read from parameters, changed while they run."""

from trundle.control import ToolboxPid
from trundle.ros import Node, NodeParams, Option, Options, ReconfigureServer

from .controller import Endpoints

_MAX_P = 100_000.0
_MOST = 1_000.0
"""control_toolbox's bounds, of p and of everything else."""


def reconfigurable_pid(node: Node, settings: NodeParams, endpoints: Endpoints) -> ToolboxPid:
    """Gains p, i, d, i_clamp (or i_clamp_min and i_clamp_max, whose smaller magnitude counts) and antiwindup.

    Users may change them while they are in use, as control_toolbox's.

    Args:
        node: of the robot; its callbacks run where the gains are used.
        settings: where the gains are.
        endpoints: of who uses them.

    Raises:
        ParamError: p is missing, or one is no number.
    """
    pid = _read_pid(settings)
    options = (
        Option(name="p", value=pid.p, lower=-_MAX_P, upper=_MAX_P, description="Proportional gain"),
        Option(name="i", value=pid.i, lower=-_MOST, upper=_MOST, description="Integral gain"),
        Option(name="d", value=pid.d, lower=-_MOST, upper=_MOST, description="Derivative gain"),
        Option(name="i_clamp_min", value=-pid.i_clamp, lower=-_MOST, upper=0.0, description="Least integral part"),
        Option(name="i_clamp_max", value=pid.i_clamp, lower=0.0, upper=_MOST, description="Greatest integral part"),
        Option(name="antiwindup", value=pid.antiwindup, description="Stop the integral at its clamp"),
    )

    def apply(values: Options) -> Options:
        clamps = [abs(float(values[name])) for name in ("i_clamp_min", "i_clamp_max")]
        pid.p, pid.i, pid.d = (float(values[name]) for name in "pid")
        pid.i_clamp, pid.antiwindup = min(clamps), bool(values["antiwindup"])
        return values

    endpoints.add(ReconfigureServer(node, options, apply, namespace=settings.where))
    return pid


def _read_pid(settings: NodeParams) -> ToolboxPid:
    clamps = [abs(settings.number(name)) for name in ("i_clamp_min", "i_clamp_max") if name in settings.names()]
    return ToolboxPid(
        p=settings.number("p"),
        i=settings.number("i", 0.0),
        d=settings.number("d", 0.0),
        i_clamp=min(clamps) if clamps else abs(settings.number("i_clamp", 0.0)),
        antiwindup=settings.flag("antiwindup", default=False),
    )
