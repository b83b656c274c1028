"""Hostile and broken files are accepted or refused with an error; they never crash."""

import contextlib
import gzip
import json
from pathlib import Path

import pytest

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.robots.description import load
from trundle.robots.packages import Packages
from trundle.sim.physics import compile_world


@pytest.mark.parametrize("kind", ["sdf", "urdf", "xacro"])
def test_every_broken_file_of_the_collection_is_read_or_refused(shared: Path, kind: str) -> None:
    files = sorted((shared / "corpus/invalid" / kind).glob(f"*.{kind}"))
    assert files
    accepted = 0
    for path in files:
        report = Diagnostics()
        with contextlib.suppress(TrundleError):
            compile_world(load(str(path), report, packages=Packages({}, start=path)).world, report)
            accepted += 1
    assert 0 < accepted < len(files)


REFUSED = {
    "joint_unknown_child.sdf": "Gazebo leaves the joint out, and the robot falls apart; a slip of the pen is an error",
    "joint_unknown_parent.sdf": "as above",
}
"""File → why it is refused, though Gazebo 11 reads it."""


@pytest.mark.parametrize(
    ("kind", "tool", "answer"), [("sdf", "libsdformat9", "readfile"), ("urdf", "urdfdom3", "accept")]
)
def test_files_of_the_collection_that_gazebo_accepts_are_accepted(
    shared: Path, kind: str, tool: str, answer: str
) -> None:
    refused: set[str] = set()
    rows = json.loads(gzip.decompress((shared / "corpus/refs/invalid.json.gz").read_bytes()))
    rows = [row for row in rows if row["kind"] == kind and row[tool][answer]]
    for row in rows:
        path = shared / "corpus" / row["file"]
        try:
            load(str(path), Diagnostics(), packages=Packages({}, start=path))
        except TrundleError:
            refused.add(path.name)

    assert len(rows) > 20
    assert refused - REFUSED.keys() == set()
