"""Run a world or a launch file many times with different values, and report the results."""

import argparse
import sys
from pathlib import Path

from .options import add_allow_outside, add_lenient, add_page_access, page_access
from .quiet_imports import quiet_imports

EXAMPLES = """
  trundle sweep plan.yaml                             every run of the plan; the same command goes on after a stop
  trundle sweep plan.yaml -o results --workers 4      results in another folder, four processes
  trundle sweep plan.yaml --row 4711                  one run again, in the browser
  trundle sweep report plan.yaml                      distributions, what matters, the worst runs: one HTML file
"""
_REPORT = "report"


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "words",
        nargs="+",
        metavar="[report] PLAN.yaml",
        help="plan of the runs; `report` first: the report of its results",
    )
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="folder of the results (PLAN.sweep)")
    parser.add_argument("--workers", type=int, metavar="N", help="number of processes (one for each processor)")
    address = "Ray cluster that runs them: HOST:PORT, `auto` for the one of this machine, `local` for a new one"
    parser.add_argument("--address", metavar="ADDR", help=address)
    parser.add_argument("--row", type=int, metavar="N", help="run row N again, in the browser; nothing is written")
    parser.add_argument("--headless", action="store_true", help="with --row: no browser page, print its result")
    parser.add_argument("--port", type=int, metavar="N", help="with --row: the page's port (8080, or a free one)")
    add_page_access(parser)
    add_allow_outside(parser)
    add_lenient(parser)


def main(args: argparse.Namespace) -> int:
    """Run a plan, a row of it, or write its report."""
    words: list[str] = args.words
    with quiet_imports():
        from trundle.studies.sweep.plan_reader import load_plan
    if words[0] == _REPORT and len(words) == 2:
        from trundle.studies.sweep.report import write_report

        print(write_report(load_plan(Path(words[1])), output=args.output))
        return 0
    if len(words) != 1 or words == [_REPORT]:
        print("trundle sweep: give one PLAN.yaml, or report PLAN.yaml", file=sys.stderr)
        return 2
    plan = load_plan(Path(words[0]))
    if args.row is not None:
        from trundle.base.http.page_address import PageAddress
        from trundle.studies.sweep.replay import replay

        at = PageAddress(port=args.port, allowed=page_access(args), view_only=args.view_only)
        return replay(plan, args.row, None if args.headless else at)
    from trundle.studies.sweep.run_sweep import run_sweep

    result = run_sweep(plan, output=args.output, workers=args.workers, address=args.address)
    print(f"{result.summary()}; {result.folder}")
    if result.interrupted:
        print(f"stopped; `trundle sweep {words[0]}` goes on", file=sys.stderr)
        return 130
    return 0 if result.counts.get("ok", 0) == result.total else 1
