"""/gazebo's physics properties as dynamic_reconfigure options."""

from trundle.ros import Node, Option, Options, ReconfigureServer

from ..host import Simulator
from .ode import IGNORED, OdeSettings
from .property_setters import MAX_STEP_S, MIN_STEP_S, set_physics

_MAX_GRAVITY = 100.0
_MAX_RATE_HZ = 1_000_000.0


def advertise_options(node: Node, simulator: Simulator, ode: OdeSettings) -> None:
    """Advertise gazebo_ros' options; changes of ODE's own settings, which have no effect, are logged."""
    physics = simulator.simulation.world.physics
    gravity = [
        Option(name=f"gravity_{axis}", value=value, lower=-_MAX_GRAVITY, upper=_MAX_GRAVITY, description="[m/s²]")
        for axis, value in zip("xyz", physics.gravity, strict=True)
    ]
    rate = Option(
        name="max_update_rate",
        value=physics.real_time_update_rate_hz,
        lower=0.0,
        upper=_MAX_RATE_HZ,
        description="Steps per second of wall time; 0: as fast as possible",
    )
    step = Option(
        name="time_step", value=physics.max_step_size_s, lower=MIN_STEP_S, upper=MAX_STEP_S, description="[s]"
    )
    settings = ode.options()

    def apply(values: Options) -> Options:
        x, y, z = (float(values[component.name]) for component in gravity)
        step_s, rate_hz = float(values[step.name]), float(values[rate.name])
        set_physics(simulator, step_s=step_s, gravity=(x, y, z), rate_hz=rate_hz)
        ode_values = {
            name: value for name, value in values.items() if name in ode.values and not isinstance(value, str)
        }
        ignored = ode.update(ode_values)
        if ignored:
            node.log.warn(f"{IGNORED}{', '.join(ignored)}")
        return values

    ReconfigureServer(node, [step, rate, *gravity, *settings], apply)
