"""`trundle.load`."""

import os
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from trundle.base.arguments import count_of, described
from trundle.base.diagnostics import Diagnostic, Diagnostics, TrundleWarning, UsageError
from trundle.robots.packages import Packages

from .loaded_simulation import LoadedSimulation
from .world_setup import load_built, load_world

if TYPE_CHECKING:
    from trundle.robots.description import Model, World


def load(
    file: "str | os.PathLike[str] | Model | World",
    *,
    seed: int = 0,
    plugins: bool = False,
    ros: bool | str = False,
    page: bool = False,
    warn: bool = True,
) -> LoadedSimulation:
    """Load a robot or world, ready to simulate; a robot alone gets a ground plane and a sun.

    Args:
        file: SDF, URDF or xacro; a folder with model.config; model://NAME; or a `Model` or `World`.
        seed: seed of all random numbers.
        plugins: run the file's plugins, with ROS if `ros` is set; loaded plugins are listed in `report`.
        ros: join the ROS graph at ROS_MASTER_URI, or start a master if there is none; a master's URI joins its
            graph. `close` the simulation, or use it in a `with` statement.
        page: open the page in the browser, or in a notebook, as `LoadedSimulation.view` does.
        warn: print what is not simulated as written, as Python's warnings, each with file and line; False: only
            collect it in the simulation's `report`.

    Raises:
        TrundleError: one sentence with file and line.
    """
    count_of(seed, "seed")
    environment = dict(os.environ)
    if isinstance(ros, str):
        environment["ROS_MASTER_URI"] = ros
    report = _PrintedDiagnostics() if warn else Diagnostics()
    packages = Packages(environment, start=Path.cwd())
    if isinstance(file, str | os.PathLike):
        loaded = load_world(os.fspath(file), packages, report, seed=seed)
    elif hasattr(file, "to_sdf"):  # its classes are not imported for a file
        loaded = load_built(file, packages, report, seed=seed)
    else:
        raise UsageError(f"load needs a file's path, model://NAME, a Model or a World, got {described(file)}")
    simulation = LoadedSimulation(loaded, report, environment, seed=seed)
    try:
        if ros:
            simulation.open_graph()
        if plugins:
            simulation.load_plugins()
        if page:
            simulation.view()
    except BaseException:
        simulation.close()
        raise
    return simulation


class _PrintedDiagnostics(Diagnostics):
    """Diagnostics whose warnings are also Python's, at the line of the file."""

    def _add(self, finding: Diagnostic) -> None:
        count = len(self.findings)
        super()._add(finding)
        if len(self.findings) > count and finding.severity == "warning":
            last, (file, line) = self.findings[-1], finding.at
            text = f"{last.what} [{last.id}]" if last.id else last.what
            warnings.warn_explicit(text, TrundleWarning, file, line or 1, module="trundle")
