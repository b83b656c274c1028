"""PID gains of controllers and joints: from parameters, and by dynamic_reconfigure."""

from trundle.robots.parameters import RosParameters
from trundle.ros import Node, Option, Options, ReconfigureServer
from trundle.sim.control import ToolboxPid

from .controller import Endpoints

_MAX_P = 100_000.0
_MAX_GAIN = 1_000.0
"""Bounds of p and of the other gains, from control_toolbox."""


def reconfigurable_pid(node: Node, settings: RosParameters, endpoints: Endpoints) -> ToolboxPid:
    """Read gains p, i, d, i_clamp (or the smaller of |i_clamp_min| and |i_clamp_max|) and antiwindup.

    dynamic_reconfigure changes them at run time, as in control_toolbox.

    Args:
        node: robot's node; its callbacks run on the thread that uses the gains.
        settings: parameters of the gains.
        endpoints: endpoints to which the reconfigure server is added.

    Raises:
        ParamError: p is missing, or a gain is not a number.
    """
    pid = _read_pid(settings)
    options = (
        Option(name="p", value=pid.p, lower=-_MAX_P, upper=_MAX_P, description="Proportional gain"),
        Option(name="i", value=pid.i, lower=-_MAX_GAIN, upper=_MAX_GAIN, description="Integral gain"),
        Option(name="d", value=pid.d, lower=-_MAX_GAIN, upper=_MAX_GAIN, description="Derivative gain"),
        Option(
            name="i_clamp_min",
            value=-pid.i_clamp,
            lower=-_MAX_GAIN,
            upper=0.0,
            description="Minimum of the integral term",
        ),
        Option(
            name="i_clamp_max",
            value=pid.i_clamp,
            lower=0.0,
            upper=_MAX_GAIN,
            description="Maximum of the integral term",
        ),
        Option(name="antiwindup", value=pid.antiwindup, description="Stop the integral at its clamp"),
    )

    def apply(values: Options) -> Options:
        clamps = [abs(float(values[name])) for name in ("i_clamp_min", "i_clamp_max")]
        pid.p, pid.i, pid.d = (float(values[name]) for name in "pid")
        pid.i_clamp, pid.antiwindup = min(clamps), bool(values["antiwindup"])
        return values

    endpoints.add(ReconfigureServer(node, options, apply, namespace=settings.namespace))
    return pid


def _read_pid(settings: RosParameters) -> ToolboxPid:
    clamps = [abs(settings.number(name)) for name in ("i_clamp_min", "i_clamp_max") if name in settings]
    return ToolboxPid(
        p=settings.number("p"),
        i=settings.number("i", 0.0),
        d=settings.number("d", 0.0),
        i_clamp=min(clamps) if clamps else abs(settings.number("i_clamp", 0.0)),
        antiwindup=settings.flag("antiwindup", default=False),
    )
