"""Every published launch file of the reference set, against the real roslaunch."""

import re
from pathlib import Path

import pytest
from tests.robots.launch.corpus import Case, cases, differences

from trundle.base.diagnostics import DescriptionError, Diagnostics

_NO_PACKAGE = re.compile(r": ([\w-]+)\s*ROS path")
# roslaunch's message, and Trundle's of the same fault.
_SAME_FAULT = (
    ("ResourceNotFound", "no package"),
    ("file does not exist", "no file"),
    ("No such file", "no file|no launch file"),
    ("is not defined|requires the|address", "is required and was not given|no argument"),
    ("unused args", "has no argument"),
    ("not a valid ROS name", "not a legal ROS name"),
    ("'param' attribute must be set", "needs the attribute 'param'"),
    ("Cannot load command parameter", "command|xacro|no package"),
)


@pytest.fixture(scope="module")
def published(shared: Path) -> list[Case]:
    if not (shared / "corpus").is_dir():
        pytest.skip("the published launch files (../shared/corpus) are not beside this checkout")
    return cases(shared / "corpus")


@pytest.mark.slow
def test_files_that_roslaunch_accepts_give_the_same_plan(published: list[Case]) -> None:
    accepted = [case for case in published if case.row["accept"]]
    assert len(accepted) == 507

    wrong: dict[str, object] = {}
    for case in accepted:
        try:
            found_differences = differences(case, case.read(Diagnostics()))
        except DescriptionError as error:
            found_differences = [str(error)]
        if found_differences:
            wrong[case.row["file"]] = found_differences

    assert wrong == {}


@pytest.mark.slow
def test_files_that_roslaunch_refuses_are_refused_for_the_same_reason(published: list[Case]) -> None:
    """Commands run later: a file in which only a command fails is read without an error."""
    wrong: dict[str, str] = {}
    refused = [case for case in published if not case.row["accept"]]
    for case in refused:
        expected = case.row["error"]
        try:
            case.read(Diagnostics())
        except DescriptionError as error:
            if not any(re.search(a, expected) and re.search(b, error.what) for a, b in _SAME_FAULT):
                wrong[case.row["file"]] = f"{expected} / {error}"
            elif (package := _NO_PACKAGE.search(expected)) and "no package" in error.what:
                missing = re.search(r"no package '([\w-]+)'", error.what)
                if missing is None or missing[1] != package[1]:
                    wrong[case.row["file"]] = f"{expected} / {error}"
        else:
            if "Cannot load command parameter" not in expected:
                wrong[case.row["file"]] = f"accepted; roslaunch: {expected}"

    assert len(refused) == 135
    assert wrong == {}
