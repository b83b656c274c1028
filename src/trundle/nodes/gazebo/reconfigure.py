"""/gazebo's physics as options of dynamic_reconfigure."""

from trundle.ros import Node, Option, Options, ReconfigureServer

from ..host import Simulator
from .changes import set_physics

_MOST_GRAVITY = 100.0
_FASTEST_HZ = 1_000_000.0


def advertise_options(node: Node, simulator: Simulator) -> None:
    """Offer gravity and max_update_rate; time_step is told, and stays; ODE's own options have no counterpart."""
    physics = simulator.simulation.world.physics
    step_s = physics.max_step_size_s
    pulls = [
        Option(name=f"gravity_{axis}", value=value, lower=-_MOST_GRAVITY, upper=_MOST_GRAVITY, description="[m/s²]")
        for axis, value in zip("xyz", physics.gravity, strict=True)
    ]
    rate = Option(
        name="max_update_rate",
        value=physics.real_time_update_rate_hz,
        lower=0.0,
        upper=_FASTEST_HZ,
        description="Steps a second of the wall; 0: as many as there can be",
    )
    step = Option(
        name="time_step",
        value=step_s,
        lower=step_s,
        upper=step_s,
        description="[s]; stays while the simulation runs",
    )

    def apply(values: Options) -> Options:
        x, y, z = (float(values[pull.name]) for pull in pulls)
        set_physics(simulator, gravity=(x, y, z), rate_hz=float(values[rate.name]))
        return values

    ReconfigureServer(node, [step, rate, *pulls], apply)
