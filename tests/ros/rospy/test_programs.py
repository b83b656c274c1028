"""Programs that use rospy's API print the same as with the original.

expected.json was recorded with Debian's rospy; where that is installed, it is compared again.
"""

import json
import sys
from pathlib import Path

import pytest
from tests.graphs import running_graph
from tests.ros.rospy.programs import DEBIAN, EXPECTED, SINGLE, TOGETHER, environment, run_single, run_together

_REAL = pytest.param(
    DEBIAN,
    id="Debian's",
    marks=[
        pytest.mark.slow,
        pytest.mark.real_ros,
        pytest.mark.skipif(not Path("/usr/lib/python3/dist-packages/rospy").is_dir(), reason="no rospy is installed"),
    ],
)
_PYTHONS = [pytest.param(sys.executable, id="ours"), _REAL]
_QUICK = {"remapping.py", "shutdown_order.py", "replaced.py"}
_EXPECTED: dict[str, str] = json.loads(EXPECTED.read_text())


@pytest.mark.parametrize("kind", TOGETHER)
@pytest.mark.parametrize("python", _PYTHONS)
def test_programs_print_the_same_as_with_the_original(python: str, kind: str, tmp_path: Path) -> None:
    with running_graph() as graph:
        printed = run_together(python, kind, environment(python, graph.core.uri, tmp_path))
    assert set(printed) == {program.name for program in TOGETHER[kind]}
    assert {name: text for name, text in printed.items() if text != _EXPECTED[name]} == {}


@pytest.mark.parametrize("python", _PYTHONS)
@pytest.mark.parametrize(
    "program",
    [
        pytest.param(program, id=program.stem, marks=[] if program.name in _QUICK else [pytest.mark.slow])
        for program in SINGLE
    ],
)
def test_programs_start_and_end_as_with_the_original(python: str, program: Path, tmp_path: Path) -> None:
    with running_graph() as graph:
        assert run_single(python, program, environment(python, graph.core.uri, tmp_path)) == _EXPECTED[program.name]
