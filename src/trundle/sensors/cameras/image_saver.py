"""Saves what cameras see, within bounds: a description says that it is done, and the user where and how much."""

import io
import os
from pathlib import Path
from weakref import WeakKeyDictionary

from trundle.diagnostics import Diagnostics, Source
from trundle.simulation import Simulation

from .camera import CameraReading, CameraSensor

FOLDER = "saved_images"
"""In the working directory; every picture that a camera saves goes below it."""
SAVE_ALL = "TRUNDLE_SAVE_ALL"
"""Set to 1, there is no bound."""
_MAX_IMAGES = 100_000
_MAX_BYTES = 4 * 1024**3
"""Some 40,000 pictures of 640 by 480 pixels."""
_ILLEGAL = str.maketrans({":": "_", "/": "_", "\\": "_"})


class Quota:
    """How much all cameras of one run may still save."""

    def __init__(self) -> None:
        has_bounds = os.environ.get(SAVE_ALL) != "1"
        self._images: float = _MAX_IMAGES if has_bounds else float("inf")
        self._bytes: float = _MAX_BYTES if has_bounds else float("inf")

    def reserve(self, size: int) -> bool:
        """Take a file of so many bytes off it; False: it is spent."""
        self._images -= 1
        self._bytes -= size
        return self._images >= 0 and self._bytes >= 0


_QUOTAS: WeakKeyDictionary[Simulation, Quota] = WeakKeyDictionary()


def quota_of(simulation: Simulation) -> Quota:
    """The quota of a run, which models that are spawned later share."""
    return _QUOTAS.setdefault(simulation, Quota())


class ImageSaver:
    """Writes each picture to a folder, under Gazebo's names: `<world>_<model>_<link>_<camera>(1)-0000.jpg`, …

    Where an earlier run has left such files, (2) is next: no file that is there is written over.
    """

    def __init__(self, camera: CameraSensor, folder: Path, world: str, report: Diagnostics, quota: Quota) -> None:
        """Get ready; the folder is made when the first picture is there.

        Args:
            camera: whose pictures.
            folder: where they go.
            world: the world's name.
            report: is told when they cannot be written; then no more are.
            quota: how many.
        """
        names = (world, camera.model.name, camera.link.name, camera.name)
        self._start = "_".join(names).translate(_ILLEGAL)
        self._run = 0
        self._folder = folder
        self._root = Path(os.path.realpath(Path.cwd()))
        self._at: Source = camera.sensor.at
        self._report = report
        self._quota = quota
        self._count = 0
        self._is_stopped = False

    def enabled(self) -> bool:
        """Whether it goes on."""
        return not self._is_stopped

    def save(self, reading: CameraReading) -> None:
        """Write one picture."""
        from PIL import Image

        data = io.BytesIO()
        Image.fromarray(reading.rgb).save(data, "JPEG", quality=95)
        if not self._quota.reserve(data.tell()):
            bound = f"{_MAX_IMAGES} pictures or {_MAX_BYTES >> 30} GiB are saved in a run"
            self._stop(f"{self._folder}: {bound}; no more are; {SAVE_ALL}=1 lifts that")
            return
        try:
            if not Path(os.path.realpath(self._folder)).is_relative_to(self._root):
                self._stop(f"{self._folder}: a link in it leads out of {self._root}; no more pictures are saved")
                return
            self._folder.mkdir(parents=True, exist_ok=True)
            self._run = self._run or self._next_run()
            with self._path(self._run).open("xb") as file:
                file.write(data.getbuffer())
        except OSError as error:
            self._stop(f"{error.filename or self._folder}: {error.strerror or error}; no more pictures are saved")
            return
        self._count += 1

    def _stop(self, why: str) -> None:
        self._is_stopped = True
        self._report.warn(self._at, why)

    def _next_run(self) -> int:
        run = 1
        while os.path.lexists(self._path(run)):
            run += 1
        return run

    def _path(self, run: int) -> Path:
        return self._folder / f"{self._start}({run})-{self._count:04}.jpg"


def folder_for(path: str) -> Path:
    """Where pictures are saved, below `FOLDER`: what leads elsewhere, as /tmp/shots does, goes there with its names."""
    here = Path.cwd()
    output = here / FOLDER
    named = Path(os.path.normpath(here / os.path.expanduser(path)))
    if named.is_relative_to(output):
        return named
    return output / named.relative_to(here if named.is_relative_to(here) else named.anchor)
