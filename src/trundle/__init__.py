"""Trundle runs the robots of the ROS 1 and Gazebo-classic world anywhere Python runs.

import trundle

sim = trundle.load("model.sdf")
sim.run(2.0)
print(sim["my_robot"].joint("body_camera_base").position)
"""

TYPE_CHECKING = False  # not from `typing`: its import is half of a light command's start
if TYPE_CHECKING:
    from os import PathLike

    from trundle.bringup.loaded_simulation import LoadedSimulation

__version__ = "0.1.0"
__all__ = ["__version__", "load"]


def load(
    file: "str | PathLike[str]", *, seed: int = 0, plugins: bool = False, ros: bool | str = False
) -> "LoadedSimulation":
    """Load a robot or world, ready to simulate; a robot alone gets a ground plane and a sun.

    Args:
        file: SDF, URDF or xacro; a folder with model.config; or model://NAME.
        seed: of all random numbers.
        plugins: run the plugins that the file asks for, with ROS where `ros` says so; what they load is in `report`.
        ros: be part of a ROS graph: the one that ROS_MASTER_URI names, else one that is started here; a master's URI
            joins that one. `close` the simulation, or use it in a `with` statement.

    Raises:
        TrundleError: one sentence with file and line. Warnings are in the simulation's `report`.
    """
    from trundle.bringup.loaded_simulation import load_simulation

    return load_simulation(str(file), seed=seed, plugins=plugins, ros=ros)
