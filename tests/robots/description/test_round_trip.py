"""Published files, written out and read again: the same model, field by field."""

import gzip
import json
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.robots.description.plain import plain, unlike

from trundle.base.diagnostics import DescriptionError, Diagnostics, TrundleError
from trundle.robots.description import LoadedDescription, load, load_text, load_urdf, write_sdf, write_urdf, written_uri
from trundle.robots.model import MeshFile, Model, flattened, model_from_joint
from trundle.robots.packages import Packages
from trundle.spatial import Pose

KNOWN_DIFFERENCES = {
    "models/joints/name": "SDF before 1.7 let a joint be called like a link; it gets `_joint` behind its name",
    "models/models/joints/name": "as above",
    "models/links/visuals/geometry/uri": "a relative URI becomes a full one, to the same file",
    "models/links/collisions/geometry/uri": "as above",
    "models/links/visuals/material/texture_scale": "SDF has no texture scale; the writer warns",
    "models/models/links/visuals/material/texture_scale": "as above",
}
"""Field → reason for a difference."""
UNSETTLED = {"altimeter", "logical_camera", "magnetometer", "sonar", "wireless_transmitter", "wireless_receiver"}
"""Sensors with only name, type and pose in the model; the loss of their settings is warned of."""


@pytest.fixture(scope="module")
def packages(shared: Path) -> Packages:
    models = shared / "corpus/repos/osrf+gazebo_models"
    return Packages({"HOME": "/nobody", "GAZEBO_MODEL_PATH": str(models)}, start=shared / "corpus")


def through_sdf(loaded: LoadedDescription, folder: Path, packages: Packages) -> set[str]:
    """Fields in which a description differs from itself written and read as SDF."""
    is_world = loaded.kind == "world"
    report = Diagnostics()
    text = write_sdf(loaded.world, is_world=is_world, uri_of=written_uri, report=report)
    again = load_text(text, name="<stdin>", folder=folder, packages=packages, report=Diagnostics())
    warnings = [w for w in report.warnings if not any(f"of a {kind} sensor are not written" in w for kind in UNSETTLED)]
    assert again.kind == ("world" if is_world else "model")
    differences = {*unlike(plain(loaded.world), plain(again.world)), *(w for w in warnings if "texture scale" not in w)}
    return differences - KNOWN_DIFFERENCES.keys()


def sdf_files(shared: Path, packages: Packages, step: int) -> Iterator[tuple[Path, LoadedDescription]]:
    for row in json.loads((shared / "corpus/manifest.json").read_text())["sdf"][::step]:
        path = shared / "corpus" / row["file"]
        try:
            yield path, load(str(path), Diagnostics(), packages=packages.around(path))
        except TrundleError:
            continue


def urdf_files(shared: Path, packages: Packages, step: int) -> Iterator[tuple[Path, LoadedDescription]]:
    """Files as the corpus expanded them, each once."""
    rows: dict[str, Any] = {
        row["sha"]: row for row in json.loads((shared / "corpus/manifest.json").read_text())["urdf"]
    }
    for row in list(rows.values())[::step]:
        path = shared / "corpus" / row["file"]
        text = gzip.decompress((shared / "corpus" / row["expanded"]).read_bytes()).decode()
        try:
            yield path, load_urdf(text, str(path), path, packages.around(path), Diagnostics())
        except TrundleError:
            continue


def same_through_sdf(files: Iterator[tuple[Path, LoadedDescription]], packages: Packages) -> int:
    differ = Counter[str]()
    count = 0
    for path, loaded in files:
        for item in through_sdf(loaded, path.parent, packages.around(path)):
            differ[f"{item} of {path}"] += 1
        count += 1
    assert differ == {}
    return count


def test_a_sample_of_sdf_files_round_trips(shared: Path, packages: Packages) -> None:
    assert same_through_sdf(sdf_files(shared, packages, 20), packages) > 40


def test_a_sample_of_urdf_files_round_trips(shared: Path, packages: Packages) -> None:
    assert same_through_sdf(urdf_files(shared, packages, 20), packages) > 5


@pytest.mark.slow
def test_every_sdf_file_round_trips(shared: Path, packages: Packages) -> None:
    assert same_through_sdf(sdf_files(shared, packages, 1), packages) > 840


@pytest.mark.slow
def test_every_urdf_file_round_trips(shared: Path, packages: Packages) -> None:
    assert same_through_sdf(urdf_files(shared, packages, 1), packages) > 150


def link_poses(model: Model, left_out: set[str]) -> list[tuple[str, Pose]]:
    """Poses of every mass, visual, sensor and joint in the first link's frame, which a URDF keeps.

    Visuals are matched by order, as the conversion of a URDF renames them; missing ones cannot be written.
    """
    differences: list[tuple[str, Pose]] = []
    first = model.links[0].model_from_link.inverse()
    for link in model.links:
        root_from_link = first @ link.model_from_link
        differences.append((f"{link.name} mass", root_from_link @ link.inertial.link_from_com))
        for visual in link.visuals:
            lost = isinstance(visual.geometry, MeshFile) and visual.geometry.path is None
            if not lost and visual.name not in left_out:
                differences.append((f"{link.name} visual", root_from_link @ visual.link_from_visual))
        differences += [(f"{link.name} {item.name}", root_from_link @ item.link_from_sensor) for item in link.sensors]
    return differences + [(f"joint {joint.name}", first @ model_from_joint(model, joint)) for joint in model.joints]


def through_urdf(model: Model, folder: Path, packages: Packages) -> list[str] | None:
    """Poses that differ after a model was written as URDF; None: URDF cannot express it."""
    report = Diagnostics()
    try:
        text = write_urdf(model, uri_of=written_uri, report=report)
    except DescriptionError:
        return None
    left_out = {warning.split("'")[1] for warning in report.warnings if "it is left out" in warning}
    again = load_text(text, name="<stdin>", folder=folder, packages=packages, report=Diagnostics()).world.models[0]
    before, after = link_poses(model, left_out), link_poses(again, set())
    if [name for name, _ in before] != [name for name, _ in after]:
        return [f"{[name for name, _ in before]} became {[name for name, _ in after]}"]
    return [name for (name, pose), (_, now) in zip(before, after, strict=True) if list(unlike(pose, now))]


@pytest.mark.slow
def test_models_written_as_urdf_keep_their_poses(shared: Path, packages: Packages) -> None:
    """Cases: models of the database, and every converted URDF."""
    database = (item for item in sdf_files(shared, packages, 1) if "osrf+gazebo_models" in str(item[0]))
    count = 0
    for path, loaded in (*database, *urdf_files(shared, packages, 1)):
        for model in flattened(loaded.world).models:
            moved = through_urdf(model, path.parent, packages.around(path))
            assert not moved, path
            count += moved is not None
    assert count > 300
