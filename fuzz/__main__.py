"""`make fuzz`: damaged inputs for every format that is read and every socket.

A finding is an error that is not the project's own, a traceback or warning printed, a report of a sanitizer, a crash,
a hang, more than 10 s of processor time or 1 GB of memory for one input. out/fuzz/findings has a folder for each kind:
the shortest input, and report.txt with a line that repeats it. out/fuzz/summary.json adds up hours, executions and
findings of each target over all runs; out/fuzz/corpus has inputs that reached new code, which later runs go on with.
"""

import argparse
import os
import sys
from pathlib import Path

from . import atheris_engine, sanitized
from .campaign import Campaign
from .catalog import NATIVE, TARGETS
from .target import ROOT

_SECONDS = 600.0


def main() -> int:
    """Fuzz; 1 if anything was found."""
    what = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(prog="python -m fuzz", description=__doc__, formatter_class=what)
    parser.add_argument("targets", metavar="TARGET", nargs="*", help=f"all by default: {' '.join(TARGETS)}")
    parser.add_argument("--seconds", type=float, default=_SECONDS, help="duration of the whole run (600)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="targets at a time (one per processor)")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "fuzz", help="folder of all files (out/fuzz)")
    parser.add_argument("--input", type=Path, help="feed this file to TARGET once, and print what happens")
    args = parser.parse_args()
    names: list[str] = args.targets or list(TARGETS)
    if unknown := [name for name in names if name not in TARGETS]:
        parser.error(f"no target {unknown[0]!r}; there are: {' '.join(TARGETS)}")
    if args.input is not None and len(names) != 1:
        parser.error("--input needs one TARGET")
    if not atheris_engine.is_installed():
        print("fuzz: Atheris is not installed: inputs are not guided by coverage", file=sys.stderr)
    built = sanitized.build() if not NATIVE.isdisjoint(names) else None
    with Campaign(args.out.absolute(), built, {} if built is None else sanitized.environment()) as campaign:
        if args.input is not None:
            return campaign.repeat(names[0], args.input.absolute())
        campaign.run(names, args.seconds, args.jobs)
    for name in sorted(campaign.found):
        print((args.out / "findings" / name / "report.txt").read_text(errors="replace").split("\n\n")[0])
    print(f"fuzz: {len(campaign.found)} findings in {args.out / 'findings'}; figures in {args.out / 'summary.json'}")
    return 1 if campaign.found else 0


if __name__ == "__main__":
    sys.exit(main())
