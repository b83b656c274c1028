"""Recording that a page's world is compared with: its samples for clients, and the differences from it."""

import math
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Self

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.base.diagnostics import DescriptionError, Source, UsageError
from trundle.page import DIFFERENCES, PageServer
from trundle.sim.comparison import Comparison, Difference, Quantity, Trajectory, ascending_rows, first_links
from trundle.sim.gltf import content_name
from trundle.sim.simulation import Simulation, Snapshot, StateLog, read_state_log

from ..world.manifest import Manifest
from ..world.reference import Differences, ReferenceInfo

_FOLDER = "world/"
_MAX_BYTES = 64 * 1024 * 1024
"""Limit of the samples for clients; of longer recordings they get every second one, or fewer."""
_MAX_ROWS = 300
_QUANTITIES: tuple[Quantity, ...] = ("distance", "angle", "velocity", "angular velocity")
"""Order of a model's rows."""
_XYZ_XYZW = [0, 1, 2, 4, 5, 6, 3]
"""Order of a pose's numbers on the wire, as indices into x y z qw qx qy qz."""
_Array = NDArray[np.float64]


class Reference:
    """Recording, and the world's differences from it."""

    def __init__(self, log: StateLog, title: str, simulation: Simulation, *, start: float) -> None:
        """Compare a world with a recording.

        Args:
            log: recording, as from `read_recording`.
            title: name for users.
            simulation: simulation of the world.
            start: time of the world at which the recording starts [s].

        Raises:
            UsageError: it was recorded in another world.
        """
        self._log = log
        links = frozenset(simulation.engine.compiled.link_names)
        whole = Trajectory.of_log(log)
        movable = [model.name for model in simulation.world.models if not model.static and model.links]
        models = [model for model in movable if model in whole.models]
        if not models:
            raise UsageError(
                f"{title} is a recording of another world: it has {_listed(whole.models)}, and here "
                f"{_listed(movable)} can move"
            )
        joints = [joint for joint in simulation.engine.compiled.joint_names if joint.partition("::")[0] in models]
        self.comparison = Comparison(whole.only(models, joints), start=start, has_velocities=True)
        self._title = title
        self._links = tuple(link for link in log.links if link in links and link.partition("::")[0] in models)
        self._samples, data = _packed(log, self._links, self.comparison.reference.joints)
        names = "\n".join((*self._links, *self.comparison.reference.joints)).encode()
        self._url = f"{_FOLDER}{content_name(data + names)}.bin"
        self.files = {self._url: data}
        """URL → content of the samples."""
        self._sent: Differences | None = None

    def of_other(self, simulation: Simulation) -> Self:
        """Return the same recording for another simulation, with the same offset.

        Raises:
            UsageError: it was recorded in another world.
        """
        other = type(self)(self._log, self._title, simulation, start=self.comparison.start)
        other.comparison.offset = self.comparison.offset
        return other

    def with_info(self, manifest: Manifest) -> Manifest:
        """Return a manifest with the recording."""
        comparison = self.comparison
        info = ReferenceInfo(
            title=self._title,
            url=self._url,
            start=comparison.start + comparison.offset,
            offset=comparison.offset,
            duration=float(comparison.reference.times[-1]),
            samples=self._samples,
            links=self._links,
            joints=comparison.reference.joints,
        )
        return replace(manifest, reference=info, resources=(*manifest.resources, self._url))

    def put_differences(self, server: PageServer, time: float, row: _Array | None = None) -> None:
        """Send the differences if they have changed and are shown; arguments as in `Comparison.differences`."""
        if not server.is_watched(DIFFERENCES):
            return
        differences = self._differences(time, row)
        if differences != self._sent:
            self._sent = differences
            server.put_differences(differences)

    def _differences(self, time: float, row: _Array | None) -> Differences:
        """Return the sorted differences."""
        found = self.comparison.differences(time, row)
        distances = {one.name: _size(one) for one in found if one.quantity == "distance"}
        models = sorted(
            (one for one in found if one.name in distances),
            key=lambda one: (-distances[one.name], one.name, _QUANTITIES.index(one.quantity)),
        )
        joints = sorted((one for one in found if one.name not in distances), key=lambda one: -_size(one))
        rows = [one for one in (*models, *joints) if one.now is not None or one.maximum is not None]
        return Differences(time=time, rows=tuple(rows[:_MAX_ROWS]))


class RowReader:
    """Reads the rows of a comparison from the state of a world."""

    def __init__(self, comparison: Comparison, links: Sequence[str], joints: Sequence[str]) -> None:
        """Find the compared models and joints.

        Args:
            comparison: comparison that the rows are for.
            links: `model::link`, in the order of the world's.
            joints: `model::joint`, in the order of the world's.
        """
        firsts = first_links(links)
        indices = {joint: index for index, joint in enumerate(joints)}
        reference = comparison.reference
        self._comparison = comparison
        self._links = np.array([firsts.get(model, -1) for model in reference.models], dtype=np.intp)
        self._joints = np.array([indices.get(joint, -1) for joint in reference.joints], dtype=np.intp)

    def read(self, snapshot: Snapshot) -> _Array:
        """Return a row of the models' poses and twists and of the joints; NaN for what the world does not have."""
        poses, twists = _taken(snapshot.poses, self._links), _taken(snapshot.twists, self._links)
        return self._comparison.row(poses, _taken(snapshot.joint_positions, self._joints), twists)


def read_recording(file: Path, title: str) -> StateLog:
    """Read a state log with at least one row; errors name it by its title.

    Raises:
        DescriptionError: the file is not a state log, is empty, or is damaged.
        OSError: the file cannot be read.
    """
    try:
        log = read_state_log(file)
    except DescriptionError as error:
        raise DescriptionError(Source(title, error.at.line), error.what, error.id) from None
    if len(log.times_s) == 0:
        raise DescriptionError(Source(title), "nothing was recorded")
    return log


def _taken(rows: _Array, indices: NDArray[np.intp]) -> _Array:
    """Return the rows at indices; NaN at −1."""
    if len(rows) == 0:
        return np.full((len(indices), *rows.shape[1:]), np.nan)
    taken = rows[indices]
    taken[indices < 0] = np.nan
    return taken


def _packed(log: StateLog, links: Sequence[str], joints: Collection[str]) -> tuple[int, bytes]:
    """Return the number of samples and their bytes, as `ReferenceInfo.url` describes them."""
    rows = ascending_rows(log.times_s)
    row_bytes = 8 + 8 * len(joints) + 28 * len(links)
    rows = rows[:: math.ceil(len(rows) * row_bytes / _MAX_BYTES)]
    link_columns = [log.links.index(link) for link in links]
    joint_columns = [log.joints.index(joint) for joint in joints]
    poses = log.poses[rows][:, link_columns][:, :, _XYZ_XYZW]
    times = log.times_s[rows] - log.times_s[rows[0]]
    positions = log.positions[rows][:, joint_columns]
    return len(rows), times.astype("<f8").tobytes() + positions.astype("<f8").tobytes() + poses.astype("<f4").tobytes()


def _size(difference: Difference) -> float:
    """Return the value that rows are sorted by."""
    return difference.maximum or 0.0 if difference.now is None else difference.now


def _listed(models: Sequence[str]) -> str:
    names = ", ".join(models[:8]) or "no model"
    return names if len(models) <= 8 else f"{names} and {len(models) - 8} more"
