"""Recording that a run's page compares with, read before anything starts."""

from pathlib import Path
from typing import Self

from msgspec import Struct

from trundle.base.diagnostics import UsageError
from trundle.page import BagReferenceFile
from trundle.page.bag.compared_bag import compared_bag
from trundle.page.simulated_world.reference import Reference, read_recording
from trundle.sim.simulation import Simulation, StateLog


class ComparedRecording(Struct, frozen=True, eq=False):
    """A bag, which is compared with topics, or a state log, with the world."""

    title: str
    bag: BagReferenceFile | None
    log: StateLog | None

    @classmethod
    def read(cls, file: Path, *, has_graph: bool) -> Self:
        """Read a user's file.

        Raises:
            TrundleError: the file is neither, is empty or damaged, or a bag without a graph.
            OSError: the file cannot be read.
        """
        bag = compared_bag(file)
        if bag is None:
            return cls(str(file), None, read_recording(file, str(file)))
        if not has_graph:
            raise UsageError(f"{file} is a bag, which is compared with topics: leave --no-ros out")
        return cls(str(file), bag, None)

    def reference(self, simulation: Simulation) -> Reference | None:
        """Return a state log as the reference of a world; None for a bag.

        Raises:
            UsageError: it was recorded in another world.
        """
        return None if self.log is None else Reference(self.log, self.title, simulation, start=0.0)
