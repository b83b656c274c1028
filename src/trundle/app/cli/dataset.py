"""Generate annotated images of a varied world, for training vision models."""

import argparse
import sys
from pathlib import Path

from .options import add_allow_outside, add_lenient
from .quiet_imports import quiet_imports

EXAMPLES = """
  trundle dataset plan.yaml                           every picture of the plan; the same command goes on after a stop
  trundle dataset plan.yaml --count 20                the first twenty
  trundle dataset plan.yaml --show 7                  picture 7 alone, drawn with its annotations: plan.000007.png
  trundle dataset plan.yaml -o data --workers 4       in another folder, by four processes
"""
_MAX_LISTED = 10


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("plan", type=Path, metavar="PLAN.yaml", help="what is drawn, and what varies")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="folder of the dataset (PLAN.dataset)")
    parser.add_argument("--workers", type=int, metavar="N", help="number of processes (one for each processor)")
    parser.add_argument("--count", type=int, metavar="N", help="number of pictures (the plan's)")
    parser.add_argument("--show", type=int, metavar="N", help="draw picture N with its annotations; makes no dataset")
    add_allow_outside(parser)
    add_lenient(parser)


def main(args: argparse.Namespace) -> int:
    """Generate the images of a plan."""
    with quiet_imports():
        from trundle.studies.datasets import load_dataset_plan
    plan = load_dataset_plan(args.plan, count=args.count)
    if args.show is not None:
        from trundle.studies.dataset.show import show_picture

        path = args.plan.with_suffix(f".{args.show:06}.png")
        print(f"{show_picture(plan, args.show, path)}\n{path}")
        return 0
    from trundle.studies.dataset.make_dataset import make_dataset

    result = make_dataset(plan, output=args.output, workers=args.workers)
    print(f"{result.summary()}; {result.folder}")
    if result.interrupted:
        print(f"stopped; `trundle dataset {args.plan}` goes on", file=sys.stderr)
        return 130
    for number, reason in sorted(result.failed.items())[:_MAX_LISTED]:
        print(f"picture {number}: {reason}", file=sys.stderr)
    return 1 if result.failed else 0
