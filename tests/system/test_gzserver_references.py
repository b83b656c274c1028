"""Poses and inertias of all links of forty-two published models, compared with Gazebo 11's server."""

import gzip
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.live.world_setup import load_world
from trundle.robots.model import Link
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

# Gazebo's values have six digits.
TOLERANCES: Any = {"rel": 2e-5, "abs": 2e-6}


@pytest.fixture(scope="module")
def corpus(shared: Path) -> Path:
    if not (shared / "corpus/refs/gzserver").is_dir():
        pytest.skip("the reference answers (../shared/corpus) are not beside this checkout")
    return shared / "corpus"


def description_file(corpus: Path, file: str, folder: Path) -> Path:
    """Return a description's file; URDFs expanded from xacro are stored compressed."""
    if not file.endswith(".json.gz"):
        return corpus / file
    text = gzip.decompress((corpus / file.replace(".json.gz", ".urdf.gz")).read_bytes())
    (folder / "robot.urdf").write_bytes(text)
    return folder / "robot.urdf"


def is_same_rotation(a: Any, b: Any) -> bool:
    return abs(abs(float(np.dot(a, b))) - 1.0) < 1e-5


def check_inertial(link: Link, answer: dict[str, Any]) -> None:
    inertial, expected = link.inertial, answer["inertial"]
    assert inertial.mass == pytest.approx(expected["mass"], **TOLERANCES), link.name
    assert inertial.link_from_com.position == pytest.approx(expected["pose"]["xyz"], **TOLERANCES), link.name
    moments = [expected[name] for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")]
    assert [*inertial.moments, *inertial.products] == pytest.approx(moments, **TOLERANCES), link.name


@pytest.mark.slow
def test_link_poses_and_inertias_equal_gazebo(corpus: Path, tmp_path: Path) -> None:
    compared = links = 0
    for reference in sorted((corpus / "refs/gzserver").glob("*.json.gz")):
        answer = json.loads(gzip.decompress(reference.read_bytes()))
        repository = corpus / "repos" / answer["file"].split("/")[1]
        report = Diagnostics()
        environment = {
            "GAZEBO_MODEL_PATH": f"{repository}:{repository / 'models'}:{corpus / 'repos/osrf+gazebo_models'}",
            "ROS_PACKAGE_PATH": str(corpus / "repos"),
        }
        file = description_file(corpus, answer["file"], tmp_path)
        loaded = load_world(str(file), Packages(environment, start=tmp_path), report)
        simulation = Simulation(loaded.flat, report)
        poses = simulation.snapshot().poses
        references = {link["name"].partition("::")[2]: link for link in answer["model"]["links"]}
        index = 0
        for model in loaded.flat.models:
            is_compared = model.name == answer["model"]["name"]
            for link in model.links:
                if is_compared and link.name in references:
                    expected = references.pop(link.name)
                    x, y, z, *turn = poses[index].tolist()
                    pose = simulation[model.name].pose.inverse() @ Pose((x, y, z), tuple(turn))
                    name = f"{answer['file']}: {link.name}"
                    assert pose.position == pytest.approx(expected["pose_model"]["xyz"], rel=2e-5, abs=1e-5), name
                    assert is_same_rotation(pose.quaternion, expected["pose_model"]["wxyz"]), name
                    check_inertial(link, expected)
                    links += 1
                index += 1
        # The remaining links belong to models that are not in the corpus.
        assert all("::" in name for name in references), (answer["file"], sorted(references))
        compared += 1
    assert (compared, links > 300) == (42, True)
