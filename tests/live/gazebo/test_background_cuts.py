"""Concave meshes are decomposed in the background; until then they collide as their convex hulls."""

import threading
from collections.abc import Generator, Sequence
from pathlib import Path
from typing import Any

import pytest
from tests.gazebo_server import Gazebo, until
from tests.live.test_cut_meshes import angle_iron

from trundle.sim.physics.convex import jobs
from trundle.sim.physics.convex.mesh_decomposition import clear_cache

_COUNT = 4


@pytest.fixture(autouse=True)
def empty_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    clear_cache()


def _irons(folder: Path) -> str:
    """A model of angle irons of different lengths, side by side."""
    links = ""
    for i in range(_COUNT):
        file = folder / f"iron{i}.obj"
        file.write_text(angle_iron(1 + i / 10))
        links += (
            f'<link name="l{i}"><pose>{3 * i} 0 1 0 0 0</pose><collision name="c"><geometry><mesh>'
            f"<uri>{file.as_uri()}</uri></mesh></geometry></collision></link>"
        )
    return f'<sdf version="1.6"><model name="m">{links}</model></sdf>'


def _shapes(gazebo: Gazebo) -> int:
    return int(gazebo.world.simulation.engine.compiled.model.ngeom)


def test_a_model_is_spawned_at_once_and_its_meshes_are_cut_later(
    gazebo: Gazebo, monkeypatch: pytest.MonkeyPatch
) -> None:
    may_cut = threading.Event()
    decompose_parts = jobs.decompose_parts

    def decompose_late(parts: Sequence[Any], **options: Any) -> Generator[Any]:
        may_cut.wait()
        yield from decompose_parts(parts, **options)

    monkeypatch.setattr(jobs, "decompose_parts", decompose_late)
    count = _shapes(gazebo)

    assert gazebo.spawn(_irons(gazebo.folder), "m").success
    assert _shapes(gazebo) == count + _COUNT
    gazebo.call("unpause_physics")
    gazebo.until_s(0.1)
    gazebo.call("pause_physics")
    height, time_s = gazebo.state("m").pose.position.z, gazebo.time_s
    may_cut.set()
    until(lambda: any("meshes are cut" in line for line in gazebo.lines))

    assert _shapes(gazebo) >= count + 3 * _COUNT  # at least two pieces each, and the hull that meets planes
    assert (gazebo.state("m").pose.position.z, gazebo.time_s) == (height, time_s)
    assert gazebo.lines[-2:] == [
        f"hulls stand in for {_COUNT} hollow meshes until they are cut into convex pieces",
        f"{_COUNT} hollow meshes are cut, and collide as their convex pieces from now on",
    ]


def test_a_mesh_that_cannot_be_cut_keeps_its_hull_and_is_reported(
    gazebo: Gazebo, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(parts: Sequence[Any], **_: Any) -> Generator[Any]:
        yield from ((part, None) for part in parts)

    monkeypatch.setattr(jobs, "decompose_parts", fail)
    count = _shapes(gazebo)
    gazebo.spawn(_irons(gazebo.folder), "m")
    until(lambda: any("it could not be cut into convex pieces" in str(line) for line in gazebo.report.findings))

    assert gazebo.call("get_world_properties", "gazebo_msgs/GetWorldProperties").success  # the compile is done
    assert _shapes(gazebo) == count + _COUNT
