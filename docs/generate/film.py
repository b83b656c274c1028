"""Video and picture of the page for the README and the site, with the RP2W driving through its room; `make film`."""

import os
import signal
import socket
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from unittest.mock import patch

from PIL import Image

from trundle.live.run import run_world as run_module
from trundle.live.run.run_options import RunOptions
from trundle.page.link_file import read_link_files
from trundle.sim import realtime_pacer
from trundle.spatial import NS_PER_S

from .film_clock import FilmClock
from .film_page import FilmPage

DOCS = Path(__file__).parents[1].resolve()
FILM_SIZE = (960, 600)
FRAME_NS = 100_000_000
QUALITY = 62
PICTURE_FRAME = 30
SKIPPED_FRAMES = 3
"""Number of first frames to skip, in which the robot starts to move."""
VIEW = {
    "Class": "rviz/Orbit",
    "Target Frame": "rp2w::chassis",
    "Distance": 4.8,
    "Yaw": -1.15,
    "Pitch": 0.42,
    "Focal Point": {"X": 0.0, "Y": 0.55, "Z": 0.55},
    "Field of View": 0.7854,
}
CURVES = ("rp2w::chassis_left_wheel.velocity", "rp2w::chassis_right_wheel.velocity")
ROUTE = ((0.5, 1.0, 0.0), (0.8, 1.0, 0.7), (0.8, 1.0, 0.0), (2.8, 0.85, -0.8), (1.5, 1.0, 0.0))
"""Duration [s], and ratios of the maximum velocities forwards and to the left."""


def main() -> None:
    """Simulate in this thread and record in another."""
    clock = FilmClock()
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    faults: list[Exception] = []

    def film() -> None:
        try:
            save(list(frames(clock, page_link(port)))[SKIPPED_FRAMES:])
        except Exception as fault:
            faults.append(fault)
        clock.release()
        os.kill(os.getpid(), signal.SIGINT)

    os.environ.pop("ROS_MASTER_URI", None)
    paced = partial(realtime_pacer.RealtimePacer, wall_ns=clock.time_ns, sleep=clock.sleep)
    with ExitStack() as stack:
        os.chdir(stack.enter_context(tempfile.TemporaryDirectory()))
        stack.enter_context(patch.object(run_module, "RealtimePacer", paced))
        stack.enter_context(patch.object(realtime_pacer, "_STRIDE_WALL_NS", FRAME_NS))  # one stride per frame
        threading.Thread(target=film).start()
        run_module.run("rp2w_at_home.world", RunOptions(port=port, opens_browser=False, paused=True))
    if faults:
        raise faults[0]


def page_link(port: int) -> str:
    """Wait for the page at a port; return its link with the token."""
    while True:
        for links in read_link_files(os.environ):
            if links.port == port:
                return links.url
        time.sleep(0.5)


def frames(clock: FilmClock, url: str) -> Iterator[Image.Image]:
    """Yield a picture of the page for each step of the clock."""
    with FilmPage(url, VIEW) as page:
        page.hide_display("TF")
        page.plot("wheel.velocity", CURVES, window="10 s")
        clock.hold()
        page.play()
        for seconds, forwards, left in ROUTE:
            page.drive(forwards, left)
            for _ in range(round(seconds * NS_PER_S / FRAME_NS)):
                before = page.time
                clock.advance(FRAME_NS)
                page.wait_for_time_after(before)
                yield page.picture()


def save(pictures: list[Image.Image]) -> None:
    """Write the video and one of its pictures."""
    picture = pictures[PICTURE_FRAME].quantize(256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    picture.save(DOCS / "page.png", optimize=True)
    first, *rest = (picture.resize(FILM_SIZE, Image.Resampling.LANCZOS) for picture in pictures)
    first.save(
        DOCS / "page.webp",
        save_all=True,
        append_images=rest,
        duration=FRAME_NS // 1_000_000,
        loop=0,
        quality=QUALITY,
        method=4,
    )


if __name__ == "__main__":
    main()
