"""Regression test of a plan: all its runs must be ok."""

import tempfile
import time
from pathlib import Path

from trundle.live.launch.test_results import CaseResult, SuiteResult, write_junit

from .plan import Plan
from .run_sweep import SweepResult, run_sweep

_SHOWN = 20
"""Maximum number of runs listed in a message."""


def run_plan_test(plan: Plan, *, junit: Path | None) -> int:
    """Run a whole plan for `trundle test`; return 0: all runs are ok, 2: one is not, 130: Ctrl-C.

    Args:
        plan: plan to test.
        junit: JUnit XML file to write, with a case for each run.

    Raises:
        TrundleError: the plan cannot be run.
    """
    started_s = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        result = run_sweep(plan, output=Path(folder))
        cases = _cases(result)
    if junit is not None:
        suite = SuiteResult(
            name=Path(plan.file).stem, seconds=time.monotonic() - started_s, cases=cases, did_run=not result.interrupted
        )
        write_junit(junit, [suite])
    print(verdict(plan, result, cases))
    if result.interrupted:
        return 130
    return 2 if any(case.problem for case in cases) else 0


def plan_problems(plan: Plan, folder: Path) -> tuple[SweepResult, str | None]:
    """Run a plan; return its results, and a message about the runs that are not ok, or None.

    Args:
        plan: plan to test.
        folder: folder of the results.

    Raises:
        TrundleError: the plan cannot be run.
        KeyboardInterrupt: Ctrl-C.
    """
    result = run_sweep(plan, output=folder)
    if result.interrupted:
        raise KeyboardInterrupt
    cases = _cases(result)
    return result, verdict(plan, result, cases) if any(case.problem for case in cases) else None


def verdict(plan: Plan, result: SweepResult, cases: tuple[CaseResult, ...]) -> str:
    """Return a message with the number of ok runs, and the first others with their reasons."""
    failed = [case for case in cases if case.problem]
    lines = [f"{plan.file}: ok in {result.counts.get('ok', 0):,} of {result.total:,} variations"]
    lines += [f"  {case.name}: {case.problem}" for case in failed[:_SHOWN]]
    if len(failed) > _SHOWN:
        lines.append(f"  and {len(failed) - _SHOWN:,} more")
    if failed:
        lines.append(f"  one of them in the browser: trundle sweep {plan.file} --{failed[0].name}")
    return "\n".join(lines)


def _cases(result: SweepResult) -> tuple[CaseResult, ...]:
    rows = result.table.select(["row", "status", "reason"]).to_pylist()
    return tuple(
        CaseResult(
            name=f"row {row['row']}",
            problem="" if row["status"] == "ok" else row["reason"],
            is_error=row["status"] not in ("ok", "failed"),
        )
        for row in rows
    )
