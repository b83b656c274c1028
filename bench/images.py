"""Camera pictures per second: both cameras of the RP2W, and a ring of RGB-D cameras as on quadrupeds.

The peer is MuJoCo's EGL renderer with the same sensors, in alternation with Trundle's renderer.
"""

import math
import statistics
import tempfile
import time
from contextlib import suppress
from pathlib import Path

import trundle
from bench.table import Row
from trundle.base.diagnostics import UsageError
from trundle.sim.renderers import RENDERERS, RendererName
from trundle.sim.sensors import mount_cameras

ROBOT = Path(__file__).parents[1] / "examples/rp2w"
_TURNS, _ROUNDS = 3, 10
_RING = 5


def run() -> list[Row]:
    """Measure only the sensors, with new poses for every picture: no stepping, no topics."""
    with tempfile.TemporaryDirectory() as folder:
        ring = Path(folder) / "ring.world"
        ring.write_text(_ring(), encoding="utf-8")
        return [
            _row("RP2W, both cameras, 320x240", str(ROBOT)),
            _row("five RGB-D cameras, 928x800, noise", str(ring)),
        ]


def _row(name: str, file: str) -> Row:
    rates: list[float] = []
    ratios: list[float] = []
    for _ in range(_TURNS):
        rates.append(_rate(file, "cpu"))
        with suppress(UsageError):  # no EGL
            ratios.append(rates[-1] / _rate(file, "egl"))
    ratio = statistics.median(ratios) if ratios else None
    return Row(name, statistics.median(rates), "images/s", "MuJoCo EGL", ratio)


def _rate(file: str, renderer: RendererName) -> float:
    sim = trundle.load(file)
    cameras = mount_cameras(sim, RENDERERS[renderer])
    rates: list[float] = []
    for _ in range(_ROUNDS):
        sim.step(33)
        snapshot = sim.snapshot()
        start = time.perf_counter()
        for camera in cameras:
            camera.request(snapshot)
        for camera in cameras:
            camera.measure(snapshot)
        rates.append(len(cameras) / (time.perf_counter() - start))
    return statistics.median(rates)


def _ring() -> str:
    """Return a world of twenty boxes around a box with cameras on all sides."""
    cameras = "".join(_camera(number, math.tau * number / _RING) for number in range(_RING))
    boxes = "".join(_box_model(number, math.tau * number / 20) for number in range(20))
    return f"""<sdf version="1.6"><world name="ring">
      <include><uri>model://sun</uri></include><include><uri>model://ground_plane</uri></include>
      <model name="robot"><static>true</static><pose>0 0 0.6 0 0 0</pose><link name="body">
        <visual name="box"><geometry><box><size>0.3 0.3 0.2</size></box></geometry></visual>{cameras}
      </link></model>{boxes}</world></sdf>"""


def _camera(number: int, yaw: float) -> str:
    return f"""<sensor name="eye_{number}" type="depth"><update_rate>30</update_rate>
      <pose>{0.2 * math.cos(yaw)} {0.2 * math.sin(yaw)} 0 0 0.3 {yaw}</pose>
      <camera><horizontal_fov>1.2</horizontal_fov><image><width>928</width><height>800</height></image>
      <noise><type>gaussian</type><mean>0</mean><stddev>0.007</stddev></noise></camera></sensor>"""


def _box_model(number: int, angle: float) -> str:
    geometry = "<geometry><box><size>0.5 0.5 1</size></box></geometry>"
    return f"""<model name="box_{number}"><static>true</static>
      <pose>{3 * math.cos(angle)} {3 * math.sin(angle)} 0.5 0 0 {angle}</pose>
      <link name="link"><visual name="box">{geometry}</visual></link></model>"""
