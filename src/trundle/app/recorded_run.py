"""Recorded run: its state log, and the world in it."""

import os
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.robots.description import load_text
from trundle.robots.model import flattened
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation, StateLog, read_state_log


def open_recording(file: Path, report: Diagnostics) -> tuple[StateLog, Simulation]:
    """Read a state log; return it with a simulation of its world, which does not run.

    Raises:
        DescriptionError: the file is not a state log, is empty, or its world cannot be read.
    """
    log = read_state_log(file)
    if len(log.times_s) == 0:
        raise DescriptionError(Source(str(file)), "nothing was recorded")
    packages = Packages(dict(os.environ), start=Path.cwd())
    loaded = load_text(log.sdf, name=str(file), folder=file.parent, packages=packages, report=report)
    simulation = Simulation(flattened(loaded.world), report)
    if simulation.engine.compiled.link_names != log.links:
        raise DescriptionError(Source(str(file), 1), "the world in this log has other links than were recorded")
    return log, simulation
