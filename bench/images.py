"""Camera pictures a second, both cameras of the RP2W, new poses every picture."""

import statistics
import time
from pathlib import Path

import trundle
from bench.table import Row
from trundle.render import NativeRenderer
from trundle.sensors import mount_cameras

ROBOT = Path(__file__).parents[1] / "examples/rp2w"
_ROUNDS = 20


def run() -> list[Row]:
    """Measure the sensors by themselves: no stepping, no topics."""
    sim = trundle.load(str(ROBOT))
    cameras = mount_cameras(sim, NativeRenderer)
    rates: list[float] = []
    for _ in range(_ROUNDS):
        sim.step(33)
        snapshot = sim.snapshot()
        start = time.perf_counter()
        for camera in cameras:
            camera.before_look(snapshot)
        for camera in cameras:
            camera.take(snapshot)
        rates.append(len(cameras) / (time.perf_counter() - start))
    return [Row("RP2W, both cameras, 320x240", statistics.median(rates), "images/s", "", None)]
