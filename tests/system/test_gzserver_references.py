"""Forty-two published models, loaded, rest where Gazebo 11's server has them: every link's pose and inertia."""

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

# Gazebo's answers have six digits.
DIGITS = {"rel": 2e-5, "abs": 2e-6}


@pytest.fixture(scope="module")
def corpus(shared: Path) -> Path:
    if not (shared / "corpus/refs/gzserver").is_dir():
        pytest.skip("the reference answers (../shared/corpus) are not beside this checkout")
    return shared / "corpus"


def described(corpus: Path, file: str, folder: Path) -> Path:
    """A file that can be read: those made from xacro are kept compressed."""
    if not file.endswith(".json.gz"):
        return corpus / file
    text = gzip.decompress((corpus / file.replace(".json.gz", ".urdf.gz")).read_bytes())
    (folder / "robot.urdf").write_bytes(text)
    return folder / "robot.urdf"


def same_turn(a: Any, b: Any) -> bool:
    return abs(abs(float(np.dot(a, b))) - 1.0) < 1e-5


def check_inertial(link: Link, answer: dict[str, Any]) -> None:
    inertial, theirs = link.inertial, answer["inertial"]
    assert inertial.mass == pytest.approx(theirs["mass"], **DIGITS), link.name
    assert inertial.link_from_com.position == pytest.approx(theirs["pose"]["xyz"], **DIGITS), link.name
    moments = [theirs[name] for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")]
    assert [*inertial.moments, *inertial.products] == pytest.approx(moments, **DIGITS), link.name


@pytest.mark.slow
def test_models_rest_where_gazebo_has_them(corpus: Path, tmp_path: Path) -> None:
    compared = links = 0
    for reference in sorted((corpus / "refs/gzserver").glob("*.json.gz")):
        answer = json.loads(gzip.decompress(reference.read_bytes()))
        repository = corpus / "repos" / answer["file"].split("/")[1]
        report = Diagnostics()
        environment = {
            "GAZEBO_MODEL_PATH": f"{repository}:{repository / 'models'}:{corpus / 'repos/osrf+gazebo_models'}",
            "ROS_PACKAGE_PATH": str(corpus / "repos"),
        }
        file = described(corpus, answer["file"], tmp_path)
        loaded = load_world(str(file), Packages(environment, start=tmp_path), report)
        simulation = Simulation(loaded.flat, report)
        poses = simulation.snapshot().poses
        theirs = {link["name"].partition("::")[2]: link for link in answer["model"]["links"]}
        index = 0
        for model in loaded.flat.models:
            ours = model.name == answer["model"]["name"]
            for link in model.links:
                if ours and link.name in theirs:
                    there = theirs.pop(link.name)
                    x, y, z, *turn = poses[index].tolist()
                    here = simulation[model.name].pose.inverse() @ Pose((x, y, z), tuple(turn))
                    where = f"{answer['file']}: {link.name}"
                    assert here.position == pytest.approx(there["pose_model"]["xyz"], rel=2e-5, abs=1e-5), where
                    assert same_turn(here.quaternion, there["pose_model"]["wxyz"]), where
                    check_inertial(link, there)
                    links += 1
                index += 1
        # The rest comes from models that are not in the corpus.
        assert all("::" in name for name in theirs), (answer["file"], sorted(theirs))
        compared += 1
    assert (compared, links > 300) == (42, True)
