"""Hundreds of published files, compared with the output of the real tools."""

import gzip
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.robots.description.compare import close, differences, same_pose, shape_of

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.base.xmlnode import parse_xml
from trundle.gazebo.check.json_output import description_json
from trundle.robots.description import expand_xacro, load, load_urdf
from trundle.robots.model import Model
from trundle.robots.packages import Packages

TOLERANCE = 1e-6
"""libsdformat 12 prints every digit."""

EXCEPTIONS: dict[str, str] = {
    "repos/ros+xacro/test/B.xacro": "xacro's own test of itself: it calls a private method that xacro 2 no longer has",
}
"""File → why Trundle's result differs, and is right."""


@pytest.fixture(scope="module")
def corpus(shared: Path) -> Path:
    return shared / "corpus"


@pytest.fixture(scope="module")
def packages(corpus: Path) -> Packages:
    """Packages as on a machine that has built them all: gazebo_ros puts their models on the path."""
    folders = {config.parent.parent for config in corpus.glob("repos/**/model.config")}
    database = corpus / "repos/osrf+gazebo_models"
    path = [*sorted(folders - {database}), database]
    return Packages({"GAZEBO_MODEL_PATH": ":".join(map(str, path))}, start=corpus)


@pytest.mark.slow
def test_sdf_files_are_read_as_by_libsdformat(corpus: Path, packages: Packages) -> None:
    """Files that Gazebo 11 accepts are accepted; where libsdformat 9 and 12 agree, every value agrees with theirs."""
    rows = json.loads((corpus / "manifest.json").read_text())["sdf"]
    assert len(rows) > 800
    found_differences = {row["file"]: list(_sdf_differences(row, corpus, packages)) for row in rows}
    assert {file: lines[:5] for file, lines in found_differences.items() if lines and file not in EXCEPTIONS} == {}


def _sdf_differences(row: dict[str, Any], corpus: Path, packages: Packages) -> Iterator[str]:
    file = corpus / row["file"]
    try:
        loaded = load(str(file), Diagnostics(), packages=packages)
    except TrundleError as error:
        if row["accept_gz11"]:
            yield f"refused: {error}"
        return
    if not (row["accept_libsdformat12"] and row["agree_9_12"]):
        return
    actual = json.loads(json.dumps(description_json(loaded), allow_nan=False))
    expected = json.loads(gzip.decompress((corpus / row["ref"]).read_bytes()))["dump12"]
    placed = "<state" not in file.read_text(errors="replace")
    world = expected["worlds"][0] if expected["worlds"] else None
    models = world["models"] if world else expected["models"]
    if "<population" in file.read_text(errors="replace"):  # libsdformat leaves it to Gazebo
        actual["models"] = [model for model in actual["models"] if "_clone_" not in model["name"]]
    if [model["name"] for model in actual["models"]] != [model["name"] for model in models]:
        yield f"models {[m['name'] for m in actual['models']]}, theirs {[m['name'] for m in models]}"
    for mine, other in zip(actual["models"], models, strict=False):
        yield from differences(mine, other, TOLERANCE, placed=placed)
    if world:
        yield from _world_differences(actual, world, placed=placed)


def _world_differences(actual: dict[str, Any], expected: dict[str, Any], *, placed: bool) -> Iterator[str]:
    if actual["name"] != expected["name"]:
        yield f"world name {actual['name']}, theirs {expected['name']}"
    if not all(close(a, b, TOLERANCE) for a, b in zip(actual["gravity"], expected["gravity"], strict=True)):
        yield f"gravity {actual['gravity']}, theirs {expected['gravity']}"
    if [(x["name"], x["type"]) for x in actual["lights"]] != [(x["name"], x["type"]) for x in expected["lights"]]:
        yield f"lights {actual['lights']}, theirs {expected['lights']}"
    for mine, other in zip(actual["lights"], expected["lights"], strict=False):
        if placed and not same_pose(mine["pose"], other["pose"], TOLERANCE):
            yield f"light {mine['name']} at {mine['pose']}, theirs {other['pose']}"
    step = expected["physics"][0]["max_step_size"]
    if not close(actual["physics"]["max_step_size"], step, TOLERANCE):
        yield f"step {actual['physics']['max_step_size']}, theirs {step}"


@pytest.mark.parametrize("stride", [5, pytest.param(1, marks=pytest.mark.slow)])
def test_robots_are_read_as_by_urdfdom_and_converted_as_by_gazebo(
    corpus: Path, packages: Packages, stride: int
) -> None:
    """Distinct robots, expanded, one of each `stride`; conversions are compared where libsdformat 9 and 12 agree."""
    rows = {row["sha"]: row for row in json.loads((corpus / "manifest.json").read_text())["urdf"]}
    assert len(rows) > 150
    found_differences = {
        row["file"]: list(_urdf_differences(row, corpus, packages)) for row in list(rows.values())[::stride]
    }
    assert {file: lines[:5] for file, lines in found_differences.items() if lines and file not in EXCEPTIONS} == {}


def _urdf_differences(row: dict[str, Any], corpus: Path, packages: Packages) -> Iterator[str]:
    answers = json.loads(gzip.decompress((corpus / row["ref"]).read_bytes()))
    text = gzip.decompress((corpus / row["expanded"]).read_bytes()).decode()
    file = corpus / row["file"]
    try:
        loaded = load_urdf(text, str(file), file, packages, Diagnostics())
    except TrundleError as error:
        if row["accept_urdfdom"]:
            yield f"refused: {error}"
        return
    if not row["accept_urdfdom"]:
        yield "accepted; urdfdom refuses it"
        return
    actual = json.loads(json.dumps(description_json(loaded), allow_nan=False))
    yield from _tree_differences(actual["urdf"], answers["urdfdom3"]["dump"])
    if row["accept_libsdformat12"] and not answers["differences_sdf9_vs_sdf12"]:
        (expected,) = answers["libsdformat12"]["dump"]["models"]
        yield from differences(actual["models"][0], expected, TOLERANCE)
        yield from _shape_name_differences(loaded.world.models[0], expected)


def _shape_name_differences(actual: Model, expected: dict[str, Any]) -> Iterator[str]:
    """Names of collisions and visuals, and their order."""
    links = {link["name"]: link for link in expected["links"]}
    for link in actual.links:
        for kind, shapes in (("collisions", link.collisions), ("visuals", link.visuals)):
            mine, other = [shape.name for shape in shapes], [shape["name"] for shape in links[link.name][kind]]
            if mine != other:
                yield f"{link.name}: {kind} {mine}, theirs {other}"


def _tree_differences(actual: dict[str, Any], expected: dict[str, Any]) -> Iterator[str]:
    if actual["root"] != expected["root"]:
        yield f"root {actual['root']}, theirs {expected['root']}"
    links = {link["name"]: link for link in expected["links"]}
    joints = {joint["name"]: joint for joint in expected["joints"]}
    if {link["name"] for link in actual["links"]} != links.keys():
        yield f"links {[link['name'] for link in actual['links']]}, theirs {list(links)}"
    if {joint["name"] for joint in actual["joints"]} != joints.keys():
        yield f"joints {[joint['name'] for joint in actual['joints']]}, theirs {list(joints)}"
    for link in actual["links"]:
        other = links.get(link["name"])
        if other is not None and not same_pose(link["pose"], other["pose_model"], TOLERANCE):
            yield f"{link['name']} at {link['pose']}, theirs {other['pose_model']}"
    for joint in actual["joints"]:
        other = joints.get(joint["name"], joint)
        if any(joint[field] != other[field] for field in ("type", "parent", "child")):
            yield f"{joint}, theirs {other}"


@pytest.mark.slow
def test_xacro_files_expand_as_xacro_expands_them(corpus: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same elements, attributes and texts as Melodic's xacro 1.13.3, or 2.1.1 where that one refuses."""
    rows = json.loads((corpus / "manifest.json").read_text())["xacro"]
    assert len(rows) > 350
    workspaces = ":".join(map(str, sorted((corpus / "repos").iterdir())))
    differ: dict[str, str] = {}
    for row in rows:
        file = corpus / row["file"]
        answer = row.get("out_1_13" if row["accept_1_13"] else "out_2_1")
        for name, value in row["env"].items():
            monkeypatch.setenv(name, value)
        environment = {"ROS_PACKAGE_PATH": workspaces, **row["env"]}
        try:
            actual = expand_xacro(file, {}, packages=Packages(environment, start=file), report=Diagnostics())
        except TrundleError as error:
            if answer and row["file"] not in EXCEPTIONS:
                differ[row["file"]] = str(error)
            continue
        finally:
            for name in row["env"]:
                monkeypatch.delenv(name)
        if answer:
            expected = gzip.decompress((corpus / answer).read_bytes()).decode().replace("CORPUS", str(corpus))
            if shape_of(parse_xml(actual, name="ours")) != shape_of(parse_xml(expected, name="theirs")):
                differ[row["file"]] = "expands otherwise"
    assert differ == {}
