"""The same inputs give the same bytes, whatever is read meanwhile and however time is divided into strides."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import trundle
from trundle.sim.simulation import Simulation, Snapshot
from trundle.spatial import Wrench

PILE = "".join(
    f'<model name="b{i}"><pose>{0.03 * i} {0.05 * (i % 2)} {0.15 + 0.21 * i} {0.1 * i} 0 0</pose><link name="l">'
    "<inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>"
    '</inertial><collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link></model>'
    for i in range(8)
)
FLOOR = (
    '<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane>'
    "<normal>0 0 1</normal></plane></geometry></collision></link></model>"
)


@pytest.fixture
def load(tmp_path: Path) -> Callable[[], Simulation]:
    file = tmp_path / "pile.world"
    file.write_text(f'<sdf version="1.6"><world name="w">{FLOOR}{PILE}</world></sdf>')
    return lambda: trundle.load(str(file))


def bits(snapshot: Snapshot) -> bytes:
    return snapshot.poses.tobytes() + snapshot.twists.tobytes()


def test_two_runs_agree_to_the_bit(load: Callable[[], Simulation]) -> None:
    ends: list[bytes] = []
    for _ in range(2):
        sim = load()
        sim.run(3.0)
        sim["b3"].apply_wrench(Wrench(force=(3.0, 1.0, 0.0)), duration_s=0.5)
        sim.run(3.0)
        ends.append(bits(sim.snapshot()))
    assert ends[0] == ends[1]


def test_the_result_depends_neither_on_stride_lengths_nor_on_reads(load: Callable[[], Simulation]) -> None:
    whole, cut = load(), load()
    whole.run(4.0)
    for count in [1, 7, 300, 512, 13, 1000] * 2:
        cut.step(count)
        cut.snapshot().poses.sum()
        cut.contacts()
        assert cut["b0"].pose.position[2] > 0.0
    cut.advance(whole.time_ns)
    assert bits(whole.snapshot()) == bits(cut.snapshot())


def test_a_second_simulation_repeats_the_first(load: Callable[[], Simulation]) -> None:
    sim = load()
    sim.run(2.5)
    first = bits(sim.snapshot())
    sim.reset()
    sim.run(2.5)
    assert bits(sim.snapshot()) == first


def test_a_state_can_be_restored_at_any_step(load: Callable[[], Simulation]) -> None:
    sim = load()
    for steps in (100, 400, 1500):
        sim.step(steps)
        saved = sim.save()
        sim.run(0.7)
        expected = bits(sim.snapshot())
        sim.restore(saved)
        sim.run(0.7)
        assert bits(sim.snapshot()) == expected
        sim.restore(saved)


ACTS = """
import hashlib, sys
from msgspec.structs import replace
import trundle
from trundle.gazebo.model_plugins import load_plugins, load_world_plugins
from trundle.spatial import Pose, Wrench

sim = trundle.load(sys.argv[1])
load_plugins(sim, None, {}, log=lambda _: None)
load_world_plugins(sim, None, {}, log=lambda _: None)
for _ in range(2):
    sim.run(7.0)
    extra = replace(sim["b1"].model, name="extra", world_from_model=Pose((0.05, 0.0, 2.5)), plugins=())
    sim.spawn(extra)
    sim["b0"].link("l").apply_wrench(Wrench(force=(2.0, 1.0, 0.0)), duration_s=1.0)
    sim.run(7.0)
    sim.delete("extra")
    sim.run(6.0)
    sim.reset(time=False)
sim.run(20.0)
assert sim.time_ns == 60_000_000_000
snapshot = sim.snapshot()
print(hashlib.sha256(snapshot.poses.tobytes() + snapshot.twists.tobytes()).hexdigest())
"""
GUST = """<wind><linear_velocity>0.4 0.2 0</linear_velocity></wind><plugin name="p" filename="libWindPlugin.so">
<force_approximation_scaling_factor>0.1</force_approximation_scaling_factor><horizontal><magnitude>
<noise type="gaussian"><mean>0</mean><stddev>0.5</stddev></noise></magnitude></horizontal></plugin>"""
WANDERER = """<model name="w"><pose>3 0 1 0 0 0</pose><link name="l"/><plugin name="p"
filename="libRandomVelocityPlugin.so"><link>l</link><update_period>1</update_period></plugin></model>"""


@pytest.mark.slow
def test_a_minute_of_simulation_is_equal_to_the_bit_in_two_processes(tmp_path: Path) -> None:
    """With wind, drawn velocities, spawns, deletions and resets in between."""
    windy = PILE.replace('<link name="l">', '<link name="l"><enable_wind>true</enable_wind>')
    file = tmp_path / "pile.world"
    file.write_text(f'<sdf version="1.6"><world name="w">{GUST}{FLOOR}{windy}{WANDERER}</world></sdf>')
    # Hashes of texts differ between processes: nothing may go by them.
    runs = [
        subprocess.run(
            [sys.executable, "-c", ACTS, str(file)],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "PYTHONHASHSEED": seed},
        )
        for seed in ("1", "2")
    ]

    assert [run.returncode for run in runs] == [0, 0], runs[0].stderr
    assert runs[0].stdout == runs[1].stdout
    assert len(runs[0].stdout.strip()) == 64
