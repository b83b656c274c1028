"""Image files of <save>, within a quota and below one folder of the working directory."""

import io
import itertools
import os
from pathlib import Path
from typing import BinaryIO
from weakref import WeakKeyDictionary

from trundle.base.diagnostics import Diagnostics, Source
from trundle.sim.simulation import Simulation

from .camera import CameraReading, CameraSensor

FOLDER = "saved_images"
"""Folder in the working directory that holds all saved images."""
SAVE_ALL = "TRUNDLE_SAVE_ALL"
"""Environment variable; 1 lifts the quota."""
_MAX_IMAGES = 100_000
_MAX_BYTES = 4 * 1024**3
"""About 40,000 images of 640 × 480 pixels."""
_ILLEGAL = str.maketrans({":": "_", "/": "_", "\\": "_"})


class Quota:
    """Remaining images and bytes that the cameras of one run may save."""

    def __init__(self) -> None:
        has_bounds = os.environ.get(SAVE_ALL) != "1"
        self._images: float = _MAX_IMAGES if has_bounds else float("inf")
        self._bytes: float = _MAX_BYTES if has_bounds else float("inf")

    def reserve(self, size: int) -> bool:
        """Reserve a file of `size` bytes; False if the quota is exhausted."""
        self._images -= 1
        self._bytes -= size
        return self._images >= 0 and self._bytes >= 0


_QUOTAS: WeakKeyDictionary[Simulation, Quota] = WeakKeyDictionary()


def quota_of(simulation: Simulation) -> Quota:
    """Return the quota of a run, shared with models spawned later."""
    return _QUOTAS.setdefault(simulation, Quota())


class ImageSaver:
    """Writes each image to a folder under Gazebo's names: `<world>_<model>_<link>_<camera>(1)-0000.jpg`, …

    The number in brackets is the first that no earlier run used; existing files are never overwritten.
    """

    def __init__(self, camera: CameraSensor, folder: Path, world: str, report: Diagnostics, quota: Quota) -> None:
        """Prepare; the folder is created with the first image.

        Args:
            camera: source of the images.
            folder: folder of the images.
            world: name of the world.
            report: receives a warning when writing fails and saving stops.
            quota: limit shared by all cameras of a run.
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
        """True until saving stopped."""
        return not self._is_stopped

    def save(self, reading: CameraReading) -> None:
        """Write one image."""
        from PIL import Image

        data = io.BytesIO()
        Image.fromarray(reading.rgb).save(data, "JPEG", quality=95)
        if not self._quota.reserve(data.tell()):
            bound = f"{_MAX_IMAGES} images or {_MAX_BYTES >> 30} GiB are saved in a run"
            self._stop(f"{self._folder}: limit reached: {bound}; {SAVE_ALL}=1 lifts the limit")
            return
        try:
            if not Path(os.path.realpath(self._folder)).is_relative_to(self._root):
                self._stop(f"{self._folder}: a link in it leads out of {self._root}; saving stopped")
                return
            self._folder.mkdir(parents=True, exist_ok=True)
            self._write(data.getbuffer())
        except OSError as error:
            self._stop(f"{error.filename or self._folder}: {error.strerror or error}; saving stopped")
            return
        self._count += 1

    def _stop(self, problem: str) -> None:
        self._is_stopped = True
        self._report.warn(self._at, problem, "saved-images")

    def _write(self, data: memoryview) -> None:
        """Write the next image; an incomplete file is removed."""
        file = self._create()
        try:
            with file:
                file.write(data)
        except OSError:
            os.unlink(file.name)
            raise

    def _create(self) -> BinaryIO:
        """Create the next image's file; the first one determines the number in brackets."""
        for run in itertools.count(1) if self._run == 0 else (self._run,):
            try:
                file = (self._folder / f"{self._start}({run})-{self._count:04}.jpg").open("xb")
            except FileExistsError:
                if self._run != 0:
                    raise
            else:
                self._run = run
                return file
        raise AssertionError


def folder_for(path: str) -> Path:
    """Return the folder for <save>, below `FOLDER`; a path elsewhere, such as /tmp/shots, is moved below it."""
    here = Path.cwd()
    output = here / FOLDER
    named = Path(os.path.normpath(here / os.path.expanduser(path)))
    if named.is_relative_to(output):
        return named
    return output / named.relative_to(here if named.is_relative_to(here) else named.anchor)
