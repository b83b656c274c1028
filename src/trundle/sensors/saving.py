"""Saves what cameras see."""

import tempfile
from pathlib import Path

from trundle.diagnostics import Diagnostics, Source

from .camera import CameraReading, CameraSensor

_ILLEGAL = str.maketrans({":": "_", "/": "_", "\\": "_"})


class PictureSaver:
    """Writes each picture to a folder, under Gazebo's names: `<world>_<model>_<link>_<camera>(1)-0000.jpg`, …"""

    def __init__(self, camera: CameraSensor, folder: Path, world: str, report: Diagnostics) -> None:
        """Get ready; the folder is made when the first picture is there.

        Args:
            camera: whose pictures.
            folder: where they go.
            world: the world's name.
            report: is told when they cannot be written; then no more are.
        """
        names = (world, camera.model.name, camera.link.name, camera.name)
        self._start = "_".join(names).translate(_ILLEGAL) + "(1)"
        self._folder = folder
        self._at: Source = camera.sensor.at
        self._report = report
        self._count = 0
        self._gave_up = False

    def wanted(self) -> bool:
        """Whether it goes on."""
        return not self._gave_up

    def save(self, reading: CameraReading) -> None:
        """Write one picture."""
        from PIL import Image

        path = self._folder / f"{self._start}-{self._count:04}.jpg"
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            path.unlink(missing_ok=True)
            with path.open("xb") as file:  # what another user put there, as a link in /tmp, is not written through
                Image.fromarray(reading.rgb).save(file, format="JPEG", quality=95)
        except OSError as error:
            self._gave_up = True
            self._report.warn(self._at, f"{path}: {error.strerror or error}; no more pictures are saved")
            return
        self._count += 1


def folder_for(path: str) -> Path | None:
    """Where pictures may be saved: below the working directory or the folder for temporary files, else nowhere."""
    folder = Path(path).expanduser().resolve()
    roots = (Path.cwd(), Path(tempfile.gettempdir()), Path("/tmp"))
    return folder if any(folder.is_relative_to(root.resolve()) for root in roots) else None
