"""Animation of bodies in a GLB."""

import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.sim.gltf.glb import Glb

from trundle.robots.model import Box
from trundle.sim.gltf import animated_glb
from trundle.sim.render import Scene, Shape
from trundle.spatial import quaternion_from_rpy

TIMES = np.array([5.0, 5.5, 6.0, 6.5])


@pytest.fixture
def motion() -> NDArray[np.float64]:
    """Poses (4, 3, 7): one body slides and then rests, one turns more than half a turn, one rests."""
    poses = np.zeros((4, 3, 7))
    poses[:, :, 3] = 1.0
    poses[:, 0, 0] = [0.0, 1.0, 1.0, 1.0]
    poses[:, 1, 3:] = [quaternion_from_rpy(0.0, 0.0, yaw) for yaw in (0.0, 2.0, 4.0, 6.0)]
    poses[2, 1, 3:] *= -1.0  # the same orientation
    poses[:, 2, :3] = (7.0, 8.0, 9.0)
    return poses


@pytest.fixture
def data(motion: NDArray[np.float64]) -> bytes:
    shapes = tuple(Shape(name=f"v{body}", body=body, geometry=Box((1.0, 1.0, 1.0))) for body in range(3))
    return animated_glb(Scene(shapes=shapes, bodies=("slides", "turns", "rests")), TIMES, motion)


def tracks(glb: Glb) -> dict[tuple[str, str], tuple[NDArray[Any], NDArray[Any]]]:
    """Return times and values of each track by the node's name and its path."""
    (animation,) = glb.tree["animations"]
    by_name: dict[tuple[str, str], tuple[NDArray[Any], NDArray[Any]]] = {}
    for channel in animation["channels"]:
        target, sampler = channel["target"], animation["samplers"][channel["sampler"]]
        key = glb.tree["nodes"][target["node"]]["name"], target["path"]
        by_name[key] = glb.array(sampler["input"])[:, 0], glb.array(sampler["output"])
    return by_name


def test_moving_bodies_have_tracks_from_time_zero_without_keys_at_rest(data: bytes) -> None:
    by_name = tracks(Glb(data))

    assert sorted(by_name) == [("slides", "translation"), ("turns", "rotation")]
    times, positions = by_name["slides", "translation"]
    assert times.tolist() == [0.0, 0.5, 1.5]
    assert positions.tolist() == [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
    assert Glb(data).nodes()["rests"]["translation"] == [7.0, 8.0, 9.0]


def test_quaternions_are_continuous_in_sign(data: bytes, motion: NDArray[np.float64]) -> None:
    times, turns = tracks(Glb(data))["turns", "rotation"]

    assert times.tolist() == [0.0, 0.5, 1.0, 1.5]
    assert (turns[1:] * turns[:-1]).sum(axis=1) == pytest.approx(np.cos(1.0), abs=1e-5)
    same = np.abs((turns * motion[:, 1, [4, 5, 6, 3]]).sum(axis=1))
    assert same == pytest.approx(1.0, abs=1e-5)


@pytest.mark.slow
def test_khronos_validator_reports_no_errors(data: bytes, tmp_path: Path) -> None:
    """The Khronos glTF validator (`make system`)."""
    tools = Path(__file__).parents[3] / ".npm/node_modules"
    if not (tools / "gltf-validator").is_dir():
        pytest.skip("npm's gltf-validator is not installed (make system)")
    (tmp_path / "a.glb").write_bytes(data)
    code = (
        "require('gltf-validator').validateBytes(new Uint8Array(require('fs').readFileSync(process.argv[1])))"
        ".then(r => console.log(r.issues.numErrors, r.issues.numWarnings, r.info.animationCount, "
        "JSON.stringify(r.issues.messages)))"
    )

    result = subprocess.run(
        ["node", "-e", code, str(tmp_path / "a.glb")],
        env={"NODE_PATH": str(tools), "PATH": "/usr/bin:/usr/local/bin"},
        capture_output=True,
        text=True,
        check=True,
    )

    assert result.stdout.split()[:3] == ["0", "0", "1"], result.stdout
