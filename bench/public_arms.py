"""Public arms' launch files: fifty random valid goals each, as one table.

`python -m bench.public_arms CHECKOUTS [NAME …]`: CHECKOUTS is a folder of repositories; NAME a case of
`public_arms.yaml` (all of them). The table has the goals that were planned, those whose motion ended where it should
without a fault, the median time of a plan, and the motions within every limit and those without contact. `GOALS=5` asks
for fewer goals, `LIMIT_S=1800` [s] for more time; `LOGS=FOLDER` keeps each case's log and its rows as JSON.
"""

import os
import sys
import tempfile
from pathlib import Path

import msgspec

from bench.arm_goals import ArmCase, GoalFigures, run_goals

_CASES = Path(__file__).with_suffix(".yaml")
_GOALS = 50
_LIMIT_S = float(os.environ.get("LIMIT_S", "900"))
_SHARE = 0.98
"""Share of the goals that is to be reached."""


def main(words: list[str]) -> int:
    """Run cases, and print a table."""
    checkouts, names = Path(words[0]).absolute(), words[1:]
    cases = msgspec.yaml.decode(_CASES.read_bytes(), type=dict[str, ArmCase])
    goals = int(os.environ.get("GOALS", _GOALS))
    failed = 0
    print("| package | planned | executed | median plan | limits kept | no contact | what failed |")
    print("|---|---|---|---|---|---|---|")
    for name, case in cases.items():
        if names and name not in names:
            continue
        plain = name.replace(" ", "_").replace(",", "")
        packages = [checkouts / repository for repository in case.repositories]
        with tempfile.TemporaryDirectory() as folder:
            place = Path(os.environ.get("LOGS", folder))
            place.mkdir(parents=True, exist_ok=True)
            found = run_goals(case, goals, place, packages=packages, name=plain, limit_s=_LIMIT_S)
        failed += found.executed < _SHARE * goals
        print(_row(name, found, goals), flush=True)
    return min(failed, 1)


def _row(name: str, found: GoalFigures, goals: int) -> str:
    figures = f"{found.planned} of {goals} | {found.executed} | {found.median_s:.3f} s"
    return f"| {name} | {figures} | {found.within_limits} | {found.free_of_contact} | {'; '.join(found.faults)} |"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
