"""Hostile and broken files end in a sentence or an acceptance, never in anything else."""

import contextlib
from pathlib import Path

import pytest

from trundle.description import load
from trundle.diagnostics import Diagnostics, TrundleError
from trundle.packages import Packages
from trundle.physics import compile_world


@pytest.mark.parametrize("kind", ["sdf", "urdf", "xacro"])
def test_every_broken_file_of_the_collection(shared: Path, kind: str) -> None:
    files = sorted((shared / "corpus/invalid" / kind).glob(f"*.{kind}"))
    assert files
    accepted = 0
    for path in files:
        report = Diagnostics()
        with contextlib.suppress(TrundleError):
            compile_world(load(str(path), report, packages=Packages({}, start=path)).world, report)
            accepted += 1
    assert 0 < accepted < len(files)
