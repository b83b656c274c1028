"""Pytest fixtures for tests of robots, available once Trundle is installed.

def test_the_arm_holds_its_weight(trundle_sim):
    sim = trundle_sim("arm.urdf")
    sim.run(2.0)
    assert abs(sim["arm"].joint("shoulder").position) < 0.01

def test_it_stands_in_all_variations(trundle_sweep):
    trundle_sweep("stands.yaml")
"""

import os
from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

    from trundle.live.loaded_simulation import LoadedSimulation
    from trundle.studies.sweep.run_sweep import SweepResult


@pytest.fixture
def trundle_sim(request: pytest.FixtureRequest) -> "Callable[..., LoadedSimulation]":
    """Return a function that loads a file relative to the test's own file: `trundle_sim(file, seed=0)`.

    Warnings do not fail a test; they are in the simulation's `report`.
    """

    def make(file: str, *, seed: int = 0) -> "LoadedSimulation":
        from trundle import load

        path = request.path.parent / file
        return load(str(path) if "://" not in file and os.path.exists(path) else file, seed=seed, warn=False)

    return make


@pytest.fixture
def trundle_sweep(request: pytest.FixtureRequest, tmp_path: "Path") -> "Callable[[str], SweepResult]":
    """Return a function that runs a plan relative to the test's own file; a run that is not ok fails the test.

    It returns the results; needs the extra `sweep`.
    """

    def run(plan: str) -> "SweepResult":
        from trundle.studies.sweep.plan_reader import load_plan
        from trundle.studies.sweep.regression import plan_problems

        result, problems = plan_problems(load_plan(request.path.parent / plan), tmp_path / f"{plan}.sweep")
        if problems is not None:
            pytest.fail(problems, pytrace=False)
        return result

    return run
