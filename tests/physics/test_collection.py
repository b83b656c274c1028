"""Every published model and world that loads is simulated for two seconds and stays sound."""

import re
from pathlib import Path

import numpy as np
import pytest

import trundle
from trundle.diagnostics import DescriptionError
from trundle.simulation import Simulation

REPOSITORIES = Path(__file__).resolve().parents[3] / "shared/corpus/repos"
KINDS = ("*.sdf", "*.world", "*.urdf")
REFUSED = {
    # No XML at all: a template, a pointer to a file that is kept elsewhere, or an empty file.
    r"not well-formed XML",
    # A test of somebody's reader, or the specification's own example.
    r"<robot> needs a name",
    r"<urdf> starts neither an SDF",
    r"no type 'type1'",
    # Gazebo's format before 2012, which is not even SDF 1.0.
    r"<gazebo:world> starts neither an SDF",
}
"""Why a file may be refused; any other reason is a fault of ours."""


def repositories() -> list[str]:
    return sorted(path.name for path in REPOSITORIES.iterdir()) if REPOSITORIES.is_dir() else []


def load(path: Path) -> Simulation | None:
    """None where a file may be refused."""
    try:
        return trundle.load(str(path))
    except DescriptionError as error:
        if not any(re.search(reason, str(error)) for reason in REFUSED):
            raise
        return None


@pytest.mark.slow
@pytest.mark.parametrize("repository", repositories())
def test_what_is_published_stays_sound(repository: str) -> None:
    folder = REPOSITORIES / repository
    for path in sorted(file for kind in KINDS for file in folder.rglob(kind)):
        sim = load(path)
        if sim is None:
            continue
        sim.run(2.0)  # raises where it runs away
        assert np.isfinite(sim.snapshot().poses).all(), path
        assert np.isfinite(sim.snapshot().twists).all(), path
