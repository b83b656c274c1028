"""Trundle runs the robots of the ROS 1 and Gazebo-classic world anywhere Python runs.

import trundle

sim = trundle.load("model.sdf")
sim.run(2.0)
print(sim["my_robot"].joint("body_camera_base").position)
"""

TYPE_CHECKING = False  # not from `typing`: its import is half of a light command's start
if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike
    from typing import Literal

    from trundle.live.loaded_simulation import LoadedSimulation
    from trundle.robots.description import Model, World
    from trundle.studies.dataset.make_dataset import DatasetResult
    from trundle.studies.sweep.run_sweep import SweepResult

__version__ = "0.1.0"
__all__ = ["Model", "World", "__version__", "dataset", "load", "sweep"]


def load(
    file: "str | PathLike[str] | Model | World", *, seed: int = 0, plugins: bool = False, ros: bool | str = False
) -> "LoadedSimulation":
    """Load a robot or world, ready to simulate; a robot alone gets a ground plane and a sun.

    Args:
        file: SDF, URDF or xacro; a folder with model.config; model://NAME; or what was built with `Model` or `World`.
        seed: of all random numbers.
        plugins: run the plugins that the file asks for, with ROS where `ros` says so; what they load is in `report`.
        ros: be part of a ROS graph: the one that ROS_MASTER_URI names, else one that is started here; a master's URI
            joins that one. `close` the simulation, or use it in a `with` statement.

    Raises:
        TrundleError: one sentence with file and line. Warnings are in the simulation's `report`.
    """
    from os import PathLike, fspath

    from trundle.live.loaded_simulation import load_simulation

    read = fspath(file) if isinstance(file, str | PathLike) else file
    return load_simulation(read, seed=seed, plugins=plugins, ros=ros)


def sweep(
    plan: "str | PathLike[str] | Mapping[str, object]",
    *,
    output: "str | PathLike[str] | None" = None,
    workers: int | None = None,
    address: str | None = None,
    device: 'Literal["cpu", "cuda"]' = "cpu",
) -> "SweepResult":
    """Run a world many times with different values; needs the extra `sweep`.

    A call for the same plan goes on where the last one stopped.

    Args:
        plan: a plan's file, or its content as a dictionary, whose relative paths start in the working directory.
        output: folder of the results; None: beside the plan's file, or `plan.sweep` in the working directory.
        workers: number of processes; None: one for each processor.
        address: of a Ray cluster, "auto" for the one of this machine, "local" for a new one; None: processes of this
            machine, without Ray.
        device: "cuda" steps many rows at once on an NVIDIA GPU, in single precision; without one a line says so, and
            the processors run them.

    Raises:
        TrundleError: one sentence with file and line.
        KeyboardInterrupt: Ctrl-C; what has been run is kept.
    """
    from pathlib import Path

    from trundle.studies.sweep.run_sweep import sweep_plan

    folder = None if output is None else Path(output)
    return sweep_plan(plan, output=folder, workers=workers, address=address, device=device)


def dataset(
    plan: "str | PathLike[str] | Mapping[str, object]",
    *,
    output: "str | PathLike[str] | None" = None,
    workers: int | None = None,
    address: str | None = None,
) -> "DatasetResult":
    """Make annotated pictures of a varied world, to train vision on.

    A call for the same plan goes on where the last one stopped.

    Args:
        plan: a plan's file, or its content as a dictionary, whose relative paths start in the working directory.
        output: folder of the dataset; None: beside the plan's file, or `plan.dataset` in the working directory.
        workers: number of processes; None: one for each processor.
        address: of a Ray cluster whose nodes share that folder; None: this machine alone.

    Raises:
        TrundleError: one sentence with file and line.
        KeyboardInterrupt: Ctrl-C; what has been made is kept.
    """
    from pathlib import Path

    from trundle.studies.dataset.make_dataset import make_planned

    return make_planned(plan, output=None if output is None else Path(output), workers=workers, address=address)


def __getattr__(name: str) -> object:
    """`Model` and `World`, imported on first use."""
    if name in ("Model", "World"):
        from trundle.robots import description

        return getattr(description, name)
    raise AttributeError(f"module 'trundle' has no attribute {name!r}")
