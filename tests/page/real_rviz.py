"""Debian's rviz on its own screen, and its pictures."""

import contextlib
import os
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from numpy.typing import NDArray
from PIL import Image
from tests.graphs import PATIENCE_S, Graph

from trundle.ros import Node, RosError

Picture = NDArray[np.int16]
"""(height, width, 3), 0…255."""

INSTALLED = all(Path("/usr/bin", name).exists() for name in ("rviz", "Xvfb", "import"))
NOT_INSTALLED = "rviz, Xvfb and ImageMagick are not installed (make system)"
BACKGROUND = (12, 24, 36)
"""Background color that no display draws; it marks rviz's 3D view in its window."""
_PATIENCE_S = (PATIENCE_S, 2 * PATIENCE_S, 4 * PATIENCE_S)
"""Times to wait [s]: on a software renderer, rviz may die or stay black, and is restarted with more time."""
_AXES = {"Class": "rviz/Axes", "Name": "Axes", "Length": 1, "Radius": 0.2}
_SERVICE = "/rviz/load_config_discarding_changes"
_LOAD = "rviz/SendFilePath"


def rviz_file(displays: Sequence[Mapping[str, Any]], view: Mapping[str, Any], *, has_docks: bool = False) -> str:
    """Return an .rviz file with only these displays; rviz shows images in its docks."""
    manager = {
        "Class": "",
        "Displays": [{"Enabled": True, "Value": True, **display} for display in displays],
        "Global Options": {
            "Background Color": "; ".join(map(str, BACKGROUND)),
            "Fixed Frame": "map",
            "Frame Rate": 10,
            "Default Light": True,
        },
        "Tools": [{"Class": "rviz/MoveCamera"}],
        "Views": {"Current": {"Name": "Current View", **view}},
    }
    window = {"Height": 700, "Width": 900, "X": 0, "Y": 0, "Hide Left Dock": not has_docks, "Hide Right Dock": True}
    return yaml.safe_dump({"Panels": [], "Visualization Manager": manager, "Window Geometry": window}, sort_keys=False)


class RealRviz:
    """One rviz on one screen, which loads files one after another."""

    def __init__(self, folder: Path, graph: Graph, *, packages: Path, remappings: Mapping[str, str]) -> None:
        self._folder, self._graph, self._remappings = folder, graph, remappings
        self._quiet: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        reading, writing = os.pipe()
        screen = ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1000x800x24"]
        self._screen = subprocess.Popen(screen, pass_fds=[writing], **self._quiet)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            number = pipe.readline().strip()
        runtime = folder / "runtime"
        runtime.mkdir(mode=0o700)
        self._env = {
            "PATH": "/usr/bin:/bin",
            "HOME": str(folder),
            "DISPLAY": f":{number}",
            "LIBGL_ALWAYS_SOFTWARE": "1",
            "XDG_RUNTIME_DIR": str(runtime),
            "ROS_MASTER_URI": graph.core.uri,
            "ROS_PACKAGE_PATH": f"{packages}:/usr/share",
        }
        self._rviz: subprocess.Popen[Any] | None = None
        self._caller: Node = graph.node("picture_caller")
        self._caller.messages.add_service(_LOAD, "std_msgs/String path\n---\nbool success\n")

    def close(self) -> None:
        self._stop()
        self._screen.kill()
        self._screen.wait()

    def show(self, text: str) -> bool:
        """Load a file of this text; return False if rviz died."""
        path = self._folder / "case.rviz"
        path.write_text(text)
        if self._is_alive() and self._load(path):
            return True
        self._stop()
        self._start()
        return self._load(path)

    def _start(self) -> None:
        """Start rviz with axes, as it draws no text before it has drawn a solid."""
        path = self._folder / "first.rviz"
        path.write_text(rviz_file([_AXES], {"Class": "rviz/Orbit", "Distance": 3}))
        command = ["/usr/bin/rviz", "-d", str(path), "--disable-anti-aliasing", "__name:=rviz"]
        command += [f"{name}:={to}" for name, to in self._remappings.items()]
        self._rviz = subprocess.Popen(command, env=self._env, **self._quiet)
        end = time.monotonic() + 2 * PATIENCE_S
        while time.monotonic() < end and self._is_alive():
            red, green, blue = np.moveaxis(self.shot(), -1, 0)
            if ((blue > 150) & (red < 50) & (green < 50)).sum() > 100:
                break
            time.sleep(0.5)
        with contextlib.suppress(RosError, TimeoutError):
            self._graph.loop.run(self._caller.wait_for_service(_SERVICE, PATIENCE_S), 2 * PATIENCE_S)

    def shot(self) -> Picture:
        """Take a picture of the whole screen."""
        path = self._folder / "window.png"
        subprocess.run(["/usr/bin/import", "-window", "root", str(path)], env=self._env, check=True, timeout=PATIENCE_S)
        return np.asarray(Image.open(path).convert("RGB")).astype(np.int16)

    def picture(self, text: str, part: tuple[slice, slice], is_drawn: Callable[[Picture], bool]) -> Picture:
        """Show a file; return a part of the screen once two pictures in a row are equal and `is_drawn` is true."""
        for patience_s in _PATIENCE_S:
            is_loaded = self.show(text)
            end = time.monotonic() + patience_s
            last = None
            while is_loaded and time.monotonic() < end and self._is_alive():
                now = self.shot()[part]
                if last is not None and is_drawn(now) and np.abs(now - last).max() < 3:
                    return now
                last = now
                time.sleep(0.5)
            self._stop()
        pytest.fail(
            f"rviz was started {len(_PATIENCE_S)} times and drew nothing that stood still, in {sum(_PATIENCE_S):g} s"
        )

    def _is_alive(self) -> bool:
        return self._rviz is not None and self._rviz.poll() is None

    def saved(self, text: str) -> str:
        """Show a file and make rviz save it; return the saved text."""
        path = self._folder / "saved.rviz"
        for _ in _PATIENCE_S:
            if self.show(text) and self._call("/rviz/save_config", path):
                return path.read_text()
            self._stop()
        pytest.fail(f"rviz was started {len(_PATIENCE_S)} times and saved no file")

    def _load(self, path: Path) -> bool:
        return self._call(_SERVICE, path)

    def _call(self, service: str, path: Path) -> bool:
        request = {"path": {"data": str(path)}}
        call = self._caller.call_service(service, _LOAD, request, timeout_s=PATIENCE_S)
        try:
            return bool(self._graph.loop.run(call, PATIENCE_S).success)
        except (RosError, TimeoutError):
            return False

    def _stop(self) -> None:
        if self._rviz is None:
            return
        self._rviz.kill()
        self._rviz.wait()
        self._rviz = None
