"""Compare two recorded runs: how far they are apart at the same time since the start."""

import argparse
import sys
from pathlib import Path

from .quiet_imports import quiet_imports

EXAMPLES = """
  trundle compare new.log old.log                     maximum, its time and RMS of each model's and joint's difference
  trundle compare new.log old.log --tolerance 0.01    exit code 1 if any is above 0.01 m or rad
  trundle compare new.log old.log --csv               the table for other programs
  trundle compare new.bag old.bag                     of bags: topics, counts, rates, numbers and frames
  trundle play new.log --compare old.log              both in the browser
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("run", metavar="RUN", type=Path, help="state log of `trundle run --record`, .bag or .mcap")
    parser.add_argument(
        "reference", metavar="REFERENCE", type=Path, help="recording of the same kind to compare it with"
    )
    tolerance = "exit with 1 if a difference is larger [m, rad], or one has models or topics that the other lacks"
    parser.add_argument("--tolerance", type=_tolerance, metavar="X", help=tolerance)
    parser.add_argument("--csv", action="store_true", help="print comma-separated values")


def main(args: argparse.Namespace) -> int:
    """Print the table; return 1 if a difference is above the tolerance."""
    with quiet_imports():
        from trundle.base.diagnostics import UsageError, printable
        from trundle.ros import is_bag

    are_bags = is_bag(args.run)
    if are_bags != is_bag(args.reference):
        bag, log = (args.run, args.reference) if are_bags else (args.reference, args.run)
        raise UsageError(f"{bag} is a bag and {log} is none: compare two bags, or two state logs")
    with quiet_imports():
        if are_bags:
            from trundle.app.compare_bags import compare_bags

            found = compare_bags(args.run, args.reference, args.tolerance)
        else:
            from trundle.app.compare import compare_logs

            found = compare_logs(args.run, args.reference)
    if args.csv:
        print(found.csv(), end="")
    else:
        print(found.table())
        for note in found.notes:
            print(note)
        print(f"{found.duration:.2f} s, which both have, are compared")
    for name, models in found.only:
        print(printable(f"only in {name}: {', '.join(models)}"), file=sys.stderr)
    if args.tolerance is None:
        return 0
    if exceeding := found.exceed(args.tolerance):
        print(f"{len(exceeding)} of {len(found.rows)} differences exceed {args.tolerance:g}", file=sys.stderr)
    return 1 if exceeding or found.only else 0


def _tolerance(text: str) -> float:
    value = float(text)
    if not 0.0 <= value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not a tolerance; give metres and radians, such as 0.01")
    return value
