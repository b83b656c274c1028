"""Comparison of a running simulation with a recording, for its page."""

from trundle.base.diagnostics import UsageError
from trundle.page import PageServer, SetReferenceOffset
from trundle.sim.simulation import Simulation, Snapshot, StateRecorder
from trundle.spatial import NS_PER_S

from ..world.manifest import Manifest
from .reference import Reference, RowReader


class LiveComparison:
    """Hook that samples a simulation as often as a state log does; belongs to the simulation's thread."""

    def __init__(self, server: PageServer) -> None:
        """Create it without a recording; `show` sets the simulation."""
        self._server = server
        self._simulation: Simulation | None = None
        self._reference: Reference | None = None

    @property
    def files(self) -> dict[str, bytes]:
        """URL → content of the recording's samples."""
        return {} if self._reference is None else self._reference.files

    def with_info(self, manifest: Manifest) -> Manifest:
        """Return a manifest with the recording, if there is one."""
        return manifest if self._reference is None else self._reference.with_info(manifest)

    def show(self, simulation: Simulation) -> None:
        """Compare another simulation, or the same one after its world has changed."""
        former, self._simulation = self._simulation, simulation
        reference = self._reference
        if reference is None:
            return
        if former is simulation:
            self._find_rows(reference)
            return
        self.stop(former)
        try:
            self._start(reference.of_other(simulation))
        except UsageError:  # the new world has none of the recording's models
            return

    def open(self, reference: Reference) -> None:
        """Start to compare with a recording of the shown world, in place of another."""
        self.stop(self._simulation)
        self._start(reference)

    def set_offset(self, action: SetReferenceOffset) -> None:
        """Let the recording start earlier or later.

        Raises:
            UsageError: nothing is compared.
        """
        if self._reference is None:
            raise UsageError("nothing is compared")
        self._reference.comparison.offset = action.offset

    def stop(self, simulation: Simulation | None = None) -> None:
        """Stop comparing a simulation; None: the one that is shown."""
        simulation = simulation or self._simulation
        if self._reference is not None and simulation is not None:
            simulation.remove_hook(self)
        self._reference = None

    def follow(self) -> None:
        """Continue after a jump in simulation time."""
        if self._reference is not None and self._simulation is not None:
            self._simulation.remove_hook(self)
            self._simulation.add_hook(self, period_ns=StateRecorder.period_ns)

    def after_step(self, snapshot: Snapshot) -> None:
        """Take a sample."""
        if self._reference is not None:
            row = self._rows.read(snapshot)
            self._reference.comparison.add(snapshot.time_ns / NS_PER_S, row)

    def put(self, snapshot: Snapshot) -> None:
        """Send the differences to the page."""
        if self._reference is not None:
            row = self._rows.read(snapshot)
            self._reference.put_differences(self._server, snapshot.time_ns / NS_PER_S, row)

    def _start(self, reference: Reference) -> None:
        assert self._simulation is not None
        self._reference = reference
        self._find_rows(reference)
        self.after_step(self._simulation.snapshot())
        self._simulation.add_hook(self, period_ns=StateRecorder.period_ns)

    def _find_rows(self, reference: Reference) -> None:
        assert self._simulation is not None
        compiled = self._simulation.engine.compiled
        self._rows = RowReader(reference.comparison, compiled.link_names, compiled.joint_names)
