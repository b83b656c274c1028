"""Pytest fixture `trundle_sim` for tests of robots, available once Trundle is installed.

def test_the_arm_holds_its_weight(trundle_sim):
    sim = trundle_sim("arm.urdf")
    sim.run(2.0)
    assert abs(sim["arm"].joint("shoulder").position) < 0.01
"""

import os
from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from trundle.bringup.loaded_simulation import LoadedSimulation


@pytest.fixture
def trundle_sim(request: pytest.FixtureRequest) -> "Callable[..., LoadedSimulation]":
    """Return a function that loads a file relative to the test's own file: `trundle_sim(file, seed=0)`.

    Warnings do not fail a test; they are in the simulation's `report`.
    """

    def make(file: str, *, seed: int = 0) -> "LoadedSimulation":
        from trundle import load

        beside = request.path.parent / file
        return load(str(beside) if "://" not in file and os.path.exists(beside) else file, seed=seed)

    return make
