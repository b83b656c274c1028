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
        file: SDF, URDF or xacro; a folder with model.config; model://NAME; or a `Model` or `World`.
        seed: seed of all random numbers.
        plugins: run the file's plugins, with ROS if `ros` is set; loaded plugins are listed in `report`.
        ros: join the ROS graph at ROS_MASTER_URI, or start a master if there is none; a master's URI joins its
            graph. `close` the simulation, or use it in a `with` statement.

    Raises:
        TrundleError: one sentence with file and line. Warnings are in the simulation's `report`.
    """
    from os import PathLike, fspath

    from trundle.live.loaded_simulation import load_simulation

    source = fspath(file) if isinstance(file, str | PathLike) else file
    return load_simulation(source, seed=seed, plugins=plugins, ros=ros)


def sweep(
    plan: "str | PathLike[str] | Mapping[str, object]",
    *,
    output: "str | PathLike[str] | None" = None,
    workers: int | None = None,
    address: str | None = None,
) -> "SweepResult":
    """Run a world many times with different values; needs the extra `sweep`.

    A call with the same plan continues the interrupted one.

    Args:
        plan: plan file, or its content as a dictionary, with paths relative to the working directory.
        output: folder of the results; None: next to the plan's file, or `plan.sweep` in the working directory.
        workers: number of processes; None: one for each processor.
        address: address of a Ray cluster, "auto" for this machine's cluster, "local" for a new one; None: processes of
            this machine, without Ray.

    Raises:
        TrundleError: one sentence with file and line.
        KeyboardInterrupt: Ctrl-C; finished runs are kept.
    """
    from pathlib import Path

    from trundle.studies.sweep.run_sweep import sweep_plan

    folder = None if output is None else Path(output)
    return sweep_plan(plan, output=folder, workers=workers, address=address)


def dataset(
    plan: "str | PathLike[str] | Mapping[str, object]",
    *,
    output: "str | PathLike[str] | None" = None,
    workers: int | None = None,
    address: str | None = None,
) -> "DatasetResult":
    """Make annotated pictures of a varied world, to train computer vision.

    A call with the same plan continues the interrupted one.

    Args:
        plan: plan file, or its content as a dictionary, with paths relative to the working directory.
        output: folder of the dataset; None: next to the plan's file, or `plan.dataset` in the working directory.
        workers: number of processes; None: one for each processor.
        address: address of a Ray cluster whose nodes share the folder; None: only this machine.

    Raises:
        TrundleError: one sentence with file and line.
        KeyboardInterrupt: Ctrl-C; finished pictures are kept.
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
