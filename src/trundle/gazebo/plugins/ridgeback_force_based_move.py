"""libridgeback_ros_force_based_move.so: hector's force-based move, with commands that expire."""

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation

from .hector_gazebo.force_based_move import ForceBasedMove


class RidgebackForceBasedMove(ForceBasedMove):
    """Stops <cmdVelTimeOut> (0.25 [s]) after the last command; odometry excludes sideways motion."""

    SIDEWAYS = False

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)
        self._timeout_s = parameters.number("cmdVelTimeOut", 0.25)

    def before_step(self, sim: Simulation) -> None:
        """Apply the force and torque."""
        if (sim.time_ns - self.command.stamp_ns) / 1e9 > self._timeout_s:
            self.command.stop()
        super().before_step(sim)
