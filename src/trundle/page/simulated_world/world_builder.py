"""Thread that writes the page's files of a world while the simulation continues."""

import queue
import threading
from collections.abc import Callable

from msgspec import Struct
from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import World

from ..world.manifest import Manifest
from .world_files import WorldFiles


class BuiltWorld(Struct, frozen=True, kw_only=True):
    """World with its files, ready for the page."""

    manifest: Manifest
    files: dict[str, bytes]
    """URL → content of new files."""
    report: Diagnostics
    """Warnings about shapes that cannot be drawn."""


class _Job(Struct, frozen=True, kw_only=True):
    world: World
    manifest: Manifest
    """Without its files."""
    bodies: dict[str, int]


class WorldBuilder:
    """Builds the newest requested world; requests that newer ones replace before their turn are skipped."""

    def __init__(self) -> None:
        self._files = WorldFiles()
        self._jobs: queue.SimpleQueue[_Job | None] = queue.SimpleQueue()
        self._built: queue.SimpleQueue[BuiltWorld | Exception] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._run, name="trundle-page-world", daemon=True)
        self._thread.start()

    def build(self, world: World, manifest: Manifest, bodies: dict[str, int]) -> None:
        """Queue a request for a world's files; return at once.

        Args:
            world: flat world.
            manifest: world's manifest without its files.
            bodies: number of each link, `model::link`.
        """
        self._jobs.put(_Job(world=world, manifest=manifest, bodies=bodies))

    def poll(self) -> BuiltWorld | None:
        """Return the next built world; None if none is ready."""
        try:
            built = self._built.get_nowait()
        except queue.Empty:
            return None
        if isinstance(built, Exception):
            raise built
        return built

    def wait(self) -> BuiltWorld:
        """Wait for the next built world."""
        built = self._built.get()
        if isinstance(built, Exception):
            raise built
        return built

    def close(self) -> None:
        """Stop after the current world."""
        self._jobs.put(None)

    def _run(self) -> None:
        while (job := newest(self._jobs.get, self._jobs.get_nowait)) is not None:
            report = Diagnostics()
            try:
                named, files = self._files.update(job.world, job.bodies.__getitem__, report)
            except Exception as error:  # raised again by `poll`, on the owner's thread
                self._built.put(error)
                return
            manifest = replace(job.manifest, files=named.files, collisions=named.collisions, resources=named.resources)
            self._built.put(BuiltWorld(manifest=manifest, files=files, report=report))


def newest(first: Callable[[], _Job | None], more: Callable[[], _Job | None]) -> _Job | None:
    """Wait for a job and return the newest in the queue; None ends the thread at once."""
    job = first()
    while job is not None:
        try:
            job = more()
        except queue.Empty:
            break
    return job
