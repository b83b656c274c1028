"""Trundle runs the robots of the ROS 1 and Gazebo-classic world anywhere Python runs.

import trundle

sim = trundle.load("model.sdf")
sim.run(2.0)
print(sim["my_robot"].joint("body_camera_base").position)
"""

TYPE_CHECKING = False  # not from `typing`: its import is half of a light command's start
if TYPE_CHECKING:
    from trundle.simulation import Simulation

__version__ = "0.1.0"
__all__ = ["__version__", "load"]


def load(file: str, *, seed: int = 0) -> "Simulation":
    """Load a robot or world, ready to simulate; a robot alone gets a ground plane and a sun.

    Args:
        file: SDF, URDF or xacro; a folder with model.config; or model://NAME.
        seed: of all random numbers.

    Raises:
        TrundleError: one sentence with file and line. Warnings are in the simulation's `report`.
    """
    from trundle.bringup.world_setup import load_simulation

    return load_simulation(file, seed=seed)
